#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cockpit_manifest.py PAGE OUT: writes the manifest with which Cockpit shows the configurator

Cockpit sends a content security policy of its own. It must name the hashes of the page's script and style, and
'wasm-unsafe-eval'. They are taken out of the policy that stands in the page. The page keeps that policy too: what it
forbids stays forbidden.
"""
import json
import pathlib
import re
import sys


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    page = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
    found = re.search(r'http-equiv="Content-Security-Policy" content="([^"]+)"', page)
    if not found:
        sys.exit("cockpit_manifest.py: the page has no content security policy")
    own = dict(part.strip().split(" ", 1) for part in found[1].split(";") if part.strip())
    policy = "; ".join(f"{name} {own[name]}" for name in ("script-src", "style-src", "img-src"))
    manifest = {
        "version": 0,
        "requires": {"cockpit": "239"},
        "tools": {"configurator": {"label": "GSD configurator", "order": 91}},
        "content-security-policy": policy,
    }
    pathlib.Path(sys.argv[2]).write_text(json.dumps(manifest, indent=4) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
