# SPDX-License-Identifier: Apache-2.0
"""What the user looks for is where the eye is: search, facts of a parameter, limits, names, numbers beside colours."""
import screen
from test_small import Emulated
from test_ways import SCREENS, OnScreens, mapping


class Search(screen.PageTest):
    def search(self, text):
        self.type_into("searchbox", "Search parameters", text)
        return self.tags("Parameters")

    def names_found(self, text):
        self.search(text)
        return self.js("return [...document.querySelectorAll(`[role=listbox][aria-label='Parameters'] .name`)].map((one) => one.textContent.toLowerCase())")

    def test_an_exact_name_comes_first(self):
        for query, tag in ("setpoint 1", 24), ("Process Variable", 1), ("proportional band pid1", 6), ("24", 24):
            with self.subTest(query):
                self.assertEqual(self.search(query)[0], tag)

    def test_names_that_begin_so_come_before_those_that_only_have_it(self):
        names = self.names_found("alarm")
        leading = [name.startswith("alarm") for name in names]
        self.assertIn(True, leading)
        self.assertIn(False, leading)
        self.assertEqual(leading, sorted(leading, reverse=True))

    def test_the_mnemonics_of_the_instrument_find_their_parameter_first(self):
        for query, tag in ("PV", 1), ("sp1", 24), ("SP2", 25), ("OP", 3), ("wsp", 5):
            with self.subTest(query):
                self.assertEqual(self.search(query)[0], tag)

    def test_for_a_typo_one_other_query_is_offered(self):
        for typed, meant in ("proprotional", "proportional"), ("setpiont 1", "setpoint 1"), ("alrm", "alarm"):
            with self.subTest(typed):
                self.assertEqual(self.search(typed), [])
                offered = [name for name in self.names("button", "Device parameters") if name.startswith("Search for")]
                self.assertEqual(offered, [f"Search for “{meant}”"])
                self.click("button", offered[0])
                self.assertEqual(self.value("searchbox", "Search parameters"), meant)
                self.assertTrue(self.tags("Parameters"))

    def test_for_what_is_like_nothing_no_query_is_offered(self):
        self.assertEqual(self.search("xqzzyk"), [])
        self.assertFalse(self.shown("button", "Search for"))


class Chosen(OnScreens):
    def test_type_range_and_values_of_the_chosen_parameter_are_in_view(self):
        rows = {row["number"]: row for row in self.browser.call([{"do": "tags", "profile": "2408f"}])[0]["tags"]}
        tag = next(number for number, row in rows.items() if row["labels"] and row["min"] is not None)
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                self.type_into("searchbox", "Search parameters", str(tag))
                self.press(self.row_place("Parameters", tag))
                about = self.text("region", "About the parameter")
                for fact in "Type", rows[tag]["type"], "Range", f"{rows[tag]['min']} to {rows[tag]['max']}", "Values", rows[tag]["labels"][0]["text"]:
                    self.assertIn(fact, about)
                self.assertTrue(self.in_view(".chosen-tag"))
                self.assertTrue(self.js("""const row = document.querySelector(`[role=listbox][aria-label='Parameters'] [aria-selected=true]`);
                    const { left, top, height } = row.getBoundingClientRect();
                    return row.contains(document.elementFromPoint(left + 60, top + height / 2))"""))

    def test_the_list_that_has_it_says_type_and_range_too(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                self.press(self.row_place("Outputs", 15))
                line = self.js("""const one = document.querySelector("section[aria-label='Outputs'] p.about"); one.scrollIntoView({ block: 'nearest' });
                    return one.textContent""")
                self.assertRegex(line, r"^Type \w+ · range ")
                self.assertTrue(self.in_view("section[aria-label='Outputs'] p.about"))


class Bars(OnScreens):
    def rows_of_buttons(self):
        """In how many rows the buttons of each list stand."""
        return self.js("""return [...document.querySelectorAll('.list-bar')].filter(seen).map((bar) =>
            new Set([...bar.querySelectorAll('button')].filter(seen).map((one) => Math.round(one.getBoundingClientRect().top))).size)""")

    def test_each_list_has_one_row_of_buttons(self):
        for name in SCREENS:
            for profile, lists in ("690plus", 3), ("2408f", 2):
                with self.subTest(name, profile=profile):
                    self.size(name)
                    self.choose("Device", profile)
                    self.assertEqual(self.rows_of_buttons(), [1] * lists)
                    self.assertFalse(self.is_wider())

    def test_each_list_has_one_row_of_buttons_on_other_screens(self):
        for width in 1152, 1200, 1270, 1280, 1600, 800:
            with self.subTest(width=width):
                self.browser.cdp("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=False)
                self.browser.wait_for("return innerWidth === words[0]", width, what="the size")
                self.assertEqual(self.rows_of_buttons(), [1, 1])

    def test_of_three_lists_the_menu_moves_between_them(self):
        self.opened(profile="690plus", ident=0x1652, list=["in:271", "in:272"])
        self.assertFalse(self.shown("button", "To outputs from inputs"))
        self.press(self.row_place("Inputs", 271))
        self.click("button", "More in inputs")
        self.assertTrue({"Move to outputs", "Move to read and write"} <= set(self.names("menuitem")))
        self.click("menuitem", "Move to read and write")
        self.assertEqual((self.tags("Inputs"), self.tags("Read and write")), ([272], [271]))

    def test_without_a_choice_the_reason_stands_in_the_list(self):
        self.click("button", "Add to outputs")
        self.assertIn("Select a parameter of the device first", self.text("region", "Outputs"))
        self.type_into("textbox", "Add tag by number", "30")
        self.keys("Enter")
        self.assertNotIn("Select a parameter", self.text("region", "Outputs"))


class Number(OnScreens):
    def under_the_field(self):
        """How far under the field the reason stands."""
        return self.js("""const field = find('textbox', 'Add tag by number');
            return field.form.querySelector('.wrong-note').getBoundingClientRect().top - field.getBoundingClientRect().bottom""")

    def test_names_the_legal_range_of_the_device(self):
        for profile in self.browser.call([{"do": "profiles"}])[0]["profiles"]:
            self.choose("Device", profile["name"])
            self.assertIn(f"A number from 1 to {profile['max_tag']}", self.js("return find('textbox', 'Add tag by number').form.innerText"))

    def test_the_reason_stands_under_the_field(self):
        for name in SCREENS:
            with self.subTest(name):
                self.size(name)
                most = next(one for one in self.browser.call([{"do": "profiles"}])[0]["profiles"] if one["name"] == "2408f")["max_tag"]
                for wrong in "0", str(most + 1), "word", "":
                    self.type_into("textbox", "Add tag by number", wrong)
                    self.keys("Enter")
                    self.assertIn(f"write a number from 1 to {most}", self.js("return find('textbox', 'Add tag by number').form.innerText"))
                    self.assertLess(self.under_the_field(), 60)
                    self.assertEqual(self.js("return document.activeElement.labels[0].textContent"), "Add tag by number")
                self.type_into("textbox", "Add tag by number", "30")
                self.keys("Enter")
                self.assertIn(30, self.tags("Inputs"))
                self.assertEqual(self.js("return find('textbox', 'Add tag by number').form.querySelector('.wrong-note').textContent"), "")


class Outputs(OnScreens):
    def setUp(self):
        super().setUp()
        rows = self.browser.call([{"do": "tags", "profile": "2408f"}])[0]["tags"]
        self.read_only = next(row["number"] for row in rows if row["access"] == "read_only" and row["name"])
        self.unknown = next(row["number"] for row in rows if row["access"] == "unknown" and not row["never_written"] and row["type"] != "STRING")
        self.opened(profile="2408f", ident=0x1652, list=["in:30", "out:24"])

    def test_a_measured_value_cannot_become_one(self):
        tag = str(self.read_only)
        self.click("region", "Outputs")
        self.type_into("textbox", "Add tag by number", tag)
        self.keys("Enter")
        self.assertIn("cannot be an output", self.js("return find('textbox', 'Add tag by number').form.innerText"))
        self.type_into("searchbox", "Search parameters", tag)
        self.press(self.row_place("Parameters", self.read_only))
        self.click("button", "Add to outputs")
        self.assertIn("cannot be an output", self.text("region", "Outputs"))
        self.drag(self.row_place("Parameters", self.read_only), self.js(
            "const box = document.querySelector(`section[aria-label='Outputs'] .list-rows`).getBoundingClientRect(); return [box.left + 40, box.bottom - 6].map(Math.round)"))
        self.click("button", "Add to inputs")
        self.click("button", "To outputs from inputs")
        self.assertEqual(self.tags("Outputs"), [24])
        self.assertIn(self.read_only, self.tags("Inputs"))
        self.assertIn("cannot be an output", self.text("region", "Inputs"))

    def test_a_measured_value_of_an_opened_mapping_is_an_error_with_a_way(self):
        self.opened(profile="2408f", ident=0x1652, list=["in:1", f"out:{self.read_only}"])
        self.assertEqual(self.js("return document.querySelector('.live .findings [data-code=read_only]').className"), "error")
        self.click("button", "Show the parameter", "Preview")
        self.assertEqual(self.focused(), "Outputs")

    def test_one_whose_access_is_not_known_is_a_warning(self):
        self.click("region", "Outputs")
        self.type_into("textbox", "Add tag by number", str(self.unknown))
        self.keys("Enter")
        self.assertEqual(self.tags("Outputs"), [24, self.unknown])
        self.assertEqual(self.js("return document.querySelector('.live .findings [data-code=access_unknown]').className"), "warning")


class Rates(screen.PageTest):
    def rates(self):
        return self.js("return [...document.querySelectorAll('.rates div')].map((one) => [one.querySelector('dt').textContent, one.querySelector('dd').textContent])")

    def test_max_tsdr_stands_by_rate(self):
        own = next(one for one in self.browser.call([{"do": "profiles"}])[0]["profiles"] if one["name"] == "590")["max_tsdr"]
        self.choose("Device", "590")
        named = [f"{one['baud'] / 1000:g} kbit/s" if one["baud"] < 1e6 else f"{one['baud'] / 1e6:g} Mbit/s" for one in own if one["baud"] != 45450]
        bits = [one["bits"] for one in own if one["baud"] != 45450]
        self.assertEqual(self.rates(), [[name, str(one)] for name, one in zip(named, bits)])
        most = (min(bits) + max(bits)) // 2
        self.type_into("textbox", "MaxTsdr", str(most))
        self.assertEqual(self.rates(), [[name, f"{most} instead of {one}" if most > one else str(one)] for name, one in zip(named, bits)])


class Names(OnScreens):
    def files(self, *keys):
        return [screen.dpctl("gsd", "make", "--mapping", "FILE", text=mapping(**one)) for one in keys]

    def test_stand_in_the_comparison_and_in_the_map_of_a_file(self):
        one, other = self.files({"profile": "2408f", "ident": 0x1652, "list": ["in:1"]}, {"profile": "2408f", "ident": 0x1652, "list": ["in:2"]})
        self.click("button", "Check and compare")
        self.drop([("A.GSD", one), ("B.GSD", other)], ".slots")
        self.browser.wait_for("return document.querySelectorAll('.result').length === 3", what="the results")
        meaning = self.js("return document.querySelector('.meaning').innerText")
        self.assertIn("Process variable", meaning)
        self.assertIn("Target setpoint", meaning)
        self.assertRegex(self.text("region", "What First file says"), r"1 +Process variable")

    def test_of_a_table_of_ones_own_are_read_from_the_file(self):
        text = mapping(profile="605", list=["in:7"]) + b'[table]\nfile = "mine.csv"\nrows = """\ntag,name,type\n7,Dancer position,INT\n"""\n'
        self.click("button", "Check and compare")
        self.drop([("A.GSD", screen.dpctl("gsd", "make", "--mapping", "FILE", text=text))], ".slots")
        self.browser.wait_for("return document.querySelector('.result')", what="the result")
        self.assertIn("Dancer position", self.text("region", "What First file says"))

    def test_stand_in_the_map_of_the_mapping(self):
        self.opened(profile="2408f", ident=0x1652, list=["in:1", "out:24"])
        self.click("tab", "I/O map")
        text = self.js("return document.querySelector('.maps').innerText")
        self.assertIn("Process variable", text)
        self.assertIn("Setpoint 1", text)


class Colours(screen.PageTest):
    def test_a_number_stands_beside_each_colour(self):
        bare = """return [...document.querySelectorAll(words[0])].filter(seen).filter((one) =>
            !/[0-9D·]/.test(one.matches('.part') ? getComputedStyle(one, '::before').content : one.textContent)).map((one) => one.outerHTML)"""
        self.assertGreater(self.js("return document.querySelectorAll('.part').length"), 10)
        for tab in "GSD file", "Octets", "I/O map":
            self.click("tab", tab)
            self.assertEqual(self.js(bare, ".hue"), [])
        self.click("tab", "GSD file")
        numbers = self.js("return [...document.querySelectorAll('.part')].map((one) => [one.dataset.parameter, getComputedStyle(one, '::before').content])")
        self.assertEqual([content.strip('"') for _, content in numbers], [number for number, _ in numbers])


class Phone(OnScreens):
    SMALL = """return [...document.querySelectorAll(words[0])].filter(seen).filter((one) => !one.matches('.unseen')).map((one) =>
        one.matches('[type=checkbox]') ? one.closest('label') : one).filter((one) => {
            const { width, height } = one.getBoundingClientRect();
            return width < 43.9 || height < 43.9;
        }).map((one) => `${one.outerHTML.slice(0, 90)} ${one.getBoundingClientRect().width} x ${one.getBoundingClientRect().height}`)"""
    TARGETS = "button, input, select, [role=option], [role=tab], [role=menuitem]"

    def setUp(self):
        super().setUp()
        self.size("phone")

    def test_every_target_has_44_pixels(self):
        for name in "Start", "Check and compare", "Mapping":
            self.click("button", name)
            with self.subTest(name):
                self.assertEqual(self.js(self.SMALL, self.TARGETS), [])
                self.assertFalse(self.is_wider())
        for device in "690plus", "590":
            self.choose("Device", device)
            with self.subTest(device):
                self.assertEqual(self.js(self.SMALL, self.TARGETS), [])
                self.assertFalse(self.is_wider())
        self.click("tab", "In telegram order")
        self.assertEqual(self.js(self.SMALL, self.TARGETS), [])

    def test_every_target_of_dialogs_menus_and_notices_has_44_pixels(self):
        self.press(self.row_place("Inputs", self.tags("Inputs")[0]))
        self.click("button", "More in inputs")
        self.assertEqual(self.js(self.SMALL, self.TARGETS), [])
        self.assertTrue(self.js("const { left, right, top, bottom } = find('menu').getBoundingClientRect(); return left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight"))
        self.keys("Escape")
        self.drop([("T.GSD", b"nothing")])
        self.wait_said("was not opened")
        self.assertEqual(self.js(self.SMALL, self.TARGETS), [])
        for kind in "gsd", "station":
            self.keys("Control+Shift+s")
            self.choose("Kind of file", kind)
            self.assertEqual(self.js(self.SMALL, "dialog[open] button, dialog[open] input, dialog[open] select"), [])
            self.keys("Escape")
        self.click("button", "Print")
        self.assertEqual(self.js(self.SMALL, "dialog[open] button, dialog[open] input"), [])

    def test_no_word_is_said_of_a_right_button(self):
        self.assertNotIn("right button", self.js("return document.documentElement.outerHTML").lower())
        self.assertNotIn("right button", self.js("return [...document.scripts].map((one) => one.textContent).join(' ')").lower())

    def test_a_finger_does_what_the_menu_does(self):
        self.opened(profile="690plus", ident=0x1652, list=["in:271", "in:272"])
        for part in ("return at(document.querySelector(`[role=listbox][aria-label='Inputs'] [data-tag='271'] .name`))",
                     "return at(find('button', 'More in inputs'))", "return at(find('menuitem', 'Move to outputs'))"):
            place = self.js(part)
            self.browser.act({"type": "pointer", "id": "finger", "parameters": {"pointerType": "touch"}, "actions": [
                self._to(place), {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]})
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([272], [271]))
