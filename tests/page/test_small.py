# SPDX-License-Identifier: Apache-2.0
"""The page in the dark, on a small screen, at 200 % zoom and in the colours of the system. Only Chromium can be told so."""
import access

SIZES = {"320 pixels wide": (320, 640, 1), "200 % zoom": (640, 450, 2)}
PICTURES = (1200, 760, 1)  # the screen of the guide's pictures


class Emulated(access.AxeTest):
    """Tells Chromium what the page is shown on, until the end of the test."""

    def setUp(self):
        super().setUp()
        if self.browser.name != "chromium":
            self.skipTest("only Chromium can be told so")
        self.addCleanup(self.browser.cdp, "Emulation.clearDeviceMetricsOverride")
        self.addCleanup(self.browser.cdp, "Emulation.setEmulatedMedia", features=[])

    def media(self, name, value):
        self.browser.cdp("Emulation.setEmulatedMedia", features=[{"name": name, "value": value}])
        self.assertTrue(self.js("return matchMedia(`(${words[0]}: ${words[1]})`).matches", name, value))

    def size(self, name):
        width, height, scale = SIZES.get(name, PICTURES)
        self.browser.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
        self.browser.wait_for("return innerWidth === words[0]", width, what="the size")
        self.open()

    def scrolled(self):
        return self.js("return document.querySelector('.scroll').scrollTop")


class Looks(Emulated):
    def test_nothing_is_found_in_the_dark(self):
        self.media("prefers-color-scheme", "dark")
        self.assertEqual(self.js("return getComputedStyle(document.body).backgroundColor"), "rgb(20, 23, 27)")
        self.mapping_screen()
        self.start_and_check()

    def test_nothing_is_found_in_the_colours_of_the_system(self):
        self.media("forced-colors", "active")
        self.mapping_screen()
        self.start_and_check()

    def test_a_chosen_row_is_seen_in_the_colours_of_the_system(self):
        self.media("forced-colors", "active")
        self.press(self.row_place("Inputs", self.tags("Inputs")[0]))
        self.assertEqual(self.js("return getComputedStyle(document.querySelector('.list [aria-selected=true]')).outlineStyle"), "solid")

    def test_nothing_is_found_where_the_screen_is_small(self):
        for name in SIZES:
            with self.subTest(name):
                self.size(name)
                self.findings("mapping")
                self.start_and_check()

    def test_nothing_stands_beside_a_small_screen(self):
        wider = "const one = document.querySelector('.scroll'); return one.scrollWidth - one.clientWidth"
        for name in SIZES:
            self.size(name)
            for button in "Mapping", "Start", "Check and compare":
                with self.subTest(name, screen=button):
                    self.click("button", button)
                    self.assertEqual(self.js(wider), 0)

    def test_the_table_of_the_octets_is_not_cut(self):
        self.size("pictures")
        self.click("tab", "Octets")
        self.assertEqual(self.js("const one = document.querySelector('.live-panel'); return one.scrollWidth - one.clientWidth"), 0)


class Drags(Emulated):
    def test_a_drag_scrolls_the_page_to_a_list_that_is_out_of_view(self):
        for name in SIZES:
            with self.subTest(name):
                self.size(name)
                self.js("find('button', 'Clear inputs').click()")
                self.type_into("searchbox", "Search parameters", "2")
                start = self.row_place("Parameters", 2)
                low = self.js("return Math.round(document.querySelector('.scroll').getBoundingClientRect().bottom) - 4")
                self.act(self._to(start), {"type": "pointerDown", "button": 0},
                         {"type": "pointerMove", "x": start["x"], "y": low, "duration": 30})
                area = self.browser.wait_for("""
                    const { left, width, bottom } = document.querySelector("section[aria-label='Inputs'] .list-rows").getBoundingClientRect();
                    return bottom < words[0] - 40 ? { x: Math.round(left + width / 2), y: Math.round(bottom - 20) } : null""", low,
                                             what="the list to come into view")
                self.act({"type": "pointerMove", **area, "duration": 0}, {"type": "pointerUp", "button": 0})
                self.assertEqual(self.tags("Inputs"), [2])

    def test_a_drag_that_passes_the_edge_scrolls_nothing(self):
        self.size("200 % zoom")
        self.js("find('searchbox', 'Search parameters').scrollIntoView({ block: 'start' })")
        start = self.js("return at(document.querySelector(\"[role=listbox][aria-label='Parameters'] [role=option]\"))")
        low = self.js("return Math.round(document.querySelector('.scroll').getBoundingClientRect().bottom) - 4")
        moves = [{"type": "pointerMove", "x": start["x"], "y": y, "duration": 0} for y in (low, start["y"])]
        before = self.scrolled()
        self.act(self._to(start), {"type": "pointerDown", "button": 0}, *moves, {"type": "pause", "duration": 500},
                 {"type": "pointerUp", "button": 0})
        self.assertEqual(self.scrolled(), before)

    def test_a_finger_drags_by_the_handle(self):
        self.js("find('button', 'Clear inputs').click()")
        self.type_into("searchbox", "Search parameters", "2")
        grip = self.js("return at(document.querySelector(`[role=listbox][aria-label='Parameters'] [data-tag='2'] .grip`))")
        area = self.js("return at(document.querySelector(`section[aria-label='Inputs'] .list-rows`))")
        self.browser.act({"type": "pointer", "id": "finger", "parameters": {"pointerType": "touch"}, "actions": [
            self._to(grip), {"type": "pointerDown", "button": 0},
            {"type": "pointerMove", "x": grip["x"] + 20, "y": grip["y"] + 10, "duration": 40},
            {"type": "pointerMove", "x": area["x"], "y": area["y"], "duration": 60}, {"type": "pointerUp", "button": 0}]})
        self.assertEqual(self.tags("Inputs"), [2])


class Meter(Emulated):
    def test_what_is_used_stands_above_the_lists(self):
        above = """const [used, list] = ['[data-used]', 'section.list'].map((one) => document.querySelector(one).getBoundingClientRect());
            return used.bottom <= list.top"""
        self.assertTrue(self.js(above))
