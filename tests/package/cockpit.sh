#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cockpit.sh ROOT: what cockpit-dpslaved installs is whole: each file of src/cockpit is in the package, what the page loads is
# there, and its policy forbids scripts and styles inside of it, of which it has none.
set -eu
cd "$1"
find src/cockpit -type f | sort >"${TMPDIR:-/tmp}/cockpit.$$"
trap 'rm -f "${TMPDIR:-/tmp}/cockpit.$$"' EXIT
# shellcheck disable=SC2046,SC2012 # patterns
ls $(sed 's/ .*//' debian/cockpit-dpslaved.install) | sort | diff "${TMPDIR:-/tmp}/cockpit.$$" - || { echo "not in the package" && exit 1; }
cd src/cockpit
for file in $(grep -oE '(src|href)="[^"]+"' index.html | cut -d'"' -f2) $(sed -nE 's/^.*from "([^"]+)".*$/\1/p' ./*.js); do
    case $file in
        ../base1/cockpit.js | ../manifests.js) ;; # Cockpit's own
        *) [ -e "$file" ] || { echo "the page loads $file, which is not there" && exit 1; } ;;
    esac
done
! grep -nE '<script>|<style|[ "]style=| on[a-z]+=' index.html || { echo "the policy forbids this" && exit 1; }
! grep -nE 'innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(' ./*.js || { echo "text of the plant must stay text" && exit 1; }
python3 -c 'import json; assert "unsafe" not in json.load(open("manifest.json"))["content-security-policy"]'
