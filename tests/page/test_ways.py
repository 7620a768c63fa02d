# SPDX-License-Identifier: Apache-2.0
"""From each error to the field that mends it: with the pointer, with the keyboard, on a PC and on a phone."""
import screen
from test_small import Emulated

SCREENS = {"1366 x 768": (1366, 768, 1), "phone": (390, 844, 3)}


def mapping(**keys):
    """A mapping file."""
    def value(one):
        if isinstance(one, bool):
            return str(one).lower()
        if isinstance(one, list):
            return "[" + ", ".join(f'"{entry}"' for entry in one) + "]"
        return str(one) if isinstance(one, int) else f'"{one}"'
    return "".join(f"{key} = {value(one)}\n" for key, one in keys.items()).encode()


class OnScreens(Emulated):
    """Shows the page on a PC and on a phone."""

    def size(self, name):
        width, height, scale = SCREENS[name]
        self.browser.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=name == "phone")
        self.browser.cdp("Emulation.setTouchEmulationEnabled", enabled=name == "phone")
        self.addCleanup(self.browser.cdp, "Emulation.setTouchEmulationEnabled", enabled=False)
        self.browser.wait_for("return innerWidth === words[0]", width, what="the size")
        self.browser.run("localStorage.clear()")
        self.open()

    def in_view(self, selector):
        """Whether a part is to be seen as a whole, with nothing above it."""
        return self.js("""const part = document.querySelector(words[0]);
            const { left, top, right, bottom } = part.getBoundingClientRect();
            const foot = document.querySelector('footer').getBoundingClientRect().top;
            const over = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
            return left >= 0 && top >= 0 && right <= innerWidth && bottom <= foot && (part.contains(over) || over.contains(part))""", selector)

    def is_wider(self):
        return self.js("const one = document.querySelector('.scroll');"
                       "return one.scrollWidth > one.clientWidth || document.documentElement.scrollWidth > innerWidth")

    def focused(self):
        """The field that has the focus."""
        return self.js("const one = document.activeElement; return one.dataset.field ?? one.dataset.way ?? one.getAttribute('aria-label')")

    def opened(self, **keys):
        self.drop([("MINE1652.toml", mapping(**keys))])
        self.wait_said("MINE1652.toml was opened")


class Ident(OnScreens):
    def test_where_the_profile_has_no_ident_number_its_field_is_in_view_before_all_others(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                self.assertTrue(self.in_view("[data-field=ident]"))
                self.assertEqual(self.js("return document.querySelector('.mapping input').dataset.field"), "ident")
                self.assertFalse(self.is_wider())

    def test_where_the_profile_has_one_the_field_stands_with_the_others(self):
        self.choose("Device", "605")
        self.assertFalse(self.shown("region", "Number of your device"))
        self.assertTrue(self.shown("textbox", "Ident_Number", "File"))
        self.choose("Device", "2408f")
        self.assertTrue(self.shown("textbox", "Ident_Number", "Number of your device"))

    def test_the_error_jumps_to_the_field_from_wherever_the_page_is_scrolled_to(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                self.js("document.querySelector('.scroll').scrollTo(0, 1e6)")
                self.click("button", "Show the field Ident_Number")
                self.assertEqual(self.focused(), "ident")
                self.assertTrue(self.in_view("[data-field=ident]"))
                self.keys("=1652")
                self.assertEqual(self.value("textbox", "Ident_Number"), "1652")
                self.assertFalse(self.js("return [...document.querySelectorAll('.live .findings li')].some((one) => one.className === 'error')"))

    def test_the_error_jumps_to_the_field_with_the_keyboard(self):
        self.tab_to("button", "Show the field Ident_Number")
        self.keys("Enter")
        self.assertEqual(self.focused(), "ident")

    def test_the_reason_stands_under_the_field(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                gap = """const field = find('textbox', 'Ident_Number');
                    const reason = field.closest('.field').querySelector('.reasons .error, .wrong-note:not(:empty)');
                    const note = field.closest('.field').querySelector('.note').getBoundingClientRect();
                    return reason.getBoundingClientRect().top - Math.max(note.bottom, field.getBoundingClientRect().bottom)"""
                self.assertLess(self.js(gap), 30)
                self.type_into("textbox", "Ident_Number", "10000")
                self.assertIn("Not used", self.js("return find('textbox', 'Ident_Number').closest('.field').innerText"))
                self.assertLess(self.js(gap), 30)


class Save(OnScreens):
    def setUp(self):
        super().setUp()
        self.js("globalThis.asked = 0; globalThis.showSaveFilePicker = async () => { ++globalThis.asked; throw new DOMException('', 'AbortError'); }")

    def test_asks_for_the_ident_number_before_the_file_dialog(self):
        self.keys("Control+s")
        self.assertEqual(self.js("return document.activeElement.labels[0].textContent"), "Ident_Number")
        self.keys("Enter")
        self.assertEqual(self.js("return document.activeElement.labels[0].textContent"), "Ident_Number")
        self.assertIn("Write the Ident_Number of your device", self.js("return document.activeElement.closest('.field').innerText"))
        self.assertEqual(self.browser.run("return globalThis.asked"), 0)
        self.keys("=1652", "Enter")
        self.browser.wait_for("return globalThis.asked === 1", what="the file dialog")
        self.assertEqual(self.value("textbox", "Ident_Number"), "0x1652")

    def test_a_mapping_is_saved_without_the_number(self):
        self.keys("Control+s")
        self.choose("Kind of file", "mapping")
        self.assertFalse(self.js("return [...document.querySelectorAll('dialog[open] label')].some((one) => seen(one) && one.textContent === 'Ident_Number')"))
        self.js("document.querySelector('dialog[open] input[type=text]').focus()")
        self.keys("Enter")
        self.browser.wait_for("return globalThis.asked === 1", what="the file dialog")

    def test_shows_the_errors_before_the_file_dialog_and_leads_to_their_fields(self):
        self.opened(profile="2408f", ident=0x1652, max_tsdr=11, list=["in:1"])
        self.keys("Control+s", "Enter")
        self.assertIn("MaxTsdr 11 is at no rate larger", self.js("return document.querySelector('dialog[open]').innerText"))
        self.assertIn("when these errors are gone", self.js("return document.querySelector('dialog[open]').innerText"))
        self.js("[...document.querySelectorAll('dialog[open] .findings button')][0].click()")
        self.assertFalse(self.shown("dialog"))
        self.assertEqual(self.focused(), "max_tsdr")
        self.assertEqual(self.browser.run("return globalThis.asked"), 0)

    def test_of_a_block_for_the_gateway_the_reason_stands_at_its_field(self):
        self.keys("Control+s")
        self.choose("Kind of file", "station")
        self.js("const one = [...document.querySelectorAll('dialog[open] label')].find((each) => each.textContent === 'Ident_Number');"
                "document.getElementById(one.htmlFor).focus()")
        self.keys("=1652", "Enter")
        self.assertEqual(self.js("return document.activeElement.labels[0].textContent"), "PROFIBUS address")
        self.assertIn("has to be a number from 0 to", self.js("return document.activeElement.closest('.field').innerText"))


ERRORS = [  # (keys of the mapping, code, what gets the focus)
    ({"profile": "2408f"}, "ident_missing", "ident"),
    ({"profile": "2408f", "ident": 0x1652, "model": "M" * 40}, "text_too_long", "model"),
    ({"profile": "2408f", "ident": 0x1652, "description": "D" * 300}, "text_too_long", "description"),
    ({"profile": "2408f", "ident": 0x1652, "max_tsdr": 11}, "max_tsdr_no_effect", "max_tsdr"),
    ({"profile": "2408f", "ident": 0x1652, "list": ["in:1", "in:1"]}, "read_twice", "Inputs"),
    ({"profile": "2408f", "ident": 0x1652, "list": ["out:24", "out:24"]}, "written_twice", "Outputs"),
    ({"profile": "2408f", "ident": 0x1652, "list": ["in:1", "out:199"]}, "never_written", "Outputs"),
    ({"profile": "2408f", "ident": 0x1652, "list": ["in:20000"]}, "prm_tag_too_large", "Inputs"),
    ({"profile": "2408f", "ident": 0x1652, "list": ["in-out:1"]}, "no_such_direction", "Read and write"),
    ({"profile": "2408f", "ident": 0x1652, "list": [f"in:{tag}" for tag in range(1, 119)]}, "prm_length", "Inputs"),
    ({"profile": "2408f", "ident": 0x1652, "demand": True, "list": [f"in:{tag}" for tag in range(1, 111)]}, "cfg_too_long", "Inputs"),
    ({"profile": "590", "list": [f"in:{tag}" for tag in range(1, 14)]}, "prm_length", "Inputs"),
    ({"profile": "2408f", "ident": 0x1652, "list": []}, "no_mapping", "search"),
    ({"profile": "2408f", "ident": 0x1652, "list": [f"in:{tag}" for tag in range(1, 126)]}, "too_many_octets", "Inputs"),
]


class Errors(OnScreens):
    def test_each_error_leads_to_what_mends_it(self):
        for keys, code, goal in ERRORS:
            with self.subTest(code, goal=goal):
                self.open()
                self.opened(**keys)
                self.js("document.querySelector('.scroll').scrollTo(0, 0)")
                self.assertEqual(self.js("return [...document.querySelectorAll('.live .findings li.error')]"
                                         ".filter((one) => !one.querySelector('button')).map((one) => one.innerText)"), [])
                self.press(self.js("return at(document.querySelector(`.live .findings li[data-code=${words[0]}] button`))", code))
                self.assertEqual(self.focused(), goal)
                self.assertTrue(self.js("const { top, bottom } = document.activeElement.getBoundingClientRect();"
                                        "return bottom > 0 && top < document.querySelector('footer').getBoundingClientRect().top"))

    def test_a_text_that_no_mapping_takes_leads_to_its_field(self):
        self.js("""const one = find('textbox', 'Description');
            one.value = 'a\\tb';
            one.dispatchEvent(new Event('input', { bubbles: true }))""")
        self.click("button", "Show the field Description")
        self.assertEqual(self.focused(), "description")

    def test_a_notice_is_in_view_wherever_the_page_is_scrolled_to(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                self.js("document.querySelector('.scroll').scrollTo(0, 1e6)")
                self.drop([("T.GSD", b"nothing")])
                self.wait_said("was not opened")
                self.assertTrue(self.in_view(".notice.error"))


def verdict(test, part):
    """The findings as they stand there: (severity, line, sentence)."""
    return test.js("""return [...document.querySelectorAll(`${words[0]} .findings li`)].map((one) =>
        [one.className, one.querySelector('.line')?.textContent ?? '', one.querySelector('[data-text]').textContent])""", part)


class Verdict(screen.PageTest):
    MAPPINGS = [
        ("EURO2400", {"profile": "2408f", "ident": 0x1652}),  # the name says nothing of the number
        ("EURO1652", {"profile": "2408f", "ident": 0x1652, "list": ["in:1"]}),
        ("OVEN", {"profile": "2408f", "ident": 0x1652, "list": [f"in:{tag}" for tag in range(1, 40)], "max_tsdr": 2000}),
        ("D1652", {"profile": "605", "ident": 0x1652, "list": ["in:1", "out:2", "in-out:3"]}),
        ("590_0533", {"profile": "590", "list": ["in:1", "out:2"], "model": "Mine Ω"}),
        ("X690", {"profile": "690plus", "ident": 0x1652, "list": ["in:271", "in:272"], "demand": True}),
    ]

    def test_of_the_mapping_and_of_the_saved_file_is_the_same_in_count_and_sentence(self):
        seen = 0
        for name, keys in self.MAPPINGS:
            with self.subTest(name):
                self.browser.run("localStorage.clear()")
                self.open()
                self.drop([(f"{name}.toml", mapping(**keys))])
                self.wait_said("was opened")
                said, summary = verdict(self, ".live"), self.text("region", "Findings").split("\n")[0]
                seen += len(said)
                self.keys("Control+Shift+s")
                self.js("document.querySelector('dialog[open] input[type=text]').focus()")
                saved, octets = self.saved(lambda: self.keys("Enter"))
                self.assertEqual(saved, f"{name}.GSD")
                self.wait_said(saved)
                self.assertEqual([row[2] for row in verdict(self, ".notice")], [row[2] for row in said])
                for opened in (lambda: self.drop([(saved, octets)], ".slots"),
                               lambda: self.click("button", "Take the mapping", "First file")):
                    self.click("button", "Check and compare")
                    opened()
                    self.browser.wait_for("return document.querySelector('[data-result]')", what="the check")
                    self.assertEqual(verdict(self, ".result"), said)
                    self.assertEqual(self.js("return document.querySelector('[data-result]').innerText"), summary)
                    self.click("button", "Remove First file")
                    self.browser.wait_for("return !document.querySelector('[data-result]')", what="an empty place")
        self.assertGreater(seen, 6)

    def test_follows_the_name_of_the_file(self):
        self.type_into("textbox", "Ident_Number", "1652")
        self.type_into("textbox", "File name", "EURO1652")
        before = verdict(self, ".live")
        self.type_into("textbox", "File name", "EURO1653")
        after = verdict(self, ".live")
        self.assertEqual(len(after), len(before) + 1)
        self.assertTrue(any("does not end in 1652" in row[2] for row in after))
        self.click("button", "Show the field File name")
        self.assertEqual(self.js("return document.activeElement.dataset.field"), "name")

    def test_is_that_of_the_draft_s_own_table(self):
        self.open()
        self.drop([("MINE1649.toml", mapping(profile="605", list=["in:7"]))])
        self.wait_said("was opened")
        self.drop([("mine.csv", b"tag,name,type\r\n7,Dancer,STRING\r\n")])
        self.wait_said("was loaded")
        said = verdict(self, ".live")
        self.assertTrue(any("is a text" in row[2] for row in said))
        self.click("button", "Check and compare")
        self.click("button", "Take the mapping", "First file")
        self.browser.wait_for("return document.querySelector('[data-result]')", what="the check")
        self.assertEqual(verdict(self, ".result"), said)
