#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs test programs of GoogleTest and says what failed. Each test runs once: there is no second try.

usage: run_tests.py [--jobs N] [--limit SECONDS] [--times N] [--report FILE] PROGRAM[=FILTER]...

A program runs in a process of its own; --jobs of them at a time. A test that takes longer than --limit is ended and has failed.
Behind all of them stand, for each failed test, its last 40 lines and the command that repeats it; then a line of counts. Exit status: 0
all passed, 1 not all, 2 usage."""

import argparse
import collections
import concurrent.futures
import os
import re
import signal
import subprocess
import sys
import threading
import time

LINES = 40  # of a failed test
Failure = collections.namedtuple("Failure", "program test why lines")
running = set()  # process groups


def end_all(*_):
    for group in list(running):
        os.killpg(group, signal.SIGKILL)
    os._exit(143)


class Run:
    """One program, with what it said of its tests."""

    def __init__(self, program, test_filter, limit):
        self.program, self.test_filter, self.limit = program, test_filter, limit
        self.passed = self.skipped = 0
        self.failures = []
        self.test = None  # the one that runs
        self.lines = collections.deque(maxlen=LINES)
        self.began = time.monotonic()
        self.ended_by_limit = False

    def fail(self, why):
        self.failures.append(Failure(self.program, self.test, why, list(self.lines)))
        self.test = None

    def read(self, line):
        mark = re.match(r"\[ *(RUN|OK|FAILED|SKIPPED) *\] ([^\s,]+)", line)
        if mark and mark[1] == "RUN":
            self.test, self.began = mark[2], time.monotonic()
            self.lines.clear()
        elif mark and mark[2] == self.test:  # the list at the end of a run names them again
            if mark[1] == "FAILED":
                self.fail("failed")
            else:
                self.passed += mark[1] == "OK"
                self.skipped += mark[1] == "SKIPPED"
                self.test = None
        else:
            self.lines.append(line.rstrip("\n")[:400])

    def watch(self, process, done):
        while not done.wait(1.0):
            if time.monotonic() - self.began > self.limit:
                self.ended_by_limit = True
                os.killpg(process.pid, signal.SIGKILL)
                return

    def go(self):
        began = time.monotonic()
        command = [self.program] + (["--gtest_filter=" + self.test_filter] if self.test_filter else [])
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   text=True, errors="replace", start_new_session=True)
        running.add(process.pid)
        done = threading.Event()
        watcher = threading.Thread(target=self.watch, args=(process, done))
        watcher.start()
        for line in process.stdout:
            self.read(line)
        status = process.wait()
        running.discard(process.pid)
        done.set()
        watcher.join()
        if self.ended_by_limit:
            self.fail("was ended after %d s" % self.limit)
        elif self.test or (status != 0 and not self.failures):
            self.fail("ended the program with status %d" % status)
        elif status == 0 and self.passed + self.skipped == 0:
            self.fail("no such test")
        print("  %-28s %5d passed %6.1f s%s" % (os.path.basename(self.program), self.passed, time.monotonic() - began,
              "   FAILED: %d" % len(self.failures) if self.failures else ""), flush=True)
        return self


def main():
    options = argparse.ArgumentParser(usage=__doc__, add_help=False)
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--limit", type=float, default=300)
    options.add_argument("--times", type=int, default=1)
    options.add_argument("--report")
    options.add_argument("programs", nargs="+")
    given = options.parse_args()
    signal.signal(signal.SIGTERM, end_all)

    runs = []
    for _ in range(given.times):
        for word in given.programs:
            program, _, test_filter = word.partition("=")
            runs.append(Run(program, test_filter, given.limit))
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(Run.go, runs))

    report = open(given.report, "a", encoding="utf-8") if given.report else sys.stdout
    failures = [failure for run in runs for failure in run.failures]
    for failure in failures:
        name = failure.test or "outside of its tests"
        print("\n--- %s %s %s; its last lines:" % (os.path.basename(failure.program), name, failure.why), file=report)
        print("\n".join("    " + line for line in failure.lines), file=report)
        print("    repeat it with: %s%s" % (failure.program, " --gtest_filter=" + failure.test if failure.test else ""), file=report)
    print("%d passed, %d failed, %d skipped" % (sum(run.passed for run in runs), len(failures), sum(run.skipped for run in runs)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
