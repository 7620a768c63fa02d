#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# products.sh ROOT: fails if the code of fdl or dp knows a product by its name or ident. Comments may say where a rule
# comes from.
set -eu
cd "$1"
names='584|590|605|620|690|955|2404|2408|6053|6055|6204|0533|1649|eurotherm|parker|technology|option.?board|tec.?option'
found=$(find src/fdl src/dp include/dpslave/fdl include/dpslave/dp -name '*.?pp' 2>/dev/null | sort |
    while read -r file; do sed 's|//.*||' "$file" | grep -niE "$names" | sed "s|^|$file:|" || true; done)
if [ -n "$found" ]; then
    echo "a product in a library that must not know any:" >&2
    printf '%s\n' "$found" >&2
    exit 1
fi
