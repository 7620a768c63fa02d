# SPDX-License-Identifier: Apache-2.0
"""Rows C-031, C-033, C-034, C-042, C-045 and C-046: how a file is begun, opened, named, saved and kept."""
import json
import pathlib
import tempfile

import screen
import setting



class Start(screen.PageTest):
    def go(self, name):
        self.click("button", name)

    def test_opens_with_the_standard_layout(self):  # C-031
        wanted = self.browser.call([{"do": "profiles"}])[0]["profiles"]
        standard = next(one for one in wanted if one["name"] == "2408f")["default_list"]
        tags = {name: [int(one.split(":")[1]) for one in standard if one.startswith(name + ":")] for name in ("in", "out")}
        self.assertEqual(self.tags("Inputs"), tags["in"])
        self.assertEqual(self.tags("Outputs"), tags["out"])
        self.assertTrue(tags["in"])
        self.assertEqual(self.value("textbox", "File name"), "EURO2400")
        self.assertIn("EURO2400", self.said())

    def new_file(self, device):
        self.choose("Device", device)
        self.click("button", "New file", "New file")

    def test_begins_a_file_for_each_device(self):  # C-033
        for profile in self.browser.call([{"do": "profiles"}])[0]["profiles"]:
            with self.subTest(profile["name"]):
                self.go("Start")
                self.new_file(profile["name"])
                self.assertEqual(self.tags("Inputs") + self.tags("Outputs"), [])
                self.assertEqual(self.shown("listbox", "Read and write") or self.shown("region", "Read and write"),
                                 "in-out" in profile["lists"])

    def test_begins_a_file_with_the_keyboard(self):  # C-033
        self.tab_to("button", "New")
        self.keys("Enter")
        self.tab_to("combobox", "Device")
        self.keys("=605")
        self.tab_to("button", "New file")
        self.keys("Enter")
        self.assertIn("605", self.said())

    def test_opens_a_file_of_a_supported_device_by_the_file_chooser_and_by_a_drop(self):  # C-033
        file = screen.dpctl("gsd", "make", "--profile", "2408f", "--in", "1,2", "--out", "6", "--ident", "0x1652")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "MINE1652.GSD")
            path.write_bytes(file)
            for trigger in (lambda: self.click("button", "Open"), lambda: self.keys("Control+o")):
                self.open()
                self.choose_file(trigger, path)
                self.choose_profile("2408f")
                self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([1, 2], [6]))
        self.open()
        self.drop([("MINE1652.GSD", file)])
        self.choose_profile("2408f")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([1, 2], [6]))
        self.assertEqual(self.value("textbox", "File name"), "MINE1652")

    def choose_profile(self, name):
        """Where the file leaves open which device it is for."""
        self.browser.wait_for("return document.querySelector('dialog[open]') || /opened/.test(document.getElementById('said').textContent)",
                              what="the file to be read")
        if self.shown("dialog"):
            self.choose("Device", name)
            self.js("find('button', 'Open', null); [...document.querySelectorAll('dialog[open] button[type=submit]')][0].click()")
        self.wait_said("was opened")

    def test_refuses_a_file_of_another_device_with_a_reason(self):  # C-033
        kept = self.tags("Inputs")
        t630 = (b"#Profibus_DP\r\nGSD_Revision = 1\r\nVendor_Name = \"Eurotherm\"\r\nModel_Name = \"T630\"\r\nRevision = \"1\"\r\n"
                b"Ident_Number = 0x1234\r\nProtocol_Ident = 0\r\nStation_Type = 0\r\nModule = \"x\" 0x50\r\nEndModule\r\n")
        self.drop([("T630.GSD", t630)])
        self.wait_said("was not opened")
        self.assertRegex(self.notice(), r"T630")
        self.assertEqual(self.tags("Inputs"), kept)

    def test_saves_under_any_name_the_octets_of_dpctl(self):  # C-034
        wanted = screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652", "--model", "Ofen ü")
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.type_into("textbox", "Model_Name", "Ofen ü")
        self.click("button", "Save as")
        self.dialog_name("OVEN1652")
        self.assertEqual(self.saved(lambda: self.keys("Enter")), ("OVEN1652.GSD", wanted))
        self.wait_said("OVEN1652.GSD")
        self.assertEqual(self.saved(lambda: self.click("button", "Save")), ("OVEN1652.GSD", wanted))
        self.assertEqual(self.saved(lambda: self.keys("Control+s")), ("OVEN1652.GSD", wanted))

    def test_saves_to_where_the_browser_lets_the_user_pick(self):  # C-034
        self.js("""globalThis.written = [];
            globalThis.showSaveFilePicker = async ({ suggestedName }) => ({
                name: `picked-${suggestedName}`,
                createWritable: async () => ({ write: async (octets) => globalThis.written.push(...octets), close: async () => {} }),
            })""")
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.keys("Control+s")
        self.dialog_name("OVEN")
        self.keys("Enter")
        self.wait_said("picked-OVEN.GSD was saved")
        self.assertEqual(bytes(self.browser.run("return globalThis.written")),
                         screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652"))

    def dialog_name(self, name):
        self.js("const one = document.querySelector('dialog[open] input[type=text]'); one.focus(); one.select()")
        self.keys("Delete", f"={name}")

    def test_saves_a_mapping_that_dpctl_takes(self):  # C-034
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.keys("Control+Shift+s")
        self.choose("Kind of file", "mapping")
        self.dialog_name("mine")
        name, octets = self.saved(lambda: self.keys("Enter"))
        self.assertEqual(name, "mine.toml")
        self.assertEqual(screen.dpctl("gsd", "make", "--mapping", "FILE", text=octets),
                         screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652"))

    def test_a_mapping_keeps_the_table_of_ones_own(self):  # C-045
        table = b'tag,name,type\r\n7,"Dancer ""position""",INT\r\n'
        self.go("Start")
        self.new_file("605")
        self.drop([("mine.csv", table)])
        self.wait_said("was loaded")
        self.type_into("textbox", "Add tag by number", "7")
        self.keys("Enter")
        text = "return find('region', 'Text of the GSD file').innerText"
        made = self.js(text)
        self.assertIn("tag 7 Dancer 'position'", made)  # a GSD has no quotes in its texts
        self.keys("Control+Shift+s")
        self.choose("Kind of file", "mapping")
        self.dialog_name("mine")
        name, octets = self.saved(lambda: self.keys("Enter"))
        self.assertNotIn("not saved", self.js("return document.querySelector('[data-file]').innerText"))
        self.assertEqual(screen.dpctl("gsd", "make", "--mapping", "FILE", text=octets).decode("latin-1").split(), made.split())
        self.browser.run("localStorage.clear()")  # as on another PC
        self.open()
        self.drop([(name, octets)])
        self.wait_said("was opened")
        self.assertEqual(self.js(text), made)
        self.assertIn("mine.csv", self.text("region", "Device parameters"))
        self.click("button", "Use the shipped table")
        self.assertIn("not saved", self.js("return document.querySelector('[data-file]').innerText"))

    def test_a_file_that_was_made_with_a_table_of_ones_own_has_its_lost_names_named(self):  # C-045
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mine.csv")
            path.write_bytes(b"tag,name,type\n7,Dancer position,INT\n")
            file = screen.dpctl("gsd", "make", "--profile", "605", "--table", str(path), "--in", "7")
            self.drop([("MINE1649.GSD", file)])
            self.wait_said("was opened")
            self.assertIn("Dancer position", self.notice())
            self.drop([("mine.csv", path.read_bytes())])
        self.wait_said("was loaded")
        self.keys("Control+Shift+s")
        self.dialog_name("MINE1649")
        self.assertEqual(self.saved(lambda: self.keys("Enter")), ("MINE1649.GSD", file))

    def test_a_new_file_of_a_controller_has_no_parameter_and_no_octets(self):
        self.click("button", "Clear inputs")
        self.click("button", "Clear outputs")
        self.assertIn("0 of 117 words", self.js("return document.querySelector('[data-used]').innerText"))
        self.assertFalse(self.shown("region", "Text of the GSD file"))
        self.click("checkbox", "Use Demand Data")
        self.type_into("textbox", "Ident_Number", "1652")
        self.keys("Control+Shift+s")
        self.js("document.querySelector('dialog[open] input[type=text]').focus()")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[1],
                         screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652", "--order", "none", "--demand"))

    def test_opens_a_mapping_that_leaves_the_list_to_the_profile(self):
        standard = self.tags("Inputs"), self.tags("Outputs")
        self.click("button", "Clear inputs")
        self.drop([("plain.toml", b'profile = "2408f"\nident = 0x1652\n')])
        self.wait_said("plain.toml was opened")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), standard)

    def test_takes_an_ident_number_as_hexadecimal_with_and_without_0x(self):
        wanted = screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652")
        for typed in "1652", "0x1652", "  0X1652 ":
            self.type_into("textbox", "Ident_Number", typed)
            self.keys("Tab")
            self.assertEqual(self.value("textbox", "Ident_Number"), "0x1652")
            self.assertRegex(self.text("region", "Text of the GSD file"), r"Ident_Number +\= 0x1652")
        self.keys("Control+Shift+s")
        self.js("document.querySelector('dialog[open] input[type=text]').focus()")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[1], wanted)

    def test_does_not_use_a_number_that_is_out_of_range(self):
        before = self.text("region", "Text of the GSD file")
        for name, numbers in ("Ident_Number", ("0", "0x", "10000", "word")), ("MaxTsdr", ("1", "10", "65536", "0x100")):
            for number in numbers:
                self.type_into("textbox", name, number)
                self.assertEqual(self.text("region", "Text of the GSD file"), before, number)
                self.assertIn("Not used", self.js("return find('textbox', words[0]).closest('.field').innerText", name))

    def test_puts_the_description_into_the_file(self):  # C-042
        self.type_into("textbox", "Description", "Oven 3, zone 2")
        self.assertIn("Oven 3, zone 2", self.text("region", "Text of the GSD file"))

    def test_another_device_drops_what_was_of_the_one_before(self):
        self.type_into("textbox", "Ident_Number", "1652")
        self.type_into("textbox", "Description", "Oven 3")
        self.choose("Device", "605")
        self.assertIn("Ident_Number. Undo brings it back", self.said())
        self.assertEqual((self.value("textbox", "Ident_Number"), self.value("textbox", "Description")), ("", "Oven 3"))
        self.assertRegex(self.text("region", "Text of the GSD file"), r"Ident_Number +\= 0x1649")
        self.click("button", "Undo")
        self.assertEqual(self.value("textbox", "Ident_Number"), "0x1652")

    def test_a_dot_in_a_name_is_no_ending(self):
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.click("button", "Save as")
        self.dialog_name("PUMP 1.5")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[0], "PUMP 1.5.GSD")
        self.assertEqual(self.value("textbox", "File name"), "PUMP 1.5")
        self.click("button", "Save as")
        self.dialog_name("PUMP.gse")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[0], "PUMP.gse")

    def test_save_asks_where_after_the_name_has_changed(self):
        self.type_into("textbox", "Ident_Number", "0x1652")
        self.click("button", "Save as")
        self.dialog_name("COLD1652")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[0], "COLD1652.GSD")
        self.wait_said("COLD1652.GSD")
        self.type_into("textbox", "File name", "HOT_1652")
        self.keys("Control+s")
        self.assertTrue(self.shown("dialog"))
        self.js("document.querySelector('dialog[open] input[type=text]').focus()")
        self.assertEqual(self.saved(lambda: self.keys("Enter"))[0], "HOT_1652.GSD")

    def test_a_file_that_was_opened_is_saved_until_it_is_changed(self):
        head = "return document.querySelector('[data-file]').innerText"
        self.drop([("mine.toml", b'profile = "605"\nlist = ["in:1"]\n')])
        self.wait_said("was opened")
        self.assertNotIn("not saved", self.js(head))
        self.type_into("textbox", "Description", "other")
        self.assertIn("not saved", self.js(head))

    def test_the_library_asks_before_it_replaces_or_deletes(self):  # C-045
        self.go("Start")
        self.click("button", "Store the mapping in the library")
        self.go("Mapping")
        self.type_into("textbox", "Description", "other")
        self.go("Start")
        self.click("button", "Store the mapping in the library")
        self.keys("Escape")
        self.browser.wait_for("return !document.querySelector('dialog[open]')", what="the question to go")
        self.click("button", "Store the mapping in the library")
        self.click("button", "Keep both")
        self.browser.wait_for("return document.querySelectorAll('[data-library] li').length === 2", what="both")
        self.click("button", "Delete EURO2400 (2)")
        self.assertTrue(self.shown("dialog"))
        self.keys("Enter")
        self.browser.wait_for("return document.querySelectorAll('[data-library] li').length === 1", what="one")

    def test_keeps_several_files_for_one_instrument(self):  # C-045
        for name, tag in ("COLD", 2), ("HOT", 5):
            self.type_into("textbox", "File name", name)
            self.type_into("textbox", "Add tag by number", str(tag))
            self.keys("Enter")
            self.go("Start")
            self.click("button", "Store the mapping in the library")
            self.go("Mapping")
        self.open()  # as on another day
        self.go("Start")
        self.click("button", "COLD", "Library")
        self.assertEqual(self.value("textbox", "File name"), "COLD")
        cold = self.tags("Inputs")
        self.go("Start")
        self.focus("button", "HOT", "Library")
        self.keys("Enter")
        self.assertEqual(self.value("textbox", "File name"), "HOT")
        self.assertEqual(len(self.tags("Inputs")), len(cold) + 1)

    def test_takes_library_and_draft_to_another_pc(self):  # C-045
        self.type_into("textbox", "File name", "TRAVEL")
        self.go("Start")
        self.click("button", "Store the mapping in the library")
        name, octets = self.saved(lambda: self.click("button", "Export library and draft"))
        self.browser.run("localStorage.clear()")
        self.open()
        self.assertEqual(json.loads(octets)["library"][0]["name"], "TRAVEL")
        self.drop([(name, octets)])
        self.wait_said("in the library")
        self.go("Start")
        self.assertTrue(self.shown("button", "TRAVEL", "Library"))
        self.browser.run("localStorage.clear()")
        self.open()
        self.go("Start")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, name)
            path.write_bytes(octets)
            self.choose_file(lambda: self.click("button", "Import…"), path)
            self.wait_said("in the library")
        self.go("Start")
        self.assertTrue(self.shown("button", "TRAVEL", "Library"))

    def test_restores_the_draft(self):  # C-045
        self.type_into("textbox", "File name", "DRAFT")
        self.open()
        self.assertEqual(self.value("textbox", "File name"), "DRAFT")
        self.assertIn("restored", self.said())

    def test_opens_the_sample_of_gain_scheduling(self):  # C-046
        self.go("Start")
        self.click("button", "gain-scheduling", "Samples")
        self.assertEqual((self.tags("Inputs"), self.tags("Outputs")), ([1], [6, 8, 9, 18, 17]))
        self.go("Start")
        self.tab_to("button", "gain-scheduling")
        self.keys("Enter")
        self.assertEqual(self.tags("Outputs"), [6, 8, 9, 18, 17])
