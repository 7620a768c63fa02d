#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# sbom.sh LIST PROGRAM...: fails unless the SPDX list has exactly the packages of the libraries that ldd finds for the programs,
# with the versions that are installed.
set -eu
command -v dpkg-query >/dev/null && command -v ldd >/dev/null || { echo "dpkg-query or ldd is not installed" && exit 77; }
list=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

ldd "$@" | grep -oE '/[^ ]+\.so[^ ]*' | sort -u | while read -r library; do
    # A package may own it by the name of before /lib became /usr/lib.
    dpkg-query --search "$library" 2>/dev/null || dpkg-query --search "${library#/usr}" 2>/dev/null ||
        dpkg-query --search "/usr$library"
done | sed 's/: .*//' | sort -u | xargs dpkg-query --show --showformat '${Package} ${Version}\n' | sort -u > "$scratch/loaded"

python3 - "$list" > "$scratch/listed" <<'END'
import json, sys
document = json.load(open(sys.argv[1]))
loads = {one["relatedSpdxElement"] for one in document["relationships"] if one["relationshipType"] == "DYNAMIC_LINK"}
print("\n".join(sorted(f'{one["name"]} {one["versionInfo"]}' for one in document["packages"] if one["SPDXID"] in loads)))
END
[ -s "$scratch/loaded" ] || { echo "ldd finds no library" && exit 1; }
LC_ALL=C sort -o "$scratch/loaded" "$scratch/loaded"
LC_ALL=C sort -o "$scratch/listed" "$scratch/listed"
diff "$scratch/loaded" "$scratch/listed" || { echo "< is loaded, > is in the list" && exit 1; }
grep -q '"STATIC_LINK"' "$list" || { echo "the libraries that are headers are missing" && exit 1; }
