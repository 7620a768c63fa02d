#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# verify.sh UNIT INSTALLED BUILT: fails if systemd says anything about the unit. The programs, which will lie in
# INSTALLED, are looked for in BUILT.
set -eu
command -v systemd-analyze >/dev/null || { echo "systemd-analyze is not installed" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unit=$work/$(basename "$1")
sed -E "s#^(Exec[A-Za-z]+=!?)$2/#\1$3/#" "$1" >"$unit"
grep -q "^ExecStart=$3/" "$unit" || { echo "ExecStart does not lie in $2" && exit 1; }
# The manuals are not installed at the time of the build. An unknown key is only said, not an error.
said=$(systemd-analyze verify --man=no "$unit" 2>&1) || { echo "$said" && exit 1; }
[ -z "$said" ] || { echo "$said" && exit 1; }
