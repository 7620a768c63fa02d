#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# includes.sh ROOT ROOM: fails, with file and line, if a source of ROOM includes what the house does not let it open
# (docs/architecture.md).
set -eu
cd "$1"
room=$2

# Standard headers that bring clocks, threads, files or streams: nothing for a pure room.
impure='thread|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier|stop_token|coroutine|random'
impure="$impure|ctime|cstdio|csignal|iostream|istream|ostream|sstream|fstream|iomanip|syncstream|filesystem"
nothing='$^'

#   doors: of other rooms, under dpslave/.  outside: headers that are not the standard library's.
case $room in
    base)    doors=$nothing                                       outside=$nothing forbidden=$impure ;;
    fdl)     doors='base/.*'                                      outside=$nothing forbidden=$impure ;;
    dp)      doors='base/.*|fdl/sap_user\.hpp'                    outside=$nothing forbidden=$impure ;;
    tec)     doors='base/.*|dp/snapshot\.hpp|drive/poller\.hpp'   outside=$nothing forbidden=$impure ;;
    led)     doors='base/.*'                                      outside=$nothing forbidden=$impure ;;
    drive)   doors='base/.*'                                      outside=$nothing forbidden=$impure ;;
    gsd)     doors='base/.*'                                      outside=$nothing forbidden=$impure ;;
    profile) doors='base/.*|gsd/.*|dp/personality\.hpp|drive/(tag|poller)\.hpp|led/pattern\.hpp' outside='toml\+\+/.*|fcntl\.h|sys/stat\.h|unistd\.h' forbidden='thread|iostream' ;;
    io)      doors='base/.*'                                      outside='.*' forbidden=iostream ;;
    modbus)  doors='base/.*|drive/.*|io/.*'                       outside='modbus\.h' forbidden=iostream ;;
    control) doors='base/.*'                                      outside='.*' forbidden=iostream ;;
    *) echo "no rule for room $room" >&2; exit 2 ;;
esac

files=$(find "src/$room" "include/dpslave/$room" -name '*.hpp' -o -name '*.cpp')
[ -n "$files" ] || { echo "room $room has no sources" >&2; exit 2; }

# file:line:name, one an include; name keeps its first quote or bracket.
includes=$(grep -nHE '^[[:space:]]*#[[:space:]]*include' $files |
           sed -E 's/^([^:]+:[0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*(["<][^">]*)[">].*$/\1:\2/')
offending=$(printf '%s\n' "$includes" | while IFS= read -r line; do
    name=${line#*:*:}
    case $name in
        \"dpslave/*) printf '%s\n' "${name#?}" | grep -qE "^dpslave/($room/.*|$doors)\$" && continue ;;
        \"*) [ -f "src/$room/${name#?}" ] && continue ;;
        \<*[./]*) printf '%s\n' "${name#?}" | grep -qE "^($outside)\$" && continue ;;
        \<*) printf '%s\n' "${name#?}" | grep -qE "^($forbidden)\$" || continue ;;
    esac
    printf '%s\n' "$line"
done)
if [ -n "$offending" ]; then
    echo "room $room opens what it may not:" >&2
    printf '%s\n' "$offending" | sed -E 's/^([^:]+:[0-9]+):./  \1: /' >&2
    exit 1
fi
