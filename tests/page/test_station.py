# SPDX-License-Identifier: Apache-2.0
"""The [[station]] block for dpslaved.toml: dpslaved takes each one that the page writes, and the page refuses what dpslaved refuses."""
import json
import pathlib
import subprocess
import tempfile

import setting
from screen import PageTest

FORMATS = {"ei-ascii": "7E1", "modbus-rtu": "8N1"}


def judged(block, protocol):
    """(exit status, output) of `dpslaved --check` on a whole configuration with this block."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "dpslaved.toml")
        file.write_text(f'[bus]\nport = "/dev/ttyS0"\nbaud = 187500\ndirection = "none"\n[control]\noperator_group = "root"\n'
                        f'[[line]]\nname = "p3"\nport = "/dev/ttyS1"\nprotocol = "{protocol}"\nformat = "{FORMATS[protocol]}"\n'
                        + block, encoding="utf-8")
        done = subprocess.run([pathlib.Path(setting.dpctl).with_name("dpslaved"), "--check", "--config", file,
                               "--profiles", setting.root / "config/profiles"], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


class Station(PageTest):
    def new_file(self, profile, ident):
        self.click("button", "Start")
        self.choose("Device", profile)
        self.click("button", "New file", "New file")
        if ident:
            self.type_into("textbox", "Ident_Number", ident)

    def fill(self, name, address, unit, line="p3"):
        self.keys("Control+Shift+s")
        self.choose("Kind of file", "station")
        for field, text in ("Station name", name), ("PROFIBUS address", address), ("Drive line", line), ("Unit on that line", unit):
            self.type_into("textbox", field, text)

    def test_is_taken_by_dpslaved_for_each_device(self):
        profiles = self.browser.call([{"do": "profiles"}])[0]["profiles"]
        self.assertEqual(len(profiles), 9)
        for profile in profiles:
            name = profile["name"]
            with self.subTest(profile=name):
                self.open()
                protocol = profile["protocols"][0]
                self.new_file(name, None if profile["ident"] else "0x1652")
                self.fill("öfen_1-a.b", str(profile["max_address"]), "0A" if protocol == "ei-ascii" else "247")
                saved, block = self.saved(lambda: self.keys("Enter"))
                self.assertTrue(saved.endswith(".toml"))
                status, output = judged(block.decode(), protocol)
                self.assertEqual(status, 0, f"{block.decode()}\n{output}")

    def test_that_dpslaved_refuses_the_page_refuses_too(self):
        good = {"name": "oven", "address": "5", "unit": "1"}
        wrong = [{"name": one} for one in ("Ofen 1", "12", "0x1F", "-a", "1.5", "a" * 33, "a×b", "µ")]
        wrong += [{"address": one} for one in ("126", "200")] + [{"unit": one} for one in ("0", "248", "1A", "-1")]
        self.new_file("2408f", "0x1652")
        for change in wrong:
            with self.subTest(**change):
                place = good | change
                block = (f'[[station]]\nname = {json.dumps(place["name"])}\naddress = {place["address"]}\nprofile = "2408f"\nline = "p3"\n'
                         f'unit = {json.dumps(place["unit"])}\nident = 0x1652\n')
                self.assertNotEqual(judged(block, "modbus-rtu")[0], 0, "the daemon takes it")
                self.fill(place["name"], place["address"], place["unit"])
                self.keys("Enter")
                self.assertTrue(self.shown("dialog"), "the page takes it")
                self.keys("Escape")

    def test_of_a_device_without_an_ident_asks_for_it(self):
        self.new_file("584sv", None)
        self.fill("winder", "5", "00")
        self.keys("Enter")
        self.assertIn("Write the Ident_Number of your device", self.text("dialog"))
        self.keys("=1652")
        _, block = self.saved(lambda: self.keys("Enter"))
        self.assertIn("ident = 0x1652", block.decode())
