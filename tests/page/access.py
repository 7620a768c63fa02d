# SPDX-License-Identifier: Apache-2.0
"""What axe-core finds on the screens of the page."""
import unittest

import screen
import setting

TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]


class AxeTest(screen.PageTest):
    def findings(self, where):
        if not setting.axe:
            raise unittest.SkipTest("without --axe there is no axe-core")
        self.browser.run(setting.axe.read_text(encoding="utf-8") + "; globalThis.axe ??= axe; return 1")
        found = self.js("""
            const { violations } = await axe.run(document, { runOnly: words[0], resultTypes: ['violations'] });
            return violations.map((one) => `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html).join(' ')}`)""", TAGS)
        self.assertEqual(found, [], where)

    def mapping_screen(self):
        self.findings("as it opens")
        for tab in "Octets", "I/O map":
            self.click("tab", tab)
            self.findings(tab)
        self.click("tab", "Status words")
        self.findings("status words")

    def start_and_check(self):
        for name in "Start", "Check and compare":
            self.click("button", name)
            self.findings(name)
        file = setting.root / "gsd/605/605_1649.GSD"
        self.drop([("A.GSD", file.read_bytes()), ("B.GSD", file.read_bytes() + b"; more\r\n")], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')", what="the comparison")
        self.findings("two files")
