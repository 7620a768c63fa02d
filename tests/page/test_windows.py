# SPDX-License-Identifier: Apache-2.0
"""Several windows of the page share one draft: none writes over what another one has, and nothing is lost (C-045)."""

import screen
import setting

TAKE, KEEP = "Take the other draft", "Keep this one"


class Windows(screen.PageTest):
    def setUp(self):
        setting.browser.load_for_the_first_time()
        super().setUp()
        self.first = self.browser.window()
        self.change("FIRST")
        self.browser.new_window()
        self.second = self.browser.window()
        self.addCleanup(self.close_second)
        self.open()

    def close_second(self):
        if self.second:
            self.browser.go_to(self.second)
            self.forget()
            self.browser.close_window(self.first)
            self.second = None

    def change(self, name):
        self.type_into("textbox", "File name", name)

    def draft(self):
        """The name of the mapping that is edited in this window."""
        return self.value("textbox", "File name")

    def offered(self, name):
        self.browser.wait_for("return document.querySelector('[data-other-draft]:not([hidden])')?.innerText.includes(words[0])",
                              f"changed the draft: {name}", what=f"the draft {name} to be offered")

    def not_offered(self):
        self.assertFalse(self.shown("button", TAKE), self.notice())

    def test_a_further_window_begins_with_the_draft_and_asks_nothing(self):
        self.assertEqual(self.draft(), "FIRST")
        self.browser.go_to(self.first)
        self.not_offered()

    def test_a_changed_draft_is_offered_and_taken_and_undo_brings_back_the_own_one(self):
        self.change("SECOND")
        self.browser.go_to(self.first)
        self.offered("SECOND")
        self.assertEqual(self.draft(), "FIRST")
        self.click("button", TAKE)
        self.assertEqual(self.draft(), "SECOND")
        self.not_offered()
        self.keys("Control+z")
        self.assertEqual(self.draft(), "FIRST")
        self.browser.go_to(self.second)
        self.offered("FIRST")  # the windows share the draft again

    def test_what_another_window_has_is_not_written_over(self):
        self.change("SECOND")
        self.browser.go_to(self.first)
        self.offered("SECOND")
        self.change("MINE")  # not decided yet
        self.offered("SECOND")
        self.open()
        self.assertEqual(self.draft(), "SECOND")
        self.assertIn("MINE", self.said())
        self.click("button", "Start")
        self.click("button", "MINE", "Library")
        self.assertEqual(self.draft(), "MINE")

    def test_a_window_keeps_its_own_draft_and_is_not_asked_again(self):
        self.change("MINE")
        self.browser.go_to(self.first)
        self.offered("MINE")
        self.click("button", TAKE)
        self.change("THEIRS")
        self.browser.go_to(self.second)
        self.offered("THEIRS")
        self.click("button", KEEP)
        self.not_offered()
        self.assertIn("keeps its own draft", self.said())
        self.assertEqual(self.draft(), "MINE")
        self.browser.go_to(self.first)
        self.change("THEIRS TOO")
        self.not_offered()
        self.browser.go_to(self.second)
        self.not_offered()
        self.close_second_only()
        self.open()
        self.assertEqual(self.draft(), "THEIRS TOO")
        self.click("button", "Start")
        self.click("button", "MINE", "Library")
        self.assertEqual(self.draft(), "MINE")

    def close_second_only(self):
        self.browser.close_window(self.first)
        self.second = None

    def test_a_draft_of_which_the_browser_has_not_told_is_not_written_over(self):
        # What a page writes itself gives it no event: as if that of another window had not come yet.
        self.js("""const key = 'dpslaved.configurator.draft';
            localStorage.setItem(key, localStorage.getItem(key).replace('FIRST', 'UNTOLD'))""")
        self.not_offered()
        self.change("SECOND")
        self.offered("UNTOLD")
        self.click("button", TAKE)
        self.assertEqual(self.draft(), "UNTOLD")
        self.keys("Control+z")
        self.assertEqual(self.draft(), "SECOND")

    def test_other_changes_of_the_storage_are_no_question(self):
        self.click("button", "Start")
        self.click("button", "Store the mapping in the library")
        self.browser.go_to(self.first)
        self.click("button", "Start")
        self.browser.wait_for("return document.querySelector('[data-library] li') !== null", what="the library of the other window")
        self.not_offered()


class Keyboard(screen.PageTest):
    """In one window: without a screen, Firefox gives the focus to only one of several."""

    def test_the_question_is_answered_with_the_keyboard(self):
        for button, name in (KEEP, "EURO2400"), (TAKE, "OTHER"):
            self.browser.run("localStorage.clear()")
            self.open()
            self.js("""const key = 'dpslaved.configurator.draft';
                const newValue = localStorage.getItem(key).replace('EURO2400', 'OTHER');
                localStorage.setItem(key, newValue); // gives this window no event
                dispatchEvent(new StorageEvent('storage', { key, newValue }))""")
            self.tab_to("button", button)
            self.keys("Enter")
            self.assertFalse(self.shown("button", button))
            self.assertEqual(self.value("textbox", "File name"), name)
            self.assertEqual(self.js("return document.activeElement.id"), "page")


class Untold(screen.PageTest):
    """What another window has kept, and of which the browser has told this one nothing: here it is written without an event."""

    def other_window_keeps(self, name, old, new):
        self.js("""const key = `dpslaved.configurator.${words[0]}`;
            localStorage.setItem(key, localStorage.getItem(key).replaceAll(words[1], words[2]))""", name, old, new)

    def store(self, name):
        self.type_into("textbox", "File name", name)
        self.click("button", "Start")
        self.click("button", "Store the mapping in the library")

    def test_a_library_is_not_written_over(self):
        self.store("MINE")
        self.other_window_keeps("library", "MINE", "UNTOLD")
        self.click("button", "Mapping")
        self.store("SECOND")
        self.open()
        self.click("button", "Start")
        for name in "UNTOLD", "SECOND":
            self.assertTrue(self.shown("button", name, "Library"), name)

    def test_an_entry_is_deleted_from_the_library_that_is_there(self):
        self.store("MINE")
        self.other_window_keeps("library", "MINE", "UNTOLD")
        self.click("button", "Delete MINE", "Library")
        self.keys("Enter")  # it asks
        self.wait_said("MINE was deleted")
        self.assertTrue(self.shown("button", "UNTOLD", "Library"))

    def test_a_window_looks_when_it_gets_the_focus(self):
        self.store("MINE")
        self.other_window_keeps("library", "MINE", "UNTOLD")
        self.other_window_keeps("draft", "MINE", "OTHER")
        self.js("dispatchEvent(new Event('focus'))")
        self.assertTrue(self.shown("button", "UNTOLD", "Library"))
        self.assertIn("changed the draft: OTHER", self.notice())
        self.click("button", KEEP)
        self.js("dispatchEvent(new Event('focus'))")
        self.assertFalse(self.shown("button", KEEP))
