#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# reliability.sh ROOT: fails if docs/internals/reliability.md has a row without a test, or a test has no row. A test of a row begins
# with its number: TEST_F(Suite, F07_…), prove "F26: …" in tests/machine. Values are not compared.
set -eu
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
table=docs/internals/reliability.md

tests() { # FOLDER: the rows that have a test
    {
        grep -rhoE 'TEST(_F|_P)?\([A-Za-z0-9_]+, *F[0-9][0-9]_' "$1" --include='*.cpp' | sed 's/.*\(F[0-9][0-9]\)_/\1/'
        grep -rhoE '^prove "F[0-9][0-9]: ' "$1/machine" | sed 's/.*\(F[0-9][0-9]\): /\1/'
    } | sort -u
}
rows() { # TABLE
    grep -oE '^\| F[0-9][0-9] \|' "$1" | tr -d '| ' | sort
}
faults_of() { # TABLE
    rows "$1" >"$scratch/rows"
    uniq -d "$scratch/rows" | sed 's/$/: the row stands more than once/'
    uniq "$scratch/rows" | comm -23 - "$scratch/tests" | sed 's/$/: no test begins with the number of this row/'
    uniq "$scratch/rows" | comm -13 - "$scratch/tests" | sed 's/$/: a test has this number, and there is no such row/'
    awk -F '|' '/^\| F[0-9][0-9] \|/ && NF != 8 { print $2 ": the row has " NF - 2 " columns, not 6" }
        /^\| F[0-9][0-9] \|/ { for (i = 3; i <= 7; ++i) if ($i ~ /^ *$/) print $2 ": column " i - 1 " is empty" }' "$1"
}
tests tests >"$scratch/tests"

# It would notice.
sed -E '/^\| F03 /d; s/^\| F04 \|/| F99 |/; /^\| F05 /p; s/^(\| F06 \|)[^|]*/\1 /; s/^\| F07 \|/& x |/' "$table" >"$scratch/damaged.md"
noticed=$(faults_of "$scratch/damaged.md" | wc -l)
[ "$noticed" -eq 6 ] || { echo "this check is blind: it noticed $noticed of 6" >&2 && exit 2; }

faults_of "$table" >"$scratch/faults"
[ ! -s "$scratch/faults" ] || { sed "s|^|$table: |" "$scratch/faults" >&2 && exit 1; }
