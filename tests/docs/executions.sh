#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# executions.sh ROOT: docs/internals/fuzzing.md has the sums of tests/fuzz/executions.csv, and the corpus is not larger than it says.
set -eu
cd "$1"
sums=$(tools/fuzz --sum)
echo "$sums" | while read -r row; do
    grep -qxF "$row" docs/internals/fuzzing.md || { echo "docs/internals/fuzzing.md lacks what tools/fuzz --sum prints: $row" >&2 && exit 1; }
done
octets=$(for archive in tests/fuzz/corpus/*.tar.gz; do tar -xzOf "$archive"; done | wc -c)
[ "$octets" -le $((2 * 1024 * 1024)) ] || { echo "tests/fuzz/corpus has $octets octets, more than 2 MiB" >&2 && exit 1; }
