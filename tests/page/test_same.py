# SPDX-License-Identifier: Apache-2.0
"""1000 random mapping files: the page and dpctl answer with the same octets, the same exit and the same sentences."""
import base64
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import tempfile
import unittest

import mappings
import setting

MAPPINGS = 1000
BATCH = 50
FILE_NAMES = ["", "", "MINE0533.GSD", "a name.txt", "lower.gsd", "ü.GSE"]


class Page(unittest.TestCase):
    maxDiff = 4000

    def test_and_dpctl_make_the_same_of_random_mappings(self):
        browser = setting.browser
        browser.open_page(setting.page)
        cases = random_cases(browser)
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            by_dpctl = pool.map(lambda case: of_dpctl(pathlib.Path(folder), *case), cases)
            by_page = [reply for at in range(0, MAPPINGS, BATCH) for reply in of_page(browser, cases[at:at + BATCH])]
            made = 0
            for case, expected, got in zip(cases, by_dpctl, by_page):
                self.assertEqual(got, expected, f"seed {setting.seed}, mapping {case[0]}, file {case[2]!r}:\n{case[1]}")
                made += expected["exit"] == 0
        print(f"{MAPPINGS} mappings, {made} of them made", end=" ", flush=True)
        self.assertGreaterEqual(made, MAPPINGS // 2)
        self.assertGreaterEqual(MAPPINGS - made, MAPPINGS // 4)

    def test_makes_the_same_file_of_what_it_imports(self):
        browser = setting.browser
        browser.open_page(setting.page)
        cases = random_cases(browser)
        identical = 0
        for at in range(0, MAPPINGS, BATCH):
            some = cases[at:at + BATCH]
            tables = tables_of(browser, some)
            made = [(case, reply) for case, reply in zip(some, of_page(browser, some)) if reply["exit"] == 0]
            imported = browser.call([{"do": "import", "file": reply["octets"], "profile": profile_of(case[1]), **tables[case[0]]}
                                     for case, reply in made])
            again = browser.call([{"do": "make", **mapping_of(reply)} for reply in imported])
            for (case, first), between, second in zip(made, imported, again):
                said = f"seed {setting.seed}, mapping {case[0]}:\n{case[1]}\n{between}"
                self.assertEqual(between["lost"], [], said)
                self.assertEqual(second.get("octets"), first["octets"], said)
                identical += 1
        print(f"{identical} files", end=" ", flush=True)
        self.assertGreaterEqual(identical, 500)


def random_cases(browser):
    """(name, text of a mapping file, name of the GSD file), the same for one seed."""
    profiles = browser.call([{"do": "profiles"}])[0]["profiles"]
    tags = [reply.get("tags", []) for reply in browser.call([{"do": "tags", "profile": one["name"]} for one in profiles])]
    source = random.Random(setting.seed)
    return [(f"{number}.toml",
             mappings.mapping_file(source, profiles[number % len(profiles)], tags[number % len(profiles)]),
             source.choice(FILE_NAMES))
            for number in range(MAPPINGS)]


def profile_of(text):
    return re.search(r'^profile = "(.*)"$', text, re.MULTILINE)[1]


def mapping_of(reply):
    """The mapping that a reply has, with its table."""
    return {key: reply[key] for key in ("mapping", "table", "table_name") if key in reply}


def read_by_page(browser, cases):
    return browser.call([{"do": "read_mapping", "file": base64.b64encode(text.encode()).decode(), "name": name}
                         for name, text, _ in cases])


def tables_of(browser, cases):
    """By the name of the mapping file: the keys of its table."""
    return {case[0]: {key: one for key, one in mapping_of(reply).items() if key != "mapping"}
            for case, reply in zip(cases, read_by_page(browser, cases))}


def of_page(browser, cases):
    """As the page does when it opens a mapping file and saves the GSD file."""
    read = read_by_page(browser, cases)
    wanted = [(at, {"do": "make", **mapping_of(reply), "name": case[2]})
              for at, (case, reply) in enumerate(zip(cases, read)) if reply["exit"] == 0]
    for (at, _), reply in zip(wanted, browser.call([request for _, request in wanted])):
        read[at] = reply
    return read


def of_dpctl(folder, name, text, file_name):
    """Of the same files under the same names. A file that it writes has the octets that it prints."""
    own = folder / name.removesuffix(".toml")
    own.mkdir()
    (own / name).write_text(text, encoding="utf-8")
    (own / "profiles").symlink_to(setting.root / "config/profiles")
    (own / "tags").symlink_to(setting.root / "config/tags")
    words = [setting.dpctl, "gsd", "make", "--json", "--profiles", "profiles", "--mapping", name]
    done = subprocess.run(words + (["--output", file_name] if file_name else []), cwd=own, capture_output=True, timeout=60, check=False)
    reply = json.loads(done.stdout)
    if done.stderr or done.returncode != reply["exit"]:
        raise AssertionError(f"{name}: exit {done.returncode}, {done.stderr!r}")
    if file_name and reply["exit"] == 0 and (own / file_name).read_bytes() != base64.b64decode(reply["octets"]):
        raise AssertionError(f"{name}: the file has other octets than the reply")
    return reply
