#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the configurator's page against an empty page in the same Chromium (tools/run bench --page builds what it needs).

Two empty pages are measured, so that A/A (empty/empty) shows the error of the measurement. Exit status 1: A/A is too far from 1.
"""
import argparse
import json
import os
import pathlib
import platform
import random
import signal
import statistics
import sys
import tempfile

import browser

WORD = "setpoint"  # what is typed into the search, key by key
KINDS = ("page", "empty", "second empty")
ERROR = 0.05  # of A/A: what may be left of the machine's other work
MEASURES = {
    "ready": "ready, in the document",
    "shown": "ready and painted",
    "first": "first key of the search, painted",
    "further": "each further key, painted",
}
EMPTY = """<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Empty</title><link rel="icon" href="data:,"></head>
<body><input type="search"><script>document.documentElement.dataset.ready = 'yes';</script></body></html>
"""
# Runs in each page before its own scripts. Navigation began at 0. The second frame after a change begins when the first one,
# which shows it, is painted.
WATCH = """(() => {
    const painted = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now()))));
    let pressed = 0, typed = null;
    const bench = globalThis.bench = { next() { bench.key = new Promise((done) => { typed = done; }); } };
    bench.opened = new Promise((done) => {
        const watch = new MutationObserver(async () => {
            if (document.documentElement.dataset.ready !== 'yes') return;
            watch.disconnect();
            const ready = performance.now();
            done({ ready, shown: await painted() });
        });
        watch.observe(document, { attributes: true, subtree: true, attributeFilter: ['data-ready'] });
    });
    addEventListener('keydown', (event) => { pressed = event.timeStamp; }, { capture: true });
    addEventListener('input', async () => { const from = pressed; typed(await painted() - from); });
})()"""


class Bench:
    def __init__(self, chromium, page, folder):
        self.browser = chromium
        empty = pathlib.Path(folder, "empty.html")
        empty.write_text(EMPTY, encoding="utf-8")
        self.addresses = {kind: (page if kind == "page" else empty).resolve().as_uri() for kind in KINDS}
        self.watch = chromium.cdp("Page.addScriptToEvaluateOnNewDocument", source=WATCH)["identifier"]
        self.rows = 0

    def close(self):
        self.browser.cdp("Page.removeScriptToEvaluateOnNewDocument", identifier=self.watch)

    def open(self, kind):
        """Opens a page and types the word: the times of both, in ms."""
        self.browser.open(self.addresses[kind])
        times = self.browser.run("return bench.opened")
        self.browser.run("document.querySelector('input[type=search]').focus()")
        keys = [self.press(letter) for letter in WORD]
        if kind == "page":
            self.look_at_the_search()
        return {**times, "first": keys[0], "further": statistics.median(keys[1:])}

    def press(self, letter):
        self.browser.run("bench.next()")
        self.browser.act({"type": "key", "id": "keyboard",
                          "actions": [{"type": kind, "value": letter} for kind in ("keyDown", "keyUp")]})
        return self.browser.run("return bench.key")

    def look_at_the_search(self):
        """The word was searched for in all rows of the table, and something was found."""
        said = self.browser.run("return document.querySelector('.tree .count').textContent")
        self.rows = len(self.browser.call([{"do": "tags", "profile": "2408f"}])[0]["tags"])
        if not said.endswith(f" of {self.rows} parameters") or said.startswith("0 "):
            raise RuntimeError(f"the search for {WORD!r} says: {said}")
        self.browser.run("localStorage.clear()")  # the next opening finds no draft

    def block(self, opens, order):
        """The medians of one block: each page is opened `opens` times, in turn, and each time in random order."""
        times = {kind: [] for kind in KINDS}
        for _ in range(opens):
            for kind in order.sample(KINDS, len(KINDS)):
                times[kind].append(self.open(kind))
        return {kind: {name: statistics.median(one[name] for one in times[kind]) for name in MEASURES} for kind in KINDS}


def measure(bench, blocks, opens, seed):
    """The blocks. One before them is not counted: it warms up."""
    order = random.Random(seed)
    bench.block(1, order)
    return [bench.block(opens, order) for _ in range(blocks)]


def summary(blocks):
    """Of each measure: the medians of the blocks in ms, and those of the blocks' ratios."""
    found = {}
    for name in MEASURES:
        of = {kind: [block[kind][name] for block in blocks] for kind in KINDS}
        found[name] = {
            "page_ms": statistics.median(of["page"]), "empty_ms": statistics.median(of["empty"]),
            "ratio": ratio(of["page"], of["empty"]), "a_a": ratio(of["second empty"], of["empty"]),
        }
    return found


def ratio(times, base):
    """The median of the blocks' ratios."""
    return statistics.median(one / other for one, other in zip(times, base))


def machine():
    """Where it is measured, and how busy that was before."""
    lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())
    return {"processor": model, "processors": os.cpu_count(), "kernel": platform.release(), "load_before": os.getloadavg()[0]}


def show(found):
    print(f"{'ms, medians of the blocks':34} {'page':>8} {'empty':>8} {'ratio':>8} {'A/A':>8}")
    for name, words in MEASURES.items():
        one = found[name]
        print(f"{words:34} {one['page_ms']:8.1f} {one['empty_ms']:8.1f} {one['ratio']:8.2f} {one['a_a']:8.2f}")


def words_of_the_caller():
    parser = argparse.ArgumentParser(prog="tools/run bench --page", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--page", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--blocks", type=int, default=15)
    parser.add_argument("--opens", type=int, default=5, help="openings of each page in a block")
    parser.add_argument("--seed", type=int, default=14, help="of the order of the pages")
    parser.add_argument("--paced", action="store_true", help="with the 60 frames per second of a screen")
    parser.add_argument("--quick", action="store_true", help="a look that judges nothing: three blocks of one opening each")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="also writes the figures there")
    words = parser.parse_args()
    if words.quick:
        words.blocks, words.opens = 3, 1
    return words


def main():
    words, where = words_of_the_caller(), machine()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the browser ends too
    chromium = browser.Chromium(logs=False, arguments=[] if words.paced else ["--disable-frame-rate-limit", "--disable-gpu-vsync"])
    with tempfile.TemporaryDirectory(prefix="bench-page-") as folder:
        try:
            bench = Bench(chromium, words.page, folder)
            blocks = measure(bench, words.blocks, words.opens, words.seed)
        finally:
            chromium.close()
    found = summary(blocks)
    told = {"machine": where, "browser": f"Chromium {chromium.version}", "frames": "60/s" if words.paced else "without a limit",
            "word": WORD, "rows": bench.rows, "blocks": words.blocks, "opens": words.opens, "seed": words.seed, "measures": found}
    print(f"{told['browser']}, {where['processor']}, {where['processors']} processors, "
          f"{bench.rows} rows, {words.blocks} blocks of {words.opens}, frames {told['frames']}")
    show(found)
    if words.json:
        words.json.write_text(json.dumps({**told, "each_block": blocks}, indent=1) + "\n", encoding="utf-8")
    off = [] if words.quick else [name for name, one in found.items() if abs(one["a_a"] - 1) > ERROR]
    if off:
        print(f"A/A of {', '.join(off)} is more than {ERROR} from 1: measure again on a machine without other load.")
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
