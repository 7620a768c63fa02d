#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# make_sbom.sh SBOM LIST PROGRAM...: writes the list that the package build makes of the programs.
set -eu
command -v dpkg-query >/dev/null || { echo "dpkg-query is not installed" && exit 77; }
sbom=$1 list=$2
shift 2
"$sbom" dpslaved 0 "$(dpkg --print-architecture)" libcli11-dev,libtomlplusplus-dev,nlohmann-json3-dev "$@" > "$list"
