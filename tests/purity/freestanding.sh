#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# freestanding.sh ROOT LIBRARY COMPILER...: compiles the sources of LIBRARY, all in one unit, as for a machine
# without an operating system: without exceptions and RTTI. Exit status 77: there is no such compiler.
set -eu
root=$1 library=$2
shift 2
if ! command -v "$1" >/dev/null; then
    echo "skipped: $1 is missing: apt-get install gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib"
    exit 77
fi
find "$root/src/$library" -name '*.cpp' | sort | sed 's/.*/#include "&"/' |
    "$@" -std=c++20 -O1 -Wall -Wextra -Werror -Wno-psabi -ffreestanding -fno-exceptions -fno-rtti -I"$root/include" -I"$root/src" \
        -x c++ -c - -o /dev/null
