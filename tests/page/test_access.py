# SPDX-License-Identifier: Apache-2.0
"""axe-core without findings on every screen, and the names that assistive technology reads."""
import unittest

import screen
import setting

TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]


class Access(screen.PageTest):
    def findings(self, where):
        if not setting.axe:
            raise unittest.SkipTest("without --axe there is no axe-core")
        self.browser.run(setting.axe.read_text(encoding="utf-8") + "; globalThis.axe ??= axe; return 1")
        found = self.js("""
            const { violations } = await axe.run(document, { runOnly: words[0], resultTypes: ['violations'] });
            return violations.map((one) => `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html).join(' ')}`)""", TAGS)
        self.assertEqual(found, [], where)

    def test_the_mapping_screen_has_no_findings(self):
        self.findings("as it opens")
        for tab in "Octets", "I/O map":
            self.click("tab", tab)
            self.findings(tab)
        self.click("tab", "Status words")
        self.findings("status words")

    def test_the_mapping_screen_of_a_technology_box_has_no_findings(self):
        self.click("button", "Start")
        self.choose("Device", "605")
        self.click("button", "New file", "New file")
        self.findings("605, empty lists")

    def test_start_and_check_have_no_findings(self):
        for name in "Start", "Check and compare":
            self.click("button", name)
            self.findings(name)
        file = setting.root / "gsd/605/605_1649.GSD"
        self.drop([("A.GSD", file.read_bytes()), ("B.GSD", file.read_bytes() + b"; more\r\n")], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')", what="the comparison")
        self.findings("two files")

    def test_dialogs_menus_and_notices_have_no_findings(self):
        for key in "Control+p", "Control+Shift+s":
            self.keys(key)
            self.findings(key)
            self.keys("Escape")
        self.press(self.row_place("Inputs", self.tags("Inputs")[0]), button=2)
        self.findings("menu")
        self.keys("Escape")
        self.drop([("a.GSD", b"none")])
        self.wait_said("was not opened")
        self.findings("notice")

    def test_the_question_about_another_draft_has_no_findings(self):
        self.js("""const key = 'dpslaved.configurator.draft';
            const newValue = localStorage.getItem(key).replace('EURO2400', 'OTHER');
            dispatchEvent(new StorageEvent('storage', { key, newValue }))""")
        self.assertIn("OTHER", self.notice())
        self.findings("another draft")

    def test_the_browser_computes_the_names_by_which_the_tests_find_parts(self):
        if self.browser.name != "chromium":
            self.skipTest("of Chromium's driver")
        tree = self.browser.cdp("Accessibility.getFullAXTree")["nodes"]
        names = {(one["role"]["value"], one.get("name", {}).get("value", "")) for one in tree if not one.get("ignored")}
        for role in "button", "textbox", "searchbox", "checkbox", "listbox", "tab":
            for name in self.names(role):
                self.assertIn((role, name), names)
