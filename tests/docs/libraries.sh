#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# libraries.sh ROOT: docs/internals/architecture.md says of each library what the table says that it may open, in the same order.
set -eu
cd "$1"
row() { sed -E 's/ *\| */|/g; s/ +$//'; }

table=$(sed -n '/^| library |/,/^$/p' docs/internals/architecture.md | sed '1,2d;$d' | row | sed 's/^|//' | cut -d'|' -f1,2)
ruled=$(grep '^[a-z]' src/libraries.txt | row | cut -d'|' -f1,3)
[ -n "$table" ] || { echo "docs/internals/architecture.md has no table of the libraries" >&2; exit 1; }
if [ "$table" != "$ruled" ]; then
    printf 'docs/internals/architecture.md says:\n%s\n\nsrc/libraries.txt says:\n%s\n' "$table" "$ruled" >&2
    exit 1
fi
for folder in src/*/; do
    name=$(basename "$folder")
    printf '%s\n' "$ruled" | grep -q "^$name|" || { echo "src/libraries.txt has no row for $folder" >&2; exit 1; }
done
