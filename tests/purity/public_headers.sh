#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# public_headers.sh ROOT: fails if a header lies in include/dpslave that no source of another library includes, and that no
# header needs which such a source includes.
set -eu
cd "$1"

# FILE:"dpslave/LIBRARY/HEADER" -> include/dpslave/LIBRARY/HEADER, unless FILE is of the same library.
needed=$(grep -rHoE '"dpslave/[^"]+"' src | awk -F'[:"]' '
    { split($1, file, "/"); split($3, header, "/") }
    file[2] != header[2] { print "include/" $3 }' | sort -u)
while :; do
    more=$({ printf '%s\n' "$needed"
             printf '%s\n' "$needed" | xargs grep -shoE '"dpslave/[^"]+"' /dev/null | sed -E 's,"(.*)",include/\1,'; } | grep . | sort -u)
    [ "$more" != "$needed" ] || break
    needed=$more
done
idle=$(find include/dpslave -name '*.hpp' | sort | grep -vxF "${needed:-none}" || true)
if [ -n "$idle" ]; then
    echo "public headers that only their own library includes; they lie beside their .cpp:" >&2
    printf '%s\n' "$idle" | sed 's/^/  /' >&2
    exit 1
fi
