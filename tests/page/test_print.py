# SPDX-License-Identifier: Apache-2.0
"""Rows C-035 and C-044: the I/O map, the clipboard, and what is printed."""
import base64
import hashlib
import subprocess
import tempfile

import screen


class Paper(screen.PageTest):
    def printed(self, trigger, *parts):
        """The text of what is printed when only these of the parts are chosen."""
        self.js("globalThis.printed = false; globalThis.print = () => { globalThis.printed = true; }")
        trigger()
        for part in ("Inputs", "Outputs", "I/O map"):
            if (part in parts) != self.js("return find('checkbox', words[0]).checked", part):
                self.click("checkbox", part)
        self.js("document.querySelector('dialog[open] button[type=submit]').focus()")
        self.keys("Enter")
        self.browser.wait_for("return globalThis.printed", what="the browser to be asked to print")
        if self.browser.name != "chromium":
            return self.js("return document.getElementById('paper').textContent")
        return self.paper()

    def paper(self):
        """The text of what Chromium prints, as its own menu does it."""
        pdf = base64.b64decode(self.browser.cdp("Page.printToPDF")["data"])
        with tempfile.NamedTemporaryFile(suffix=".pdf") as file:
            file.write(pdf)
            file.flush()
            return subprocess.run(["pdftotext", "-layout", file.name, "-"], capture_output=True, check=True, text=True).stdout

    def test_prints_inputs_outputs_and_map_each_alone_or_together(self):
        inputs, outputs = "Inputs of the master", "Outputs of the master"
        trigger = lambda: self.click("button", "Print")
        alone = self.printed(trigger, "Inputs")
        self.assertIn(inputs, alone)
        self.assertNotIn(outputs, alone)
        self.assertNotIn("I/O map", alone)
        alone = self.printed(lambda: self.keys("Control+p"), "Outputs")
        self.assertNotIn(inputs, alone)
        self.assertIn(outputs, alone)
        alone = self.printed(trigger, "I/O map")
        self.assertIn("I/O map", alone)
        self.assertNotIn(inputs, alone)
        together = self.printed(trigger, "Inputs", "Outputs", "I/O map")
        for part in inputs, outputs, "I/O map", "Process variable":
            self.assertIn(part, together)
        self.assertNotIn("Search parameters", together)

    def test_prints_the_hash_of_the_file(self):
        self.type_into("textbox", "Ident_Number", "0x1652")
        text = self.printed(lambda: self.keys("Control+p"), "Inputs")
        file = screen.dpctl("gsd", "make", "--profile", "2408f", "--ident", "0x1652")
        self.assertIn(hashlib.sha256(file).hexdigest(), "".join(text.split()))

    def test_the_menu_of_the_browser_prints_all_parts_as_they_are_now(self):
        if self.browser.name != "chromium":
            self.js("dispatchEvent(new Event('beforeprint'))")
            self.assertIn("Outputs of the master", self.js("return document.getElementById('paper').textContent"))
            self.js("dispatchEvent(new Event('afterprint'))")
            self.assertFalse(self.js("return document.getElementById('paper') !== null"))
            return
        self.printed(lambda: self.keys("Control+p"), "Inputs")
        self.type_into("textbox", "Description", "Oven 7")
        text = self.paper()
        for part in "Oven 7", "Inputs of the master", "Outputs of the master", "I/O map":
            self.assertIn(part, text)

    def test_shows_the_map_and_copies_it(self):
        self.click("tab", "I/O map")
        rows = self.js("return [...document.querySelectorAll('.maps tbody tr')].map((row) => row.innerText)")
        inputs = self.tags("Inputs")
        self.assertEqual(len(rows), len(inputs) + len(self.tags("Outputs")))
        self.assertIn("0–1", rows[0])
        self.assertIn(str(inputs[0]), rows[0])
        text = self.copied(lambda: self.click("button", "Copy what is shown"))
        self.assertEqual([line.split("\t")[1] for line in text.splitlines() if line[:1].isdigit()],
                         [str(tag) for tag in inputs + self.tags("Outputs")])
        self.focus("button", "Copy what is shown")
        self.assertEqual(self.copied(lambda: self.keys("Enter")), text)

    def test_copies_where_the_browser_lets_no_page_write_the_clipboard(self):
        self.js("""Object.defineProperty(navigator.clipboard, 'writeText', { configurable: true,
                value: async () => { throw new DOMException('made for the test', 'NotAllowedError'); } });
            globalThis.copy = '';
            document.addEventListener('copy', (event) => { globalThis.copy = document.activeElement.value ?? ''; })""")
        self.click("tab", "I/O map")
        self.click("button", "Copy what is shown")
        self.wait_said("was copied")
        self.assertIn("Process variable", self.js("return globalThis.copy"))

    def test_follows_each_change_of_the_lists(self):
        self.click("tab", "I/O map")
        before = self.js("return document.querySelectorAll('.maps tbody tr').length")
        self.press(self.row_place("Inputs", self.tags("Inputs")[0]))
        self.keys("Delete")
        self.assertEqual(self.js("return document.querySelectorAll('.maps tbody tr').length"), before - 1)
