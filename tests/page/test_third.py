# SPDX-License-Identifier: Apache-2.0
"""The third list of a technology box, read and write, and a table of one's own."""
import pathlib
import tempfile

import screen
import test_lists
import test_print

THIRD = "Read and write"


class Third(screen.PageTest):
    def setUp(self):
        super().setUp()
        self.click("button", "Start")
        self.choose("Device", "605")
        self.click("button", "New file", "New file")
        self.drop([("own.csv", test_lists.TABLE)])
        self.wait_said("was loaded")

    def all_tags(self):
        return [self.tags(title) for title in ("Inputs", "Outputs", THIRD)]

    def area_of(self, title):
        return self.js("const { x, y } = at(document.querySelector(`section[aria-label='${words[0]}'] .list-rows`)); return [x, y]", title)

    def choose_parameter(self, tag):
        self.type_into("searchbox", "Search parameters", str(tag))
        self.press(self.row_place("Parameters", tag))

    def test_adds_to_it_with_the_button_the_key_the_menu_and_by_a_drag(self):
        self.choose_parameter(7)
        self.click("button", "Add to read and write")
        self.choose_parameter(8)
        self.focus("listbox", "Parameters")
        self.keys("b")
        # Without a click: in WebKit a press soon after it is a double click, even if it begins a drag.
        self.type_into("searchbox", "Search parameters", "10")
        self.place("button", f"Delete from {THIRD.lower()}")  # scrolls the list into view
        self.drag(self.row_place("Parameters", 10), self.area_of(THIRD))
        self.choose_parameter(9)
        # Last: in WebKit the right button stays pressed.
        self.press(self.row_place("Parameters", 9), button=2)
        self.click("menuitem", "Add to read and write")
        self.assertEqual(sorted(self.tags(THIRD)), [7, 8, 9, 10])
        self.assertEqual(self.all_tags()[:2], [[], []])

    def test_moves_to_it_and_from_it_with_the_menu_and_keys(self):
        self.choose_parameter(7)
        self.click("button", "Add to inputs")
        self.click("button", "More in inputs")
        self.click("menuitem", "Move to read and write")
        self.assertEqual(self.all_tags(), [[], [], [7]])
        self.focus("listbox", THIRD)
        self.keys("Alt+Left")
        self.assertEqual(self.all_tags(), [[], [7], []])
        self.keys("Alt+Right")
        self.assertEqual(self.all_tags(), [[], [], [7]])
        self.click("button", "More in read and write")
        self.click("menuitem", "Move to inputs")
        self.assertEqual(self.all_tags(), [[7], [], []])

    def test_has_one_parameter_of_it_in_both_directions(self):
        self.choose_parameter(7)
        self.click("button", "Add to read and write")
        self.click("tab", "I/O map")
        rows = self.js("return [...document.querySelectorAll('.maps tbody tr')].map((row) => row.innerText)")
        self.assertEqual([("7" in row, "0–1" in row) for row in rows], [(True, True)] * 2)
        self.click("tab", "Octets")
        chk_cfg = self.js("return [...document.querySelectorAll('h3')].find((one) => one.innerText.startsWith('Chk_Cfg'))"
                          ".nextElementSibling.innerText")
        self.assertIn("70", chk_cfg.split())

    def test_prints_it_with_either_direction(self):
        self.choose_parameter(7)
        self.click("button", "Add to read and write")
        for part in "Inputs", "Outputs":
            text = test_print.Paper.printed(self, lambda: self.keys("Control+p"), part)
            self.assertIn("Read and write of the master", text)
            self.assertIn("OWN 7", text)

    paper = test_print.Paper.paper

    def test_a_table_is_loaded_and_the_shipped_one_comes_back(self):
        self.assertIn("41 parameters", self.text("region", "Device parameters"))
        self.assertIn("own.csv", self.text("region", "Device parameters"))
        self.choose_parameter(7)
        self.click("button", "Add to inputs")
        self.assertIn("OWN 7", self.text("region", "Inputs"))
        self.click("button", "Use the shipped table")
        self.assertNotIn("OWN 7", self.text("region", "Inputs"))
        self.assertFalse(self.shown("button", "Use the shipped table"))
        self.click("button", "Undo")
        self.assertIn("OWN 7", self.text("region", "Inputs"))

    def test_the_button_loads_a_table_and_a_bad_one_is_refused(self):
        self.click("button", "Use the shipped table")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "second.csv")
            path.write_bytes(test_lists.TABLE)
            self.choose_file(lambda: self.click("button", "Load a table…"), path)
            self.wait_said("second.csv was loaded: 41 rows")
        self.drop([("bad.csv", b"tag,name\r\nseven,OWN\r\n")])
        self.wait_said("bad.csv was not loaded")
        self.assertIn("second.csv", self.text("region", "Device parameters"))
