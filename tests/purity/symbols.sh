#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# symbols.sh NM LIBRARY ALLOWED: fails, with their names, if LIBRARY wants symbols that ALLOWED (an extended regular
# expression for whole demangled names) does not cover. A pure library makes no system call, reads no clock, starts no
# thread and, where that is demanded, allocates nothing: what it never names it cannot do.
set -eu
nm=$1 library=$2 allowed=$3

undefined=$("$nm" -uC "$library" | sed -n 's/^ *[Uw] //p' | sort -u)
if [ -z "$undefined" ]; then
    echo "$library: no undefined symbols at all: that is no library of the project" >&2
    exit 2
fi
offending=$(printf '%s\n' "$undefined" | grep -vE "^($allowed)\$" || true)
if [ -n "$offending" ]; then
    echo "$library wants what a pure library may not have:" >&2
    printf '%s\n' "$offending" | sed 's/^/  /' >&2
    exit 1
fi
