#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# includes.sh ROOT LIBRARY [TABLE]: fails, with file and line, if a source of LIBRARY includes what the table of the
# libraries (src/libraries.txt) does not let it open. LIBRARY/ROOM: a folder of a library, which has a row of its own. Fails too
# if LIBRARY may open what has its row further down: so there is no circle.
set -eu
library=$2
whole=${library%%/*}
table=$(realpath "${3:-$1/src/libraries.txt}")
cd "$1"

row=$(sed -n "\\,^$library *|,p" "$table")
[ -n "$row" ] || { echo "$table has no row for $library" >&2; exit 2; }
above=$(sed -n "\\,^$library *|,q; s/^\([a-z/]*\) *|.*/\1/p" "$table")
column() { printf '%s\n' "$row" | cut -d'|' -f"$1" | xargs; }
alternatives() { sed -E 's/[.+]/\\&/g; s/ +/|/g'; }

kind=$(column 2)
for opened in $(column 3 | sed -E 's,/[a-z_]+[.]hpp,,g'); do
    printf '%s\n' "$above" | grep -qx "$opened" || { echo "$table: $library opens $opened, which has no row above it" >&2; exit 1; }
done
# base -> base/.*, app/links -> app/links/.*; fdl/sap_user.hpp stays
all_of='s,(^| )([a-z]+(/[a-z]+)?)( |$),\1\2/@\4,g'
public=$(column 3 | sed -E "$all_of; $all_of" | alternatives | sed 's/@/.*/g')
rooms=$(printf '%s\n' "$public" | tr '|' '\n' | grep "^$whole/" | paste -sd'|')
other=$(column 4 | alternatives | sed 's/linux/.*\\.h/')

# Headers of the standard library that bring clocks, threads, files or streams.
impure='thread|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier|stop_token|coroutine|random'
impure="$impure|ctime|cstdio|csignal|iostream|istream|ostream|sstream|fstream|iomanip|syncstream|filesystem"
case $kind in
    pure) forbidden=$impure ;;
    files) forbidden='thread|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier|random|csignal|iostream' ;;
    system) forbidden='$^' ;;
    scripts) forbidden='' ;;
    *) echo "$table: the kind of $library is $kind: pure, files, system or scripts" >&2; exit 2 ;;
esac

folders=src/$library
[ ! -d "include/dpslave/$library" ] || folders="$folders include/dpslave/$library"
depth=9
! grep -q "^$library/" "$table" || depth=1 # its rooms have rows of their own, and nothing outside of them opens one
files=$(find $folders -maxdepth $depth -name '*.hpp' -o -maxdepth $depth -name '*.cpp')
if [ "$kind" = scripts ]; then
    [ -z "$files" ] || { printf '%s has sources in C++, and its kind is scripts:\n%s\n' "$library" "$files" >&2; exit 1; }
    exit 0
fi
[ -n "$files" ] || { echo "$library has no sources" >&2; exit 2; }

# file:line:name, one an include; name keeps its first quote or bracket.
includes=$(grep -nHE '^[[:space:]]*#[[:space:]]*include' $files |
           sed -E 's/^([^:]+:[0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*(["<][^">]*)[">].*$/\1:\2/')
offending=$(printf '%s\n' "$includes" | while IFS= read -r line; do
    name=${line#*:*:}
    file=${line%%:*}
    case $name in
        \"dpslave/*) printf '%s\n' "${name#?}" | grep -qE "^dpslave/($whole/.*|$public)\$" && continue ;;
        \"*) # a private header: a public one opens none
            [ "${file#include/}" = "$file" ] && case $name in
                */*) printf '%s\n' "${name#?}" | grep -qE "^($library/.*|$rooms)\$" && [ -f "src/${name#?}" ] ;;
                *) [ -f "${file%/*}/${name#?}" ] ;;
            esac && continue ;;
        \<*[./]*) printf '%s\n' "${name#?}" | grep -qE "^($other)(/.*)?\$" && continue ;;
        \<*) printf '%s\n' "${name#?}" | grep -qE "^($forbidden)\$" || continue ;;
    esac
    printf '%s\n' "$line"
done)
if [ -n "$offending" ]; then
    echo "$library opens what it may not:" >&2
    printf '%s\n' "$offending" | sed -E 's/^([^:]+:[0-9]+):./  \1: /' >&2
    exit 1
fi
