#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# first_configuration.sh ROOT DPSLAVED: fails if the first configuration of README.md is not accepted, or
# with another warning than that the mnemonic rule of its profile is assumed.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# block KIND: the first block of that kind in the section.
block() {
    awk -v fence="^\140\140\140$1\$" '
        /^## / { in_section = /^## A first configuration/ }
        in_section && $0 ~ fence { inside = 1; next }
        inside && /^\140\140\140/ { exit }
        inside' "$root/README.md"
}
root=$1
block toml > "$scratch/my.toml"
block csv > "$scratch/my-590.csv"
[ -s "$scratch/my.toml" ] && [ -s "$scratch/my-590.csv" ] || { echo "README.md has no first configuration" && exit 1; }
said=$("$2" --config "$scratch/my.toml" --profiles "$root/config/profiles" --check 2>&1) && status=0 || status=$?
others=$(printf '%s\n' "$said" | grep -v 'the mnemonic rule of profile "590" is assumed' || true)
[ "$status" = 0 ] && [ -n "$said" ] && [ -z "$others" ] && exit 0
echo "README.md, first configuration: status $status: $said"
exit 1
