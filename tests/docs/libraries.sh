#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# libraries.sh ROOT: docs/internals/architecture.md says of each library what the table says that it may open, in the same order. Of
# the rooms of a library it says which rooms. Each folder has its row.
set -eu
cd "$1"
row() { sed -E 's/ *\| */|/g; s/ +$//'; }
# rows_of HEAD: the table of the page whose first column is HEAD.
rows_of() { sed -n "/^| $1 |/,/^\$/p" docs/internals/architecture.md | sed '1,2d;$d' | row | sed 's/^|//' | cut -d'|' -f1,2; }
compare() {
    [ "$1" = "$2" ] || { printf 'docs/internals/architecture.md says:\n%s\n\nsrc/libraries.txt says:\n%s\n' "$1" "$2" >&2; exit 1; }
}

ruled=$(grep '^[a-z]' src/libraries.txt | row | cut -d'|' -f1,3)
rooms=$(printf '%s\n' "$ruled" | grep '^[a-z]*/' | sed -E 's/([|]| )[a-z]+( [a-z]+)*$/\1/; s/ $//')
compare "$(rows_of library)" "$(printf '%s\n' "$ruled" | grep -v '^[a-z]*/')"
compare "$(rows_of room)" "$rooms"
for folder in src/*/ $(printf '%s\n' "$rooms" | sed -E 's,/.*,,; s,.*,src/&/*/,' | sort -u); do
    name=${folder#src/}
    printf '%s\n' "$ruled" | grep -q "^${name%/}|" || { echo "src/libraries.txt has no row for $folder" >&2; exit 1; }
done
