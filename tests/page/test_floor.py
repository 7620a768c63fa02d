# SPDX-License-Identifier: Apache-2.0
"""The page's own text: its size, its policy, and only interfaces that the oldest browsers have."""
import base64
import hashlib
import re
import unittest

import floor
import setting


def part(pattern, text):
    found = re.findall(pattern, text, re.DOTALL)
    if len(found) != 1:
        raise AssertionError(f"{len(found)} places of {pattern}")
    return found[0]


class Text(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = setting.page.read_text(encoding="utf-8")
        cls.script = part(r"<script>(.*?)</script>", cls.page)
        cls.style = part(r"<style>(.*?)</style>", cls.page)
        cls.rest = cls.page.replace(cls.script, "").replace(cls.style, "")

    def test_is_at_most_800_kilobytes(self):
        self.assertLessEqual(setting.page.stat().st_size, 800_000)

    def test_names_no_other_place(self):
        self.assertEqual(re.findall(r"""\s(?:src|href|action|data)\s*=\s*(?!["']?(?:#|data:))[^\s>]+""", self.rest), [])
        self.assertEqual(re.findall(r"@import|url\((?!['\"]?data:)", self.style), [])
        self.assertNotRegex(self.script, r"\b(fetch|XMLHttpRequest|WebSocket|EventSource|sendBeacon|importScripts)\b\s*\(")

    def test_has_a_policy_that_allows_no_connection(self):
        policy = part(r'http-equiv="Content-Security-Policy" content="([^"]*)"', self.page)
        rules = {rule.split()[0]: rule.split()[1:] for rule in policy.split(";")}

        def digest(text):
            return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"
        self.assertEqual(rules.pop("default-src"), ["'none'"])
        self.assertEqual(rules.pop("script-src"), [digest(self.script), "'wasm-unsafe-eval'"])
        self.assertEqual(rules.pop("style-src"), [digest(self.style)])
        self.assertEqual(rules.pop("base-uri"), ["'none'"])
        self.assertEqual(rules.pop("form-action"), ["'none'"])
        for name, places in rules.items():
            self.assertIn(name, ["img-src", "font-src"])
            self.assertLessEqual(set(places), {"data:", "blob:"})

    def test_has_no_interface_that_the_oldest_browsers_lack(self):
        self.assertEqual(floor.found(floor.SCRIPT, self.script), [])
        self.assertEqual(floor.found(floor.STYLE, self.style), [])
        self.assertEqual(floor.nested_rules(self.style), [])
        self.assertEqual(floor.found(floor.ELEMENTS, self.rest + self.script), [])

    def test_of_the_oldest_browsers_finds_each_of_its_samples(self):
        for rows in floor.SCRIPT, floor.STYLE, floor.ELEMENTS:
            for row in rows:
                with self.subTest(row[1]):
                    self.assertTrue(floor.found([row], row[1]))
        self.assertEqual(floor.nested_rules("a { color: red; .b { color: blue } }"), [".b {"])
        self.assertEqual(floor.nested_rules("@media print { a { &:hover { color: red } } }"), ["&:hover {"])

    def test_of_the_oldest_browsers_leaves_what_they_have(self):
        self.assertEqual(floor.found(floor.SCRIPT, """
            list.sort().map(of); text.at(-1); list.findLast(of); navigator.clipboard.writeText(text); a.b(/x/g, 1);
            for (const one of map.values()) use(one); structuredClone(one); dialog.showModal(); y = x / v; z = a/v;
            new DecompressionStream('deflate-raw'); blob.arrayBuffer(); Object.hasOwn(one, 'x'); crypto.randomUUID();"""), [])
        style = """
            :root { color-scheme: light dark; --one: rgb(1 2 3 / 50%); }
            @media (width >= 30rem) { .one > a:hover, #two:focus-visible { color: var(--one); width: min(1rem, 2vw); } }
            @media print { .one { -webkit-print-color-adjust: exact; line-height: 1.5; } a::after { content: "{"; } }
            @container (min-width: 3rem) { .one:is(a, b) { inset: 0; accent-color: red; animation: x 1s linear; } }"""
        self.assertEqual(floor.found(floor.STYLE, style), [])
        self.assertEqual(floor.nested_rules(style), [])


class Build(unittest.TestCase):
    def test_gives_the_same_octets_from_another_folder(self):
        if not setting.other_page:
            self.skipTest("without --other-page there is no second build")
        self.assertEqual(hashlib.sha256(setting.page.read_bytes()).hexdigest(),
                         hashlib.sha256(setting.other_page.read_bytes()).hexdigest())
