#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# sysusers.sh FILE: fails if it does not make the user and put it into the group of the serial ports, and the group of the devices.
set -eu
command -v systemd-sysusers >/dev/null || { echo "systemd-sysusers is not installed" && exit 77; }
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/etc" "$root/usr/lib/sysusers.d"
cp "$1" "$root/usr/lib/sysusers.d/dpslaved.conf"
printf 'root:x:0:\ndialout:x:20:\n' >"$root/etc/group"
printf 'root:x:0:0:root:/root:/bin/sh\n' >"$root/etc/passwd"
systemd-sysusers --root="$root" dpslaved.conf
grep -E '^dpslaved:.*:/nonexistent:.*nologin$' "$root/etc/passwd"
grep -E '^dpslaved:' "$root/etc/group"
grep -E '^dialout:x:20:dpslaved$' "$root/etc/group"
grep -E '^dpslaved-devices:x:[0-9]+:$' "$root/etc/group" # operators are not in it
