# SPDX-License-Identifier: Apache-2.0
"""That tools/run bench --page works. It judges no time: other programs run beside the tests."""
import pathlib
import tempfile

import bench
import screen
import setting


class Bench(screen.PageTest):
    def test_the_bench_measures_each_page_from_its_opening_and_each_key(self):
        if self.browser.name != "chromium":
            self.skipTest("the bench is for Chromium")
        folder = self.enterContext(tempfile.TemporaryDirectory())
        measured = bench.Bench(self.browser, pathlib.Path(setting.page), folder)
        self.addCleanup(self.open)
        self.addCleanup(measured.close)
        found = bench.summary(bench.measure(measured, blocks=1, opens=1, seed=1))
        self.assertEqual(list(found), list(bench.MEASURES))
        for name, one in found.items():
            for figure, value in one.items():
                self.assertGreater(value, 0, f"{figure} of {name}")
        self.assertGreater(found["shown"]["page_ms"], found["ready"]["page_ms"])
        self.assertEqual(measured.rows, 1050)  # 1056 rows, 1050 distinct tags
