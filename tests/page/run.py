#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the configurator's page in a browser (tools/run page builds what it needs)."""
import argparse
import pathlib
import signal
import sys
import unittest

import browser
import setting


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--browser", choices=sorted(browser.KINDS), default="chromium")
    parser.add_argument("--page", type=pathlib.Path, required=True)
    parser.add_argument("--other-page", type=pathlib.Path, help="the page from another build folder")
    parser.add_argument("--dpctl", type=pathlib.Path, required=True)
    parser.add_argument("--axe", type=pathlib.Path, help="axe.min.js of axe-core")
    parser.add_argument("--seed", type=int, default=14)
    parser.add_argument("--pictures", type=pathlib.Path, help="folder that gets the guide's pictures")
    parser.add_argument("--only", action="append", help="a part of the names of the tests to run")
    words = parser.parse_args()
    setting.page, setting.dpctl, setting.seed = words.page.resolve(), words.dpctl.resolve(), words.seed
    setting.other_page = words.other_page and words.other_page.resolve()
    setting.pictures, setting.axe = words.pictures, words.axe

    loader = unittest.TestLoader()
    if words.only:
        loader.testNamePatterns = [f"*{part}*" for part in words.only]
    tests = loader.discover(str(pathlib.Path(__file__).parent), "test_*.py")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the browser ends too
    setting.browser = browser.KINDS[words.browser]()
    print(f"{words.browser} {setting.browser.version}, seed {words.seed}", flush=True)
    try:
        outcome = unittest.TextTestRunner(stream=sys.stdout, verbosity=2, failfast=False).run(tests)
    finally:
        setting.browser.close()
    failed = len(outcome.failures) + len(outcome.errors) + len(outcome.unexpectedSuccesses)
    skipped = len(outcome.skipped)
    print(f"{outcome.testsRun - failed - skipped} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not outcome.testsRun else 0


if __name__ == "__main__":
    sys.exit(main())
