#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# verify_timer.sh TIMER SERVICE INSTALLED BUILT: fails if systemd says anything about the timer with its service, whose
# program, which will lie in INSTALLED, is looked for in BUILT.
set -eu
command -v systemd-analyze >/dev/null || { echo "systemd-analyze is not installed" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$1" "$work"
sed -E "s#^(Exec[A-Za-z]+=!?)$3/#\1$4/#" "$2" >"$work/$(basename "$2")"
said=$(SYSTEMD_UNIT_PATH="$work:" systemd-analyze verify --man=no "$work/$(basename "$1")" 2>&1) || { echo "$said" && exit 1; }
[ -z "$said" ] || { echo "$said" && exit 1; }
