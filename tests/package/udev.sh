#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# udev.sh RULES: fails if udev does not understand them, or finds their style wanting.
set -eu
udevadm verify --help >/dev/null 2>&1 || { echo "udevadm verify (systemd 254) is not installed" && exit 77; }
udevadm verify --resolve-names=never "$1"
