# SPDX-License-Identifier: Apache-2.0
"""Joins what the programs of tools/run bench have found into one table, and judges it.

Each FILE is what one program wrote: {"rows": [{"id", "metric", "blocks", "ratio", "aa", "aa_ratio", "aa_limits", "blocks_needed",
"limit", "direction"}], "curves": {}}. Exit status: 0 every row is kept, 1 a row is broken or missing, 77 the machine was too noisy.
"""

import argparse
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
OF_ANOTHER_COMMAND = "paced line"  # of tools/run refresh, which takes half a minute that the tests do not have


def known_rows() -> list[tuple[str, str]]:
    """(id, metric) of every row, in the order of the table."""
    lines = (HERE / "rows.csv").read_text(encoding="utf-8").splitlines()
    return [tuple(line.split(";", 1)) for line in lines if not line.startswith("#")]


def verdict(row: dict) -> str:
    if len(row["blocks"]) < row["blocks_needed"]:  # the machine was too slow for all of them
        return "too noisy"
    low, high = row["aa_limits"] or (0, float("inf"))
    if row["aa_ratio"] is not None and not low <= row["aa_ratio"] <= high:
        return "too noisy"
    kept = row["ratio"] >= row["limit"] if row["direction"] == "min" else row["ratio"] <= row["limit"]
    return "kept" if kept else "BROKEN"


def number(value: float) -> str:
    return f"{value:.1f}" if value >= 10 else f"{value:.3f}"


def cells(row: dict) -> list[str]:
    error = "-" if row["aa_ratio"] is None else number(row["aa_ratio"])
    limit = ("≥ " if row["direction"] == "min" else "≤ ") + format(row["limit"], "g")
    return [row["id"], row["metric"], number(row["ratio"]), error, limit, verdict(row)]


def in_order(rows: list[dict]) -> tuple[list[dict], list[str]]:
    """The rows as the table has them, and what is wrong with their names."""
    known = known_rows()
    by_name = {(row["id"], row["metric"]): row for row in rows}
    faults = [f"{id} {metric}: no program measured it" for id, metric in known if (id, metric) not in by_name]
    faults += [f"{id} {metric}: is not in rows.csv" for id, metric in by_name if (id, metric) not in known]
    return [by_name[name] for name in known if name in by_name], faults


def joined(found: list[dict]) -> dict:
    """The curves of all programs; lists of one name are one list."""
    curves = {}
    for name, curve in (item for one in found for item in one.items()):
        curves[name] = curves[name] + curve if name in curves else curve
    return curves


def print_table(rows: list[dict]) -> None:
    print(f"{'':<4} {'':<68} {'ratio':>8} {'A/A':>8} {'limit':>8}")
    for id, metric, ratio, error, limit, judged in map(cells, rows):
        print(f"{id:<4} {metric:<68} {ratio:>8} {error:>8} {limit:>8}  {judged}")


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/run bench", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("file", nargs="+", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path, help="one file with all rows and curves")
    parser.add_argument("--names", action="store_true", help="compares the names of the rows only, without those of tools/run refresh")
    words = parser.parse_args()

    found = [json.loads(file.read_text(encoding="utf-8")) for file in words.file]
    rows, faults = in_order([row for one in found for row in one["rows"]])
    if words.names:
        faults = [fault for fault in faults if not fault.endswith(f"{OF_ANOTHER_COMMAND}: no program measured it")]
        print("\n".join(faults))
        return 1 if faults else 0
    curves = joined([one["curves"] for one in found])
    print_table(rows)
    print("\n".join(faults))
    if words.json:
        words.json.write_text(json.dumps({"rows": rows, "curves": curves}, indent=1) + "\n", encoding="utf-8")
    judged = [verdict(row) for row in rows]
    if faults or "BROKEN" in judged:
        return 1
    return 77 if "too noisy" in judged else 0


if __name__ == "__main__":
    sys.exit(main())
