# SPDX-License-Identifier: Apache-2.0
"""Draft and library where the browser has no room for them, or lets the page keep nothing (C-045)."""

import screen
import setting

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
        self.click("button", "Replace")
        self.wait_said("was stored in the library")
        self.assertNotIn("does not keep", self.js("return document.querySelector('[data-file]').innerText"))

    def test_a_draft_that_stops_the_page_is_set_aside(self):
        if self.browser.name != "chromium":
            self.skipTest("only Chromium runs a script before those of the page")
        self.edit("the draft")
        fault = self.browser.cdp("Page.addScriptToEvaluateOnNewDocument",
                                 source="Object.defineProperty(document, 'title', { set() { throw new Error('made for the test'); } })")
        self.browser.open(setting.page.as_uri())
        self.browser.wait_for("return /made for the test.*set aside/s.test(document.body.innerText)", what="the sentence")
        self.browser.cdp("Page.removeScriptToEvaluateOnNewDocument", identifier=fault["identifier"])
        self.open()
        self.assertEqual(self.value("textbox", "Description"), "")
        self.assertIn("the draft", self.js("return localStorage.getItem('dpslaved.configurator.draft set aside')"))

    def test_a_draft_with_more_entries_than_a_telegram_has_is_not_restored(self):
        draft = {"form": "dpslaved configurator 1", "library": [], "draft": {
            "name": "MANY", "mapping": {"profile": "605", "list": ["in:1"] * 501}, "table": None}}
        self.js("localStorage.setItem('dpslaved.configurator.draft', JSON.stringify(words[0]))", draft)
        self.open()
        self.assertEqual(self.value("textbox", "File name"), "EURO2400")

    def test_leaving_is_asked_about_while_something_would_be_lost(self):
        asked = "const event = new Event('beforeunload', { cancelable: true }); dispatchEvent(event); return event.defaultPrevented"
        self.edit("kept")
        self.assertFalse(self.js(asked))
        self.js(FORBID, "draft")
        self.edit("not kept")
        self.assertTrue(self.js(asked))
