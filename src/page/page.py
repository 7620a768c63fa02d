#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""page.py ROOT CORE OUT: puts the configurator's page together, one file that needs no other

ROOT   the project's folder
CORE   the libraries as WebAssembly (src/page/CMakeLists.txt)
OUT    the page to write

The page opens from a disk without a network, so everything stands in it: the script that esbuild bundles, the style, the
WebAssembly and the project's files, the last two deflated. Its content security policy names the hashes of script and style,
and allows no connection to anywhere.
"""
import base64
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import zlib

FLOOR = "chrome109,firefox115"  # the newest browsers of Windows 7 machines


def block(octets: bytes) -> str:
    """base64 of a raw deflate stream, as core.js reads it."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.b64encode(packer.compress(octets) + packer.flush()).decode("ascii")


def digest(text: str) -> str:
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii") + "'"


def bundle(script: pathlib.Path) -> str:
    """The script and what it imports, in the language of the oldest browser. esbuild names each part in a comment, relative to the
    folder that it runs in: in that of the script the names are the same wherever the project lies."""
    return subprocess.run(
        ["esbuild", script.name, "--bundle", "--format=iife", f"--target={FLOOR}", "--charset=utf8", "--log-level=warning"],
        check=True, stdout=subprocess.PIPE, text=True, cwd=script.parent).stdout


def project_files(root: pathlib.Path) -> dict[str, str]:
    """By the names that docs/internals/configurator-calls.md gives them."""
    files = {}
    for folder, pattern in [("config/profiles", "*.toml"), ("config/tags", "*.csv"), ("gsd/mappings", "*.toml")]:
        for path in sorted((root / folder).glob(pattern)):
            files[f"{pathlib.Path(folder).name}/{path.name}"] = path.read_text(encoding="utf-8")
    files["index.txt"] = "".join(name + "\n" for name in files)
    return files


def main() -> int:
    if len(sys.argv) != 4:
        print(__doc__, file=sys.stderr)
        return 2
    root, core, out = (pathlib.Path(word) for word in sys.argv[1:])
    source = root / "src" / "page"
    script = bundle(source / "main.js")
    style = "".join(path.read_text(encoding="utf-8") for path in sorted((source / "style").glob("*.css")))
    if "</script" in script.lower() or "</style" in style.lower():
        sys.exit("page.py: the script or the style would end its own element")
    policy = "; ".join([
        "default-src 'none'", f"script-src {digest(script)} 'wasm-unsafe-eval'", f"style-src {digest(style)}",
        "img-src data: blob:", "base-uri 'none'", "form-action 'none'"])
    parts = {
        "policy": policy, "style": style, "script": script, "core": block(core.read_bytes()),
        "files": block(json.dumps(project_files(root), ensure_ascii=False).encode()),
    }
    page = (source / "index.html").read_text(encoding="utf-8")
    if sorted(re.findall("@([a-z]+)@", page)) != sorted(parts):
        sys.exit("page.py: src/page/index.html must have each of these once: " + ", ".join(f"@{name}@" for name in parts))
    page = re.sub("@([a-z]+)@", lambda found: parts[found[1]], page)
    out.write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
