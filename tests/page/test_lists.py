# SPDX-License-Identifier: Apache-2.0
"""Rows C-032 and C-036 to C-043: the tree of parameters, the lists, and the limit."""

import screen

# A table of one's own, as `dpctl survey` writes it, but with tags of no device.
TABLE = ("tag,name,type,decimals,min,max,access,when,mnemonic,register,values,section,notes\r\n"
         + "".join(f"{tag},OWN {tag},INT,1,0,100,rw,,,,,,\r\n" for tag in (*range(1, 41), 800))).encode()


class Lists(screen.PageTest):
    def setUp(self):
        super().setUp()
        for name in "Clear inputs", "Clear outputs":
            self.js("find('button', words[0]).click()", name)

    def search(self, text):
        self.type_into("searchbox", "Search parameters", text)

    def fill(self, *tags, to="Inputs"):
        """Adds tags by their numbers."""
        self.click("region", to)
        for tag in tags:
            self.type_into("textbox", "Add tag by number", str(tag))
            self.keys("Enter")

    def area_of(self, title):
        return self.js("const box = document.querySelector(`section[aria-label='${words[0]}'] .list-rows`).getBoundingClientRect();"
                       "return [Math.round(box.left + box.width / 2), Math.round(box.bottom - 6)]", title)

    # ---- C-032

    def test_hints_stand_for_each_area_and_can_be_switched_off(self):
        areas = self.js("return [...document.querySelectorAll('main section.tree, main section.list, main section.details, main section.live')]"
                        ".filter(seen).map((one) => one.getAttribute('aria-label'))")
        self.assertGreaterEqual(len(areas), 5)
        hint = "const bar = document.querySelector('[data-hint-bar]'); return seen(bar) ? bar.innerText : ''"
        told = set()
        for name in areas:
            self.act(self._to(self.js("const one = find('region', words[0]); one.scrollIntoView({ block: 'nearest' });"
                                      "const { x, y } = at(one.querySelector('h2')); return { x, y }", name)))
            told.add(self.js(hint))
        self.assertEqual(len(told), len(areas))
        self.focus("searchbox", "Search parameters")
        self.assertIn("search", self.js(hint).lower())
        self.click("button", "Hints")
        self.assertEqual(self.js(hint), "")
        self.open()
        self.assertEqual(self.js(hint), "")
        self.tab_to("button", "New")
        self.keys("End", "Enter")
        self.assertNotEqual(self.js(hint), "")

    # ---- C-036

    def test_the_tree_has_the_lists_of_the_instrument_and_one_for_status_words(self):
        rows = self.browser.call([{"do": "tags", "profile": "2408f"}])[0]["tags"]
        sections = list(dict.fromkeys(row["section"] or "Parameters" for row in rows))
        words = [row["number"] for row in rows if row["status_word"]]
        self.assertEqual(self.names("tab", "Device parameters"), sections + ["Status words"])
        for tab in (sections[0], sections[-1]):
            self.click("tab", tab)
            self.shows([row["number"] for row in rows if (row["section"] or "Parameters") == tab])
        self.focus("tab", sections[-1])
        self.keys("End")
        self.shows(words)
        self.assertTrue(words)

    def shows(self, numbers):
        """The list has these parameters; a long one puts up the first of them."""
        shown = self.tags("Parameters")
        self.assertEqual(shown, numbers[:len(shown)])
        self.assertGreaterEqual(len(shown), min(20, len(numbers)))
        self.assertIn(f"{len(numbers)} parameters", self.text("region", "Device parameters"))

    def test_the_tabs_are_reached_by_the_keyboard_while_one_searches(self):
        tabs = self.names("tab", "Device parameters")
        self.click("tab", tabs[2])
        self.search("setpoint")
        self.tab_to("tab", tabs[0])

    def test_the_search_finds_by_number_name_and_words(self):
        self.search("proportional band")
        found = self.tags("Parameters")
        self.assertIn(6, found)
        self.search("6")
        self.assertEqual(self.tags("Parameters")[0], 6)
        self.search("no such parameter at all")
        self.assertEqual(self.tags("Parameters"), [])

    # ---- C-037

    def test_adds_by_drag_and_drop(self):
        self.search("2")
        self.drag(self.row_place("Parameters", 2), self.area_of("Inputs"))
        self.assertEqual(self.tags("Inputs"), [2])
        self.drag(self.row_place("Parameters", 2), self.area_of("Outputs"))
        self.assertEqual(self.tags("Outputs"), [2])
        self.assertIn("outputs", self.said())

    def test_a_drop_beside_the_lists_adds_nothing(self):
        self.search("2")
        head = self.place("region", "Preview")
        self.drag(self.row_place("Parameters", 2), (head["x"], head["y"]))
        self.assertEqual(self.tags("Inputs") + self.tags("Outputs"), [])

    def test_escape_ends_a_drag(self):
        self.search("2")
        start, (x, y) = self.row_place("Parameters", 2), self.area_of("Inputs")
        self.act(self._to(start), {"type": "pointerDown", "button": 0}, {"type": "pointerMove", "x": x, "y": y, "duration": 20})
        self.assertTrue(self.js("return document.querySelector('.ghost') !== null"))
        self.keys("Escape")
        self.assertFalse(self.js("return document.querySelector('.ghost, .drop-over, .dragging') !== null"))
        self.act({"type": "pointerMove", "x": x, "y": y - 2, "duration": 0}, {"type": "pointerUp", "button": 0})
        self.assertEqual(self.tags("Inputs"), [])
        self.drag(start, (x, y))  # the next one is not hindered
        self.assertEqual(self.tags("Inputs"), [2])

    def test_adds_by_double_click_to_the_selected_list(self):
        self.click("region", "Outputs")
        self.search("6")
        self.press(self.row_place("Parameters", 6), times=2)
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([], [6]))

    def test_adds_by_the_arrow_button(self):
        self.search("6")
        self.press(self.row_place("Parameters", 6))
        self.click("button", "Add to outputs")
        self.click("button", "Add to inputs")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([6], [6]))

    def test_adds_with_the_keyboard(self):
        self.tab_to("searchbox", "Search parameters")
        self.keys("=6", "Down", "o")
        self.assertEqual(self.tags("Outputs"), [6])
        self.keys("i")
        self.assertEqual(self.tags("Inputs"), [6])

    # ---- C-038

    def test_reorders_by_drag_and_drop(self):
        self.fill(1, 2, 5)
        first = self.row_place("Inputs", 1)
        self.drag(self.row_place("Inputs", 5), (first["x"], first["top"] + 3))
        self.assertEqual(self.tags("Inputs"), [5, 1, 2])
        last = self.row_place("Inputs", 2)
        self.drag(self.row_place("Inputs", 5), (last["x"], last["bottom"] - 3))
        self.assertEqual(self.tags("Inputs"), [1, 2, 5])

    def test_moves_between_inputs_and_outputs_by_drag_and_drop(self):
        self.fill(2, 5)
        self.drag(self.row_place("Inputs", 2), self.area_of("Outputs"))
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([5], [2]))
        self.drag(self.row_place("Outputs", 2), self.area_of("Inputs"))
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([5, 2], []))

    def test_reorders_and_moves_with_buttons(self):
        self.fill(1, 2)
        self.press(self.row_place("Inputs", 2))
        self.click("button", "Up in inputs")
        self.assertEqual(self.tags("Inputs"), [2, 1])
        self.click("button", "Down in inputs")
        self.assertEqual(self.tags("Inputs"), [1, 2])
        self.click("button", "To outputs from inputs")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([1], [2]))

    def test_reorders_and_moves_with_the_keyboard(self):
        self.fill(1, 2, 6)
        self.tab_to("listbox", "Inputs")
        self.keys("End", "Alt+Up", "Alt+Up")
        self.assertEqual(self.tags("Inputs"), [6, 1, 2])
        self.keys("Alt+Down")
        self.assertEqual(self.tags("Inputs"), [1, 6, 2])
        self.keys("Alt+Right")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([1, 2], [6]))
        self.keys("Alt+Left")
        self.assertEqual(sorted(self.tags("Inputs")), [1, 2, 6])

    def test_undoes_and_redoes_each_step(self):
        self.fill(1, 2, 5)
        self.focus("listbox", "Inputs")
        self.keys("Control+z", "Control+z")
        self.assertEqual(self.tags("Inputs"), [1])
        self.keys("Control+y")
        self.assertEqual(self.tags("Inputs"), [1, 2])
        self.click("button", "Undo")
        self.click("button", "Redo")
        self.click("button", "Redo")
        self.assertEqual(self.tags("Inputs"), [1, 2, 5])

    def test_undoes_and_redoes_without_end(self):
        self.search("2")
        self.press(self.row_place("Parameters", 2))
        before = self.tags("Inputs")
        self.press_often("Add to inputs", "Clear inputs")
        self.press_often("Undo", "Undo")
        self.assertEqual(self.tags("Inputs"), before)
        self.press_often("Redo", "Redo")
        self.click("button", "Undo")
        self.assertEqual(self.tags("Inputs"), [2])

    def press_often(self, first, second):
        """100 presses, ten for each call: a slow machine ends a script that takes long."""
        for _ in range(10):
            self.js("for (let at = 0; at < 10; ++at) find('button', words[at % 2]).click()", first, second)

    # ---- C-039

    def test_deletes_one_and_clears_a_list(self):
        self.fill(1, 2, 5)
        self.press(self.row_place("Inputs", 2))
        self.click("button", "Delete from inputs")
        self.assertEqual(self.tags("Inputs"), [1, 5])
        self.focus("listbox", "Inputs")
        self.keys("Home", "Delete")
        self.assertEqual(self.tags("Inputs"), [5])
        self.focus("button", "Clear inputs")
        self.keys("Enter")
        self.assertEqual(self.tags("Inputs"), [])

    def test_clears_one_list_after_the_other_with_the_pointer(self):
        self.fill(1, 2)
        self.fill(6, to="Outputs")
        self.click("button", "Clear inputs")
        self.click("button", "Clear outputs")  # what the press before has moved is not missed
        self.assertEqual(self.tags("Inputs") + self.tags("Outputs"), [])

    def test_opens_the_menu_of_an_entry(self):
        self.fill(1, 2, 5)
        self.press(self.row_place("Inputs", 2), button=2)
        self.assertTrue({"Move up", "Move down", "Delete", "Clear the list", "Move to outputs"} <= set(self.names("menuitem")))
        self.click("menuitem", "Delete")
        self.assertEqual(self.tags("Inputs"), [1, 5])
        self.focus("listbox", "Inputs")
        self.keys("Shift+F10")
        self.assertTrue(self.shown("menu"))
        self.keys("Escape")
        self.assertFalse(self.shown("menu"))
        self.keys("Shift+F10", "End", "Enter")
        self.assertEqual(self.tags("Inputs"), [])

    # ---- C-040

    def test_shows_the_demand_data_tag_of_a_parameter(self):
        rows = self.browser.call([{"do": "tags", "profile": "2408f"}])[0]["tags"]
        row = next(one for one in rows if one["demand"] is not None)
        self.search(str(row["number"]))
        self.press(self.row_place("Parameters", row["number"]), button=2)
        self.assertIn(f"Demand Data tag: {row['demand']}", self.names("menuitem"))
        self.keys("Escape")
        self.press(self.row_place("Parameters", row["number"]))
        self.focus("listbox", "Parameters")
        self.keys("Shift+F10")
        self.assertIn(f"Demand Data tag: {row['demand']}", self.names("menuitem"))
        self.keys("Escape")

    # ---- C-041

    def test_demand_data_stands_first_in_chk_cfg(self):
        self.fill(1)
        self.click("tab", "Octets")
        self.assertNotIn("73", self.octets_of_chk_cfg())
        self.click("checkbox", "Use Demand Data")
        self.assertEqual(self.octets_of_chk_cfg()[0], "73")
        self.focus("checkbox", "Use Demand Data")
        self.keys("Space")
        self.assertNotIn("73", self.octets_of_chk_cfg())

    def octets_of_chk_cfg(self):
        text = self.js("return [...document.querySelectorAll('h3')].find((one) => one.innerText.startsWith('Chk_Cfg'))"
                       ".nextElementSibling.innerText")
        return [word for word in text.split() if len(word) == 2]

    # ---- C-043

    def test_adds_nothing_above_117_words(self):
        self.fill(*range(1, 118))
        self.assertEqual(len(self.tags("Inputs")), 117)
        self.assertIn("117 of 117 words", self.js("return document.querySelector('[data-used]').innerText"))
        self.fill(300)
        self.assertEqual(len(self.tags("Inputs")), 117)
        self.assertIn("117", self.said())
        self.search("274")
        self.press(self.row_place("Parameters", 274), times=2)
        self.place("button", "Delete from outputs")  # scrolls the list into view
        self.drag(self.row_place("Parameters", 274), self.area_of("Outputs"))
        self.focus("listbox", "Parameters")
        self.keys("o")
        self.click("button", "Add to outputs")
        self.click("checkbox", "Use Demand Data")
        self.assertFalse(self.js("return find('checkbox', 'Use Demand Data').checked"))
        self.assertEqual((len(self.tags("Inputs")), self.tags("Outputs")), (117, []))

    def test_adds_nothing_above_the_limit_of_drives_and_boxes(self):
        for device, most in ("590", 12), ("605", 30):
            with self.subTest(device):
                self.click("button", "Start")
                self.choose("Device", device)
                self.click("button", "New file", "New file")
                self.drop([("own.csv", TABLE)])
                self.wait_said("was loaded")
                self.fill(*range(1, most + 3))
                self.assertEqual(self.tags("Inputs"), list(range(1, most + 1)))
                self.assertIn(f"{most} of {most} parameters",
                              self.js("return document.querySelector('[data-used]').innerText"))
                self.search("800")
                self.press(self.row_place("Parameters", 800), times=2)
                self.click("button", "Add to outputs")
                self.assertIn("Not added", self.said())
                self.place("button", "Delete from outputs")  # scrolls the list into view
                self.drag(self.row_place("Parameters", 800), self.area_of("Outputs"))
                self.assertEqual((len(self.tags("Inputs")), self.tags("Outputs")), (most, []))

    # ---- findings

    def test_a_finding_shows_its_parameter(self):
        self.fill(1, 2)
        self.fill(6, 7, 6, to="Outputs")  # written twice
        self.click("region", "Inputs")
        self.click("button", "Show the parameter", "Preview")
        self.assertEqual(self.js("return document.querySelector('.list [aria-selected=true]').dataset.at"), "4")
        self.assertEqual(self.js("return document.activeElement.getAttribute('aria-label')"), "Outputs")
