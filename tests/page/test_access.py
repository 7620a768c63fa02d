# SPDX-License-Identifier: Apache-2.0
"""axe-core without findings on every screen, and the names that assistive technology reads."""
import access


class Access(access.AxeTest):
    def test_the_mapping_screen_has_no_findings(self):
        self.mapping_screen()

    def test_the_mapping_screen_of_a_technology_box_has_no_findings(self):
        self.click("button", "Start")
        self.choose("Device", "605")
        self.click("button", "New file", "New file")
        self.findings("605, empty lists")

    def test_start_and_check_have_no_findings(self):
        self.start_and_check()

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
