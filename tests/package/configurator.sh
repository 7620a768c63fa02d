#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# configurator.sh FOLDER: what dpslaved-configurator installs below FOLDER: the page, the menu entry, the icon, the man page
# and Cockpit's manifest. The page asks nothing of the network, and what the menu opens is there.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
cd "$1"
fail() {
    echo "$*"
    exit 1
}
page=usr/share/dpslaved/configurator.html
cockpit=usr/share/cockpit/dpslaved-configurator
entry=usr/share/applications/dpslaved-configurator.desktop

# The folder of the package has its own documents and Debian's beside these.
found=$(find . \( -type f -o -type l \) ! -path './usr/share/doc/*' ! -path './usr/share/lintian/*' ! -path './DEBIAN/*' | sed 's,^\./,,; s,\.gz$,,' | sort)
meant=$(printf '%s\n' "$page" "$entry" "$cockpit/configurator.html" "$cockpit/manifest.json" \
    usr/share/icons/hicolor/scalable/apps/dpslaved-configurator.svg usr/share/man/man7/dpslaved-configurator.7 | sort)
[ "$found" = "$meant" ] || fail "there is: $found"

policy=$(grep -oE 'Content-Security-Policy" content="[^"]+"' "$page") || fail "the page has no content security policy"
case $policy in *"default-src 'none'"*) ;; *) fail "the page may ask the network: $policy" ;; esac
! grep -qE '<(script|link|img|iframe)[^>]+(src|href)="?(https?:)?//' "$page" || fail "the page loads something from elsewhere"
! grep -qF "$root" "$page" || fail "a path of the machine that built it is in the page"
size=$(wc -c <"$page")
[ "$size" -gt 100000 ] || fail "the page has $size octets: too few to have the libraries"
[ "$size" -le 800000 ] || fail "the page has $size octets: 800 000 at most, so that it opens at once on an old PC"

[ "$(sed -n 's/^Exec=xdg-open //p' "$entry")" = "/$page" ] || fail "the menu opens another file"
! command -v desktop-file-validate >/dev/null || desktop-file-validate "$entry" || fail "the menu entry is faulty"
python3 - "$page" "$cockpit" <<'END'
import json, pathlib, re, sys, xml.dom.minidom
page, cockpit = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
xml.dom.minidom.parse("usr/share/icons/hicolor/scalable/apps/dpslaved-configurator.svg")
assert (cockpit / "configurator.html").resolve() == page.resolve(), "Cockpit shows another page"
policy = json.loads((cockpit / "manifest.json").read_text())["content-security-policy"]
assert "'wasm-unsafe-eval'" in policy, policy
own = re.search('Content-Security-Policy" content="([^"]+)"', page.read_text()).group(1)
hashes = re.findall("'sha256-[^']+'", own)
assert len(hashes) >= 2 and hashes == re.findall("'sha256-[^']+'", policy), (own, policy)
END
