#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# bench_rows.sh ROOT: the table of docs/internals/performance.md has the rows that tools/bench knows, in the same order. Its figures
# are those of the last run that was written there. The counts of instructions are those that tools/check-instructions keeps.
set -eu
cd "$1"
page=docs/internals/performance.md
shown=$(sed -n '/^<!-- written by tools\/bench --docs -->$/,/^<!-- end -->$/s/^| \([A-Z][A-Z0-9]*\) | \([^|]*\) |.*/\1;\2/p' "$page")
known=$(grep -v '^#' tests/bench/rows.csv)
if [ "$shown" != "$known" ]; then
    printf '%s has these rows:\n%s\n\ntests/bench/rows.csv has these:\n%s\n' "$page" "$shown" "$known" >&2
    exit 1
fi
# "Data_Exchange of another station, read and dropped" is Data_Exchange_of_another_station.
shown=$(sed -n '/^| instructions per request, g++ 12.2, x86-64 /,/^$/s/^| \([^,|]*\).* | \([0-9]*\) |$/\1;\2/p' "$page" | tr ' ' _ | sed 's/_*;/;/' | sort)
known=$(sed -n 's/^g++ 12.2 x86_64;//p' tests/bench/instructions.csv | sort)
if [ "$shown" != "$known" ]; then
    printf '%s has these counts:\n%s\n\ntests/bench/instructions.csv has these:\n%s\n' "$page" "$shown" "$known" >&2
    exit 1
fi
