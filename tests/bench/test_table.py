# SPDX-License-Identifier: Apache-2.0
"""That the table of tools/run bench is judged as its page says."""

import json
import pathlib
import tempfile
import unittest
from unittest import mock

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


if __name__ == "__main__":
    unittest.main()
