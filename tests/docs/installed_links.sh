#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# installed_links.sh CMAKE BUILD PYTHON: fails if a page as it is installed has a link that leads nowhere.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
here=$(cd "$(dirname "$0")" && pwd)
# The rules of the top folder only: the programs need not be built.
DESTDIR=$scratch "$1" -D CMAKE_INSTALL_LOCAL_ONLY=1 -P "$2/cmake_install.cmake" >/dev/null
pages=$(find "$scratch" -path '*/dpslaved/README.md' -path '*/doc/*')
[ -n "$pages" ] || { echo "no page was installed" && exit 1; }
"$3" "$here/pages.py" links "$(dirname "$pages")"
