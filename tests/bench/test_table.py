# SPDX-License-Identifier: Apache-2.0
"""That the table of tools/bench is judged as its page says, and that the page gets it."""

import json
import pathlib
import tempfile
import unittest
from unittest import mock
from xml.etree import ElementTree

import pictures
import table


def row(name: tuple[str, str], ratio: float = 1.0, aa: float | None = 1.0, **more) -> dict:
    whole = {"id": name[0], "metric": name[1], "blocks": [ratio] * 21, "ratio": ratio, "aa": [] if aa is None else [aa] * 21,
             "aa_ratio": aa, "aa_limits": None if aa is None else [0.97, 1.03], "blocks_needed": 21, "limit": 1.05,
             "direction": "max"}
    return whole | more


class Table(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def status_of(self, changed: dict, *words: str, left_out: int = 0) -> int:
        """Of the whole table whose first row is `changed`; the last rows are left out."""
        names = table.known_rows()
        rows = [row(name) for name in names][: len(names) - left_out]
        file = self.folder / "rows.json"
        file.write_text(json.dumps({"rows": [rows[0] | changed, *rows[1:]], "curves": {}}), encoding="utf-8")
        with mock.patch("sys.argv", ["table.py", str(file), *words]), mock.patch("builtins.print"):
            return table.main()

    def test_a_row_above_its_limit_is_broken(self):
        self.assertEqual(self.status_of({}), 0)
        self.assertEqual(self.status_of({"ratio": 1.05}), 0)
        self.assertEqual(self.status_of({"ratio": 1.051}), 1)

    def test_a_row_below_a_limit_that_is_the_least_is_broken(self):
        self.assertEqual(self.status_of({"direction": "min", "limit": 0.95, "ratio": 0.96}), 0)
        self.assertEqual(self.status_of({"direction": "min", "limit": 0.95, "ratio": 0.94}), 1)

    def test_a_row_whose_error_is_too_large_is_neither_kept_nor_broken(self):
        self.assertEqual(self.status_of({"aa_ratio": 1.031}), 77)
        self.assertEqual(self.status_of({"aa_ratio": 0.969, "ratio": 2.0}), 77)
        self.assertEqual(self.status_of({"aa_ratio": 1.09, "aa_limits": [0.9, 1.1]}), 0)
        self.assertEqual(self.status_of({"aa_ratio": 1.11, "aa_limits": [0.9, 1.1]}), 77)
        self.assertEqual(self.status_of({"aa_ratio": 1.5, "aa_limits": None}), 0)

    def test_a_row_with_fewer_blocks_is_neither_kept_nor_broken(self):
        self.assertEqual(self.status_of({"blocks": [1.0] * 20}), 77)
        self.assertEqual(self.status_of({"blocks": [1.0], "blocks_needed": 1}), 0)

    def test_a_row_that_no_program_measured_is_a_fault(self):
        self.assertEqual(self.status_of({}, left_out=1), 1)
        self.assertEqual(self.status_of({}, "--names", left_out=1), 1)
        self.assertEqual(self.status_of({"metric": "another"}, "--names"), 1)

    def test_only_the_rows_of_another_command_may_be_missing_where_the_names_are_compared(self):
        rows = [row(name) for name in table.known_rows() if not name[1].endswith("paced line")]
        file = self.folder / "rows.json"
        for kept, status in ((rows, 0), (rows[1:], 1)):
            file.write_text(json.dumps({"rows": kept, "curves": {}}), encoding="utf-8")
            with mock.patch("sys.argv", ["table.py", str(file), "--names"]), mock.patch("builtins.print"):
                self.assertEqual(table.main(), status)

    def test_curves_of_one_name_are_one_list(self):
        self.assertEqual(table.joined([{"a": [1], "b": {"x": 1}}, {"a": [2]}]), {"a": [1, 2], "b": {"x": 1}})

    def test_the_picture_of_the_refresh_has_two_bars_for_each_line(self):
        lines = [{"line": "EI-ASCII", "wire_ms": 100.0, "cycle_ms": 101.5}, {"line": "Modbus", "wire_ms": 50.0, "cycle_ms": 51.0}]
        written = pictures.write({"refresh": lines}, self.folder / "pictures")
        self.assertEqual(written[0][0], "refresh.svg")
        words = [text.text for text in ElementTree.parse(self.folder / "pictures/refresh.svg").iter("{http://www.w3.org/2000/svg}text")]
        for expected in ("EI-ASCII", "wire 100.0 ms", "cycle 101.5 ms", "Modbus", "wire 50.0 ms", "cycle 51.0 ms"):
            self.assertIn(expected, words)

    def test_the_page_has_the_rows_the_command_and_the_machine_and_keeps_its_text(self):
        page = self.folder / table.PAGE.name
        page.write_text(f"# Head\n{table.BEGIN}\nold\n{table.END}\ntext\n", encoding="utf-8")
        with mock.patch.object(table, "PAGE", page):
            self.status_of({"ratio": 1.0234}, "--docs", "--machine", "2 x Z80")
        written = page.read_text(encoding="utf-8")
        self.assertTrue(written.startswith("# Head\n") and written.endswith("\ntext\n"))
        self.assertNotIn("old", written)
        self.assertRegex(written, r"`tools/bench --docs` on \d{4}-\d\d-\d\d, 2 x Z80")
        self.assertIn("| M1 | turnaround p50 / null | 1.023 | 1.000 | ≤ 1.05 | kept |", written)


if __name__ == "__main__":
    unittest.main()
