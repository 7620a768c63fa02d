#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# gateway_needs.sh ROOT: what a gateway installs is built without the tools of the configurator, and the configurator is not
# built unless it is asked for.
set -eu
cd "$1"
needs=$(sed -n '/^Build-Depends:/,/^Build-Depends-Indep:/p' debian/control)
tools='clang|lld|wasi-libc|esbuild|wasm32'
! echo "$needs" | grep -E "^ *($tools)|wasm32" || { echo "these belong into Build-Depends-Indep" && exit 1; }
[ "$(sed -n '/^Build-Depends-Indep:/,/^$/p' debian/control | grep -cE "^ .*($tools)")" -ge 6 ]
grep -q '^option(DPSLAVE_CONFIGURATOR .* OFF)' tools/cmake/Page.cmake
