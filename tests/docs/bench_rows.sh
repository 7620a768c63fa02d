#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# bench_rows.sh ROOT: the table of docs/internals/performance.md has the rows that tools/bench knows, in the same order. Its figures
# are those of the last run that was written there.
set -eu
cd "$1"
page=docs/internals/performance.md
shown=$(sed -n '/^<!-- written by tools\/bench --docs -->$/,/^<!-- end -->$/s/^| \([A-Z][A-Z0-9]*\) | \([^|]*\) |.*/\1;\2/p' "$page")
known=$(grep -v '^#' tests/bench/rows.csv)
[ "$shown" = "$known" ] && exit 0
printf '%s has these rows:\n%s\n\ntests/bench/rows.csv has these:\n%s\n' "$page" "$shown" "$known" >&2
exit 1
