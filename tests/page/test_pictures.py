# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/guide/configurator.md: each can be taken; with --pictures they are written."""
import screen
import setting

PICTURES = ["start", "mapping", "octets", "check"]


class Pictures(screen.PageTest):
    def setUp(self):
        if setting.browser.name != "chromium":
            self.skipTest("the pictures are Chromium's")
        super().setUp()
        self.browser.cdp("Emulation.setDeviceMetricsOverride", width=1200, height=760, deviceScaleFactor=1, mobile=False)
        self.addCleanup(self.browser.cdp, "Emulation.clearDeviceMetricsOverride")

    def take(self, name):
        self.js("document.activeElement.blur(); scrollTo(0, 0); document.querySelector('.scroll').scrollTo(0, 0)")
        picture = self.browser.picture()
        self.assertLess(len(picture), 250_000)
        if setting.pictures:
            (setting.pictures / f"{name}.png").write_bytes(picture)

    def test_are_those_of_the_guide(self):
        page = (setting.root / "docs/guide/configurator.md").read_text(encoding="utf-8")
        for name in PICTURES:
            self.assertIn(f"](pictures/{name}.png)", page)

    def test_show_the_page_at_work(self):
        self.click("button", "Start")
        self.take("start")
        self.click("button", "Mapping")
        self.type_into("searchbox", "Search parameters", "proportional")
        self.press(self.row_place("Parameters", 6))
        self.click("button", "Add to outputs")
        self.take("mapping")
        self.click("tab", "Octets")
        self.take("octets")
        self.click("button", "Check and compare")
        file = (setting.root / "gsd/605/605_1649.GSD").read_bytes()
        self.drop([("605_1649.GSD", file), ("CHANGED.GSD", file.replace(b"= 60", b"= 100"))], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')", what="the comparison")
        self.take("check")
