# SPDX-License-Identifier: Apache-2.0
"""Draft and library where the browser has no room for them, or lets the page keep nothing (C-045)."""

import screen

FORBID = """const part = words[0];
    globalThis.setItem ??= Storage.prototype.setItem;
    Storage.prototype.setItem = function (name, text) {
        if (name.endsWith(part)) throw new DOMException('no room', 'QuotaExceededError');
        return globalThis.setItem.call(this, name, text);
    }"""


class Kept(screen.PageTest):
    def edit(self, description):
        self.type_into("textbox", "Description", description)

    def test_a_draft_that_is_not_kept_is_said_on_the_screen_where_one_edits(self):
        self.js(FORBID, "draft")
        self.edit("one")
        self.assertIn("does not keep the draft", self.js("return document.querySelector('[data-file]').innerText"))
        self.edit("two")
        self.assertIn("does not keep the draft", self.js("return document.querySelector('[data-file]').innerText"))

    def test_a_library_that_is_not_kept_is_said_until_it_is(self):
        self.js(FORBID, "library")
        self.click("button", "Start")
        self.click("button", "Store the mapping in the library")
        self.assertIn("until the page is closed", self.said())
        self.assertIn("does not keep the library", self.notice())
        self.click("button", "Mapping")
        self.edit("the draft is kept")
        self.assertIn("does not keep the library", self.js("return document.querySelector('[data-file]').innerText"))
        self.js("Storage.prototype.setItem = globalThis.setItem")
        self.click("button", "Start")
        self.click("button", "Store the mapping in the library")
        self.assertNotIn("does not keep", self.js("return document.querySelector('[data-file]').innerText"))

    def test_leaving_is_asked_about_while_something_would_be_lost(self):
        asked = "const event = new Event('beforeunload', { cancelable: true }); dispatchEvent(event); return event.defaultPrevented"
        self.edit("kept")
        self.assertFalse(self.js(asked))
        self.js(FORBID, "draft")
        self.edit("not kept")
        self.assertTrue(self.js(asked))
