#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""measured_rows.py ROOT: the tables of measured values have the rows that the commands print, in their order: soak, attacks,
recovery (docs/internals/soak.md), coverage (coverage.md) and refresh (performance.md). The values are those of the last run
that was written there, and are not compared. First it makes sure that it would notice.
"""
import pathlib
import re
import sys

STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')


def strings(text):
    """What the string literals of C++ stand for, those that follow each other joined."""
    return "".join(STRING.findall(text)).replace("\\n", "\n")


def between(text, begins, ends):
    return text.split(begins, 1)[1].split(ends, 1)[0]


def first_cells(table, count=1):
    """The rows of a table without its values."""
    rows = [line.strip().strip("|").split("|") for line in table.split("\n") if line.startswith("|")]
    return [tuple(cell.strip() for cell in row[:count]) for row in rows if not set("".join(row)) <= set("- ")]


def table_below(page, words):
    """The table that comes next behind these words."""
    below = page.split(words, 1)[1]
    return re.search(r"^\|.*?(?=^[^|]|\Z)", below, re.M | re.S).group()


def whole_head(table):
    return [tuple(cell.strip() for cell in table.split("\n")[0].strip("|").split("|"))]


def soak(root):
    source = (root / "tests/endurance/soak.cpp").read_text()
    return first_cells(strings(between(source, "void show_result", "r.telegrams,")))


def attacks(root):
    source = (root / "tests/endurance/attack.cpp").read_text()
    head = whole_head(strings('"| attack |' + between(source, 'fmt::print("| attack |', ");")))
    return head + [(what,) for what in re.findall(r'\{\.what = "([^"]*)"', source)]


def recovery(root):
    source = (root / "tests/endurance/recovery.cpp").read_text()
    faults = dict(re.findall(r'case Fault::(\w+): return "([^"]*)"', source))
    order = re.findall(r"Fault::(\w+)", between(source, "kFaults{", "}"))
    body = between(source, "void print(Fault fault", "std::fflush")
    at_an_end = between(body, "Fault::power_lost) {", "}")
    of_ends = re.findall(r'print_row\(fault, "([^"]*)"', at_an_end)
    of_all = re.findall(r'print_row\(fault, "([^"]*)"', body.replace(at_an_end, ""))
    return [(faults[fault], what) for fault in order for what in (of_ends if fault != "power_lost" else []) + of_all]


def coverage(root):
    source = (root / "tools/coverage").read_text()
    head = whole_head(re.search(r'"\\n(\| library[^"]*?)\\n', source).group(1))
    return head + [(library,) for library in re.search(r"^libraries=\((.*)\)$", source, re.M).group(1).split()]


def refresh(root):
    source = (root / "tools/bench-refresh").read_text()
    head = whole_head(re.search(r"'(\| parameters \|.*\|)\\n'", source).group(1))
    counts = re.search(r"^counts=\(([\d ]+)\)", source, re.M).group(1).split()
    return head + [(n,) for n in counts]


def shown(pages):
    """What the pages have, by the names of their tables."""
    tables = {
        "soak": first_cells(table_below(pages["soak"], "This is the run of")),
        "recovery": first_cells(table_below(pages["soak"], "## Recovery"), 2)[1:],
    }
    for name, page, words in (("attacks", "soak", "These are the limits"), ("coverage", "coverage", "## What was counted"),
                              ("refresh", "performance", "## Refresh between gateway and drive")):
        table = table_below(pages[page], words)
        tables[name] = whole_head(table) + first_cells(table)[1:]
    return tables


def faults(root, pages):
    there = shown(pages)
    for name, command in (("soak", soak), ("attacks", attacks), ("recovery", recovery), ("coverage", coverage),
                          ("refresh", refresh)):
        printed = command(root)
        if len(printed) < 4:
            yield f"{name}: the rows of the command are not found any more"
        elif there[name] != printed:
            yield f"{name}: the page has the rows\n    {there[name]}\nand the command prints\n    {printed}"


def main():
    root = pathlib.Path(sys.argv[1])
    pages = {name: (root / f"docs/internals/{name}.md").read_text() for name in ("soak", "coverage", "performance")}
    damages = (("soak", "| start-ups |", "| starts |"), ("soak", "| 1000 connections |", "| 100 connections |"),
               ("soak", "| kill -9 | from there", "| kill | from there"), ("coverage", "| gsd |", "| gds |"),
               ("performance", "\n| 7 | 56", "\n| 8 | 56"))
    for name, is_so, damaged in damages:
        if len(list(faults(root, {**pages, name: pages[name].replace(is_so, damaged)}))) != 1:
            sys.exit(f"this check is blind or sees what is not there: {is_so}")
    found = list(faults(root, pages))
    print("\n".join(found))
    sys.exit(bool(found))


main()
