# SPDX-License-Identifier: Apache-2.0
"""Row C-047: any GSD file is checked; and files that are none, or mean harm: a sentence, nothing executed, nothing lost."""
import pathlib
import random
import tempfile

import screen
import setting

GSD = setting.root / "gsd/605/605_1649.GSD"
FAULTY = GSD.read_bytes().replace(b"= 0x1649", b"= ident")
SCRIPT = "<img src=x onerror=\"globalThis.harmed=1\"><script>globalThis.harmed=1</script>"


class Check(screen.PageTest):
    def result(self, side="First file"):
        return self.browser.wait_for("return document.querySelector(`section[aria-label='${words[0]}']`)?.innerText",
                                     f"Check of {side}", what=f"the check of {side}")

    def test_checks_any_file_that_is_chosen(self):
        self.click("button", "Check and compare")
        self.choose_file(lambda: self.click("button", "Choose… First file"), GSD)
        self.assertIn(GSD.name, self.result())
        self.assertEqual(self.js("return document.querySelector('[data-result]').dataset.result"), "0")

    def test_checks_with_the_keyboard_and_names_the_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "605_1649.GSD")
            path.write_bytes(FAULTY)
            self.tab_to("button", "Check and compare")
            self.keys("Enter")
            self.tab_to("button", "Choose… First file")
            self.choose_file(lambda: self.keys("Enter"), path)
            self.result()  # the page has read the file before it goes
        self.assertRegex(self.result(), r"(?s)line \d+.*Ident_Number")
        self.assertEqual(self.js("return document.querySelector('[data-result]').dataset.result"), "1")

    def test_compares_two_files_that_are_dropped(self):
        self.click("button", "Check and compare")
        other = GSD.read_bytes().replace(b"MaxTsdr_9.6", b"MaxTsdr_19.2") + b"; more\r\n"
        self.drop([(GSD.name, GSD.read_bytes()), ("OTHER.GSD", other)], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')?.dataset.same === 'false'", what="the comparison")
        self.assertIn("; more", self.text("region", "Comparison"))
        self.drop([(GSD.name, GSD.read_bytes()), ("SAME.GSD", GSD.read_bytes())], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')?.dataset.same === 'true'", what="the comparison")


    def test_two_files_on_the_second_place_are_the_first_and_the_second(self):
        self.click("button", "Check and compare")
        self.drop([("ONE.GSD", GSD.read_bytes()), ("TWO.GSD", GSD.read_bytes()), ("THREE.GSD", GSD.read_bytes())],
                  "[data-drop-file='1']")
        self.browser.wait_for("return document.querySelector('[data-same]')?.dataset.same === 'true'", what="the comparison")
        self.wait_said("THREE.GSD")
        names = self.js("return [...document.querySelectorAll('.result > h2')].map((one) => one.innerText)")
        self.assertEqual(names, ["Comparison", "ONE.GSD", "TWO.GSD"])

    def test_of_several_files_the_one_that_is_not_opened_is_named(self):
        self.drop([("one.toml", b'profile = "605"\n'), ("two.toml", b'profile = "590"\n')])
        self.wait_said("Not read: two.toml")

    def test_the_mapping_that_is_edited_is_compared_and_a_file_opened_for_editing(self):
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.type_into("textbox", "File name", "MINE")
        self.click("button", "Check and compare")
        self.click("button", "Take the mapping as First file")
        self.assertIn("MINE.GSD", self.result())
        self.drop([("605_1649.GSD", GSD.read_bytes())], "[data-drop-file='1']")
        self.browser.wait_for("return document.querySelector('[data-same]')?.dataset.same === 'false'", what="the comparison")
        lines = "return document.querySelectorAll('.lines tbody tr:not(.differs)').length"
        self.assertEqual(self.js(lines), 0)
        self.click("checkbox", "Only the lines that differ")
        self.assertGreater(self.js(lines), 0)
        self.click("button", "Open for editing Second file")
        self.wait_said("605_1649.GSD was opened")
        self.assertEqual((self.value("combobox", "Device"), self.value("textbox", "File name")), ("605", "605_1649"))
        self.click("button", "Check and compare")
        self.click("button", "Remove Second file")
        self.assertFalse(self.js("return document.querySelector('[data-same]') !== null"))


class Hostile(screen.PageTest):
    def setUp(self):
        super().setUp()
        self.kept = self.tags("Inputs"), self.tags("Outputs")

    def tearDown(self):
        self.assertIsNone(self.browser.run("return globalThis.harmed ?? null"), "a script of a file ran")

    def refuse(self, name, what):
        """Opened and checked, by a drop: a sentence each time, and the mapping stays."""
        self.click("button", "Mapping")
        self.drop([(name, what)])
        self.wait_said("was not")
        self.assertGreater(len(self.notice()), 20)
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), self.kept)
        if name.lower().endswith((".gsd", ".bin")):
            self.click("button", "Check and compare")
            self.drop([(name, what)], ".slots")
            self.browser.wait_for("return document.querySelector('.result [data-result]')?.dataset.result === '1'", what="the check")
            self.assertGreater(len(self.js("return document.querySelector('.result [data-result]').innerText")), 20)
            self.click("button", "Remove First file")

    def test_a_binary_file_is_refused(self):
        octets = random.Random(1).randbytes(5000)
        for name in "a.GSD", "a.bin", "a.toml", "a.csv", "a.json":
            with self.subTest(name):
                self.refuse(name, octets)

    def test_a_file_of_20_megabytes_is_refused(self):
        for name in "a.GSD", "a.toml", "a.csv", "a.json":
            with self.subTest(name):
                self.refuse(name, 20_000_000)

    def test_a_file_in_another_code_page_is_refused(self):
        for code in "utf-16", "utf-16-be":
            with self.subTest(code):
                self.refuse("a.GSD", GSD.read_text(encoding="latin-1").encode(code))
        self.refuse("a.csv", "number;name\r\n1;Ofen ü\r\n".encode("cp850"))

    def test_an_empty_file_is_refused(self):
        for name in "a.GSD", "a.toml", "a.json":
            with self.subTest(name):
                self.refuse(name, b"")

    def test_a_file_through_the_file_chooser_is_refused_too(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "noise.GSD")
            path.write_bytes(random.Random(2).randbytes(3000))
            self.choose_file(lambda: self.keys("Control+o"), path)
            self.wait_said("was not opened")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), self.kept)

    def test_scripts_in_names_stay_texts(self):
        self.drop([(SCRIPT.replace("/", "_") + ".GSD", b"none")])
        self.wait_said("was not opened")
        self.assertIn("<img", self.notice())
        named = GSD.read_bytes().replace(b"Model_Name", b"; ", 1)
        named = named.replace(b"; ", b"Model_Name = \"" + SCRIPT.replace('"', "'").encode()[:30] + b"\"\r\n; ", 1)
        table = "tag,name,type\n1,\"" + SCRIPT.replace('"', "'") + "\",INT\n"
        self.click("button", "Check and compare")
        self.drop([("A.GSD", named), ("B.GSD", GSD.read_bytes())], ".slots")
        self.browser.wait_for("return document.querySelector('[data-same]')", what="the comparison")
        self.click("button", "Mapping")
        self.drop([("mine.csv", table.encode())])
        self.browser.wait_for("return /mine.csv/.test(document.body.innerText)", what="the table to be read")
        self.type_into("textbox", "Description", SCRIPT[:40])
        self.type_into("textbox", "File name", SCRIPT)
        self.click("button", "Start")
        self.click("button", "Store the mapping in the library")
        self.assertTrue(self.shown("button", SCRIPT, "Library"))
