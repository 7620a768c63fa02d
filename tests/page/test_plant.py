# SPDX-License-Identifier: Apache-2.0
"""A plant's own GSD file: its tags, its modules and the keys of its station are kept, and shown (X-53)."""
import screen
import setting

CASES = setting.root / "tests/gsd/cases"


class Plant(screen.PageTest):
    def open_case(self, name):
        self.drop([(name, (CASES / name).read_bytes())])

    def kept(self, part):
        self.browser.wait_for("return document.querySelector('.plant')?.innerText.includes(words[0]) === true", part,
                              what=f"what is kept of the file: {part}")
        return self.js("return document.querySelector('.plant').innerText")

    def test_asks_for_the_device_and_takes_none_on_a_guess(self):
        self.open_case("PLNT0533.GSD")
        self.browser.wait_for("return document.querySelector('dialog select') !== null", what="the question")
        self.assertEqual(self.js("return document.querySelector('dialog select').value"), "")
        self.js("document.querySelector('dialog .answers button').click()")
        self.wait_said("None is taken on a guess")
        self.js("document.querySelector('dialog select').value = '590'")
        self.js("document.querySelector('dialog .answers button').click()")
        self.assertIn("55, 56, 288", self.kept("directions are in the master's project"))
        self.wait_said("the directions of the tags are in the master's project")

    def test_keeps_where_the_tags_begin_and_the_identifiers(self):
        self.open_case("LEAD2408.GSD")
        text = self.kept("The tags begin at octet 1")
        self.assertIn("Identifiers of the station: 52, 60", text)
        self.assertIn("map (52 60)", text)
        lists = self.js("return [...document.querySelectorAll('.middle .rows')].map((one) => one.querySelectorAll('[role=option]').length)")
        self.assertEqual(lists[:2], [3, 1], "one row for each word")

    def test_lets_it_go_in_one_step_that_undo_brings_back(self):
        self.open_case("SEPM2408.GSD")
        self.kept("map (50 50 50 60)")
        self.click("button", "Make the file as the profile has it")
        self.browser.wait_for("return document.querySelector('.plant').hidden", what="the end of what was kept")
        self.click("button", "Undo")
        self.kept("map (50 50 50 60)")

    def test_refuses_a_file_that_no_key_makes_the_station_take(self):
        self.open_case("HAND.GSD")
        self.wait_said("HAND.GSD was not opened")
        self.assertIn("expected 9 identifiers for as many tags, got 8", self.js("return document.body.innerText"))
