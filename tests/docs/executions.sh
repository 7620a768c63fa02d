#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# executions.sh ROOT: docs/internals/fuzzing.md has the sums of tests/fuzz/executions.csv.
set -eu
cd "$1"
tools/fuzz --sum | while read -r row; do
    grep -qxF "$row" docs/internals/fuzzing.md || { echo "docs/internals/fuzzing.md lacks what tools/fuzz --sum prints: $row" >&2 && exit 1; }
done
