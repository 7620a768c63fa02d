#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# bench_rows.sh ROOT: the table of docs/internals/performance.md has the rows that tools/run bench knows, in the same order.
set -eu
cd "$1"
page=docs/internals/performance.md
shown=$(sed -n 's/^| \(M[0-9]*\) | \([^|]*\) | [≤≥] [^|]* |$/\1;\2/p' "$page")
known=$(grep -v '^#' tests/bench/rows.csv)
if [ "$shown" != "$known" ]; then
    printf '%s has these rows:\n%s\n\ntests/bench/rows.csv has these:\n%s\n' "$page" "$shown" "$known" >&2
    exit 1
fi
