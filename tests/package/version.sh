#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# version.sh VERSION CHANGELOG: fails if the newest entry of the Debian changelog has another version than CMake, what
# tools/package adds for a Debian (~deb12u1) left out.
set -eu
newest=$(sed -n '1s/^[a-z]* (\([^)~]*\).*/\1/p' "$2")
[ "$newest" = "$1" ] || { echo "CMakeLists.txt says $1, debian/changelog says $newest" && exit 1; }
