# SPDX-License-Identifier: Apache-2.0
"""The order of the telegram: inputs and outputs may alternate in it. It is seen and changed here (C-038)."""

import screen

ORDER = "Order in the telegram"


def mapping(*entries):
    return f'profile = "2408f"\nident = 0x1652\nlist = [{", ".join(f"{one!r}" for one in entries)}]\n'.replace("'", '"').encode()


class Order(screen.PageTest):
    def setUp(self):
        super().setUp()
        self.drop([("alternate.toml", mapping("in:1", "out:2", "in:5", "out:6"))])
        self.browser.wait_for("return document.querySelectorAll(`[role=listbox][aria-label='Outputs'] [role=option]`).length === 2",
                              what="the mapping")
        self.click("tab", "In telegram order")

    def becomes(self, *entries):
        """The list is this one, and the saved file is what dpctl makes of it."""
        self.assertEqual(self.tags(ORDER), [int(entry.split(":")[1]) for entry in entries])
        self.keys("Control+Shift+s")
        self.js("document.querySelector('dialog[open] input[type=text]').focus()")
        _, octets = self.saved(lambda: self.keys("Enter"))
        self.assertEqual(octets, screen.dpctl("gsd", "make", "--mapping", "FILE", text=mapping(*entries)))

    def test_an_alternating_list_is_shown_and_saved_as_it_is(self):
        directions = self.js("return [...find('listbox', words[0]).children].map((row) => row.querySelector('.about').textContent)", ORDER)
        self.assertEqual([one.split(",")[0] for one in directions], ["inputs", "outputs", "inputs", "outputs"])
        self.becomes("in:1", "out:2", "in:5", "out:6")

    def test_a_drag_moves_over_a_parameter_of_the_other_direction(self):
        first = self.row_place(ORDER, 1)
        self.drag(self.row_place(ORDER, 5), (first["x"], first["bottom"] - 3))
        self.becomes("in:1", "in:5", "out:2", "out:6")
        last = self.row_place(ORDER, 6)
        self.drag(self.row_place(ORDER, 1), (last["x"], last["bottom"] - 3))
        self.becomes("in:5", "out:2", "out:6", "in:1")

    def test_buttons_move_over_a_parameter_of_the_other_direction(self):
        self.press(self.row_place(ORDER, 5))
        self.click("button", "Up in the telegram")
        self.assertEqual(self.said(), self.name_of(5) + " is now parameter 2 of 4 in the telegram.")
        self.click("button", "Up in the telegram")
        self.click("button", "Up in the telegram")
        self.assertIn("already the first", self.said())
        self.becomes("in:5", "in:1", "out:2", "out:6")

    def test_keys_move_and_delete(self):
        self.tab_to("listbox", ORDER)
        self.keys("Home", "Alt+Down", "Alt+Down")
        self.assertEqual(self.tags(ORDER), [2, 5, 1, 6])
        self.keys("End", "Alt+Up", "Control+z", "Control+z", "Control+y")
        self.assertEqual(self.tags(ORDER), [2, 5, 1, 6])
        self.focus("listbox", ORDER)
        self.keys("Home", "Delete")
        self.becomes("in:5", "in:1", "out:6")

    def test_a_tag_of_the_tree_is_dropped_between_two_others(self):
        self.press(self.row_place(ORDER, 6))  # the outputs are selected
        self.type_into("searchbox", "Search parameters", "274")
        second = self.row_place(ORDER, 2)
        self.drag(self.row_place("Parameters", 274), (second["x"], second["top"] + 3))
        self.becomes("in:1", "out:274", "out:2", "in:5", "out:6")

    def test_the_lists_by_direction_show_the_same(self):
        self.press(self.row_place(ORDER, 5))
        self.click("button", "Up in the telegram")
        self.click("button", "Up in the telegram")
        self.click("tab", "By direction")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([5, 1], [2, 6]))

    def name_of(self, tag):
        return self.js("return document.querySelector(`[role=listbox][aria-label='${words[0]}'] [data-tag='${words[1]}'] .name`).textContent",
                       ORDER, tag)
