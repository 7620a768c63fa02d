#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make.py: writes the captures of worked/ and found/, and their pages. make.py --check: are the files what it writes?"""
import pathlib
import sys

import found
import worked

PAGE = "README.md"
FOLDER = pathlib.Path(__file__).parent
KINDS = {
    "worked": (worked, "Captures of the worked examples",
               "Each file is an example that a manual or the wire reference prints, with the octets that stand there. What the "
               "example leaves open (address, watchdog, scale of a drive) is chosen."),
    "found": (found, "Captures of faults that were found",
              "Each file is what one fault of this project looked like on the bus or on the drive line. The answers are the right "
              "ones."),
}
HOW = """`make.py` writes the files and this page: change `{module}.py`, then run `tests/captures/make.py`. A test compares.
The stations are those of `../stations`, named by the first part of a file name. Times are made up: only order and pauses count."""


def page(kind):
    module, title, text = KINDS[kind]
    rows = [f"| {one.name} | {one.shows} | {one.source} |" for one in module.captures()]
    return "\n".join([f"# {title}", "", text, "", HOW.format(module=kind), "",
                      "| capture | what it shows | source |", "|---|---|---|", *rows, *module.LEFT_OUT, ""])


def files():
    made = {}
    for kind, (module, _, _) in KINDS.items():
        for one in module.captures():
            assert f"{kind}/{one.name}.pcapng" not in made, one.name
            made[f"{kind}/{one.name}.pcapng"] = one.pcapng()
        made[f"{kind}/{PAGE}"] = page(kind).encode()
    return made


def main():
    made = files()
    there = {str(path.relative_to(FOLDER)) for kind in KINDS for path in (FOLDER / kind).iterdir()}
    if sys.argv[1:] == ["--check"]:
        other = sorted(name for name in made.keys() | there
                       if name not in made or name not in there or (FOLDER / name).read_bytes() != made[name])
        for name in other:
            print(f"tests/captures/{name} is not what make.py writes: run tests/captures/make.py")
        return 1 if other else 0
    if sys.argv[1:]:
        print(__doc__, file=sys.stderr)
        return 2
    for name in there - made.keys():
        (FOLDER / name).unlink()
    for name, content in made.items():
        (FOLDER / name).write_bytes(content)
    return 0


sys.exit(main())
