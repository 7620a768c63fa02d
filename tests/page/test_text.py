# SPDX-License-Identifier: Apache-2.0
"""The text of the GSD file shows which parts belong to which parameter, in colour and without."""
import re

import screen

TEXT = "Text of the GSD file"


class GsdText(screen.PageTest):
    def mapping(self, profile, *entries, demand=False):
        listed = ", ".join(f'"{one}"' for one in entries)
        text = f'profile = "{profile}"\nident = 0x1652\ndemand = {str(demand).lower()}\nlist = [{listed}]\n'.encode()
        self.drop([(f"{profile}.toml", text)])
        self.wait_said(f"{profile}.toml was opened")
        return screen.dpctl("gsd", "make", "--mapping", "FILE", text=text).decode("latin-1")

    def parts(self):
        """What is marked: {number: [text, ...]} in the order of the file."""
        found = {}
        for number, text in self.js("return [...document.querySelectorAll('[data-parameter]')]"
                                    ".map((one) => [one.dataset.parameter, one.textContent])"):
            found.setdefault(number, []).append(text)
        return found

    def shown_text(self):
        return self.js("return find('region', words[0]).textContent", TEXT)

    def test_octets_and_comments_belong_to_their_parameter(self):
        made = self.mapping("2408f", "in:1", "out:6", "in:2", demand=True)
        self.assertEqual(self.parts(), {
            "1": ["1 in tag 1 Process variable", "0x00,0x01", "0x50"],
            "2": ["2 out tag 6 Proportional band PID1", "0x00,0x06", "0x60"],
            "3": ["3 in tag 2 Target setpoint", "0x00,0x02", "0x50"],
            "D": ["0x73"],
        })
        self.assertEqual(self.shown_text(), made.replace("\r\n", "\n"))

    def test_lines_that_go_on_and_several_modules(self):
        tags = [*range(1, 30), 301]
        made = self.mapping("690plus", *[f"in:{tag}" for tag in tags])
        self.assertGreater(made.count("Module = "), 1)
        octets = {number: re.findall("0x([0-9A-F]{2})", "".join(text[1:])) for number, text in self.parts().items()}
        self.assertEqual(octets, {str(at + 1): [f"{tag >> 8:02X}", f"{tag & 255:02X}", "50"] for at, tag in enumerate(tags)})
        self.assertEqual(self.shown_text(), made.replace("\r\n", "\n"))

    def test_neighbours_differ_in_colour_and_in_the_kind_of_line(self):
        self.mapping("2408f", "in:1", "out:6")
        looks = self.js("""return [...document.querySelectorAll('[data-parameter]')].slice(0, 2).map((one) => {
            const { borderBottomColor, borderBottomStyle, borderTopStyle, display } = getComputedStyle(one);
            return [borderBottomColor, borderBottomStyle, borderTopStyle, display, one.title];
        })""")
        self.assertNotEqual(looks[0][0], looks[1][0])
        self.assertEqual([look[1:] for look in looks], [["solid", "none", "inline", "Parameter 1: 1 Process variable"],
                                                        ["dotted", "none", "inline", "Parameter 2: 6 Proportional band PID1"]])

    def test_the_text_is_copied_as_it_is(self):
        made = self.mapping("2408f", "in:1", "out:6")
        self.assertEqual(self.copied(lambda: self.click("button", "Copy what is shown")).replace("\r\n", "\n"),
                         made.replace("\r\n", "\n"))

    def test_every_profile_has_its_parameters_marked(self):
        for profile in self.browser.call([{"do": "profiles"}])[0]["profiles"]:
            with self.subTest(profile["name"]):
                if profile["no_tags"] or not {"in", "out"} <= set(profile["lists"]):
                    continue
                self.mapping(profile["name"], "in:1", "out:6")
                self.assertEqual([len(texts) for texts in self.parts().values()], [3, 3])
