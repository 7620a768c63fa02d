#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# configurator_installed.sh CMAKE BUILD CHECK: installs the configurator out of a build folder, and lets CHECK judge it.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
DESTDIR=$work "$1" --install "$2" --component configurator --prefix /usr >/dev/null
"$3" "$work"
