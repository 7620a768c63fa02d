# SPDX-License-Identifier: Apache-2.0
"""Builds the copy with all mutants, runs the tests that come to each, and judges what is left alive (tools/run mutants)."""
import argparse
import collections
import concurrent.futures
import csv
import hashlib
import os
import pickle
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import places
import schema

PROJECT = os.getcwd()
WORK = f"{PROJECT}/build/mutants"
COPY = f"{WORK}/copy"
BUILD = f"{WORK}/build"
EXPLAINED = f"{PROJECT}/tests/mutants/explained.csv"

# What is changed, and the test programs that judge it.
FDL = ["test_fdl", "test_dp", "test_model"]
DP = ["test_dp", "test_model"]
DRIVE = ["test_drive", "test_drive_line"]
MODBUS = ["test_modbus", "test_drive_line"]
SCOPE = {
    "src/fdl/telegram.cpp": FDL, "src/fdl/receiver.cpp": FDL, "src/fdl/stations.cpp": FDL, "src/fdl/layer2.cpp": FDL,
    "src/dp/state_table.hpp": DP, "src/dp/state_machine.cpp": DP, "src/dp/slave.cpp": DP, "src/dp/set_prm.cpp": DP,
    "src/dp/chk_cfg.cpp": DP, "src/dp/global_control.hpp": DP, "src/dp/process_data.cpp": DP, "src/dp/demand_data.cpp": DP,
    "src/dp/slave_diag.cpp": DP,
    "src/drive/owed_answers.cpp": DRIVE + ["test_modbus"], "src/drive/ei/ei_exchange.cpp": DRIVE, "src/drive/ei/ei_ascii.cpp": DRIVE,
    "src/drive/ei/ei_forms.cpp": DRIVE, "src/drive/parameter.hpp": DRIVE, "src/drive/parameter.cpp": DRIVE,
    "src/modbus/exchange.cpp": MODBUS, "src/modbus/frame_receiver.cpp": MODBUS, "src/modbus/pdu.cpp": MODBUS,
}
PROGRAMS = ["test_fdl", "test_dp", "test_model", "test_drive", "test_drive_line", "test_modbus"]

# Random runs are shorter than in ctest: what they find they mostly find at once.
SHORT = {"MODEL_STEPS": "200000", "DRIVE_LINE_TRANSACTIONS": "20000"}
FLAGS = ["-std=c++20", "-Iinclude", "-Isrc"]
REFUSED = 99  # mutant.hpp: a static_assert does not hold

def say(text):
    print(f"\n==> {text}", flush=True)

def digest(*texts):
    return hashlib.sha256("\0".join(texts).encode("latin-1")).hexdigest()

def read(path):
    with open(path, encoding="latin-1", newline="") as file:
        return file.read()

def write_if_new(path, text):
    if os.path.exists(path) and read(path) == text:
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="latin-1", newline="") as file:
        file.write(text)

# --- finding -----------------------------------------------------------------------------------------------------

def found_in(path):
    """(source, mutants) of one file; remembered for as long as no header that it can include changes."""
    # A header of another library lies in include/.
    headers = sorted(f"{folder}/{name}" for top in ("include", os.path.dirname(path)) for folder, _, names in os.walk(top)
                     for name in names if name.endswith(".hpp"))
    wanted = digest(read(path), read(f"{PROJECT}/tests/mutants/places.py"), *map(read, headers))
    cache = f"{WORK}/places/{path.replace('/', '_')}.pickle"
    if os.path.exists(cache):
        with open(cache, "rb") as file:
            known, found = pickle.load(file)
        if known == wanted:
            return found
    found = places.mutants_of(path, FLAGS, ".")
    os.makedirs(os.path.dirname(cache), exist_ok=True)
    with open(cache, "wb") as file:
        pickle.dump((wanted, found), file)
    return found

def name_mutants(path, source, mutants):
    """A key that stays when other lines come or go: file, line number left out, operator, hash of the line, and which of
    the equal ones."""
    seen = collections.Counter()
    lines = source.split("\n")
    for one in mutants:
        one.line = source.count("\n", 0, one.at) + 1
        line = " ".join(lines[one.line - 1].split())
        name = f"{path}:{one.operator}:{digest(line)[:6]}"
        seen[name] += 1
        one.key = f"{name}:{seen[name]}"

def find_all(jobs):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        found = dict(zip(SCOPE, pool.map(found_in, SCOPE)))
    number = 0
    for path, (source, mutants) in found.items():
        name_mutants(path, source, mutants)
        for one in mutants:
            number += 1
            one.number = number
    return found

# --- copy and build ----------------------------------------------------------------------------------------------

def write_copy(found, left_out, kept):
    """Gives file of the copy -> line -> mutants."""
    for name in os.listdir(PROJECT):
        if name not in ("src", "build", ".git") and not os.path.lexists(f"{COPY}/{name}"):
            os.makedirs(COPY, exist_ok=True)
            os.symlink(f"{PROJECT}/{name}", f"{COPY}/{name}")
    for folder, _, names in os.walk("src"):
        for name in names:
            if f"{folder}/{name}" not in SCOPE and not folder.startswith("src/page"):
                write_if_new(f"{COPY}/{folder}/{name}", read(f"{folder}/{name}"))
    write_if_new(f"{COPY}/src/mutant.hpp", read(f"{PROJECT}/tests/mutants/mutant.hpp"))
    lines = {}
    for path, (source, mutants) in found.items():
        wanted = [one for one in mutants if one.key not in left_out]
        text, lines[path] = schema.mutated(source, wanted, kept, re.sub(r"\W", "_", path))
        write_if_new(f"{COPY}/{path}", text)
    return lines

def errors_of(path):
    """What g++ says to a file of the copy: (file, line, message)."""
    command = ["g++", *FLAGS, "-w", "-Wno-narrowing", "-fsyntax-only", "-fmax-errors=0", "-fdiagnostics-plain-output", path]
    said = subprocess.run(command, cwd=COPY, capture_output=True, encoding="latin-1", env={**os.environ, "LC_ALL": "C"}).stderr
    return [(file, int(line), text) for file, line, text in re.findall(r"^([^:\s]+):(\d+):\d+: error: (.*)$", said, re.M)]

def make_copy(found, jobs):
    """Takes out of the copy what does not compile in it. Gives the keys of those."""
    state = f"{WORK}/left_out.pickle"
    wanted = digest(*(digest(source, *(one.key for one in mutants)) for source, mutants in found.values()),
                    *(read(f"{PROJECT}/tests/mutants/{name}") for name in ("schema.py", "mutant.hpp")))
    if os.path.exists(state):
        with open(state, "rb") as file:
            known, left_out, kept = pickle.load(file)
        if known == wanted:
            write_copy(found, left_out, kept)
            return left_out
    left_out, kept = set(), set()
    sources = [path for path in SCOPE if path.endswith(".cpp")]
    while True:
        lines = write_copy(found, left_out, kept)
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            errors = [one for each in pool.map(errors_of, sources) for one in each]
        if not errors:
            break
        before = len(left_out) + len(kept)
        for file, line, text in errors:
            for one in lines.get(file, {}).get(line, []):
                left_out.add(one.key)
            constant = re.search(r"the value of '(?:\w+::)*(\w+)' is not usable in a constant expression", text)
            if constant:
                kept.add(constant[1])
                for source, mutants in found.values():
                    left_out |= {one.key for one in mutants if is_within_constant(source, one, constant[1])}
        if len(left_out) + len(kept) == before:
            for one in errors[:20]:
                print(*one)
            sys.exit("tools/run mutants: the copy does not compile")
    with open(state, "wb") as file:
        pickle.dump((wanted, left_out, kept), file)
    return left_out

def is_within_constant(source, mutant, name):
    begin = re.search(r"constexpr[^;={]*\b%s\b" % name, source)
    return bool(begin) and begin.start() < mutant.begin < source.index(";", begin.end())

def compiles_alone(path, source, mutant):
    """Whether the plain change of the source is one that the compiler takes."""
    changed = plain(source, mutant)
    folder = f"{WORK}/alone/{mutant.number}"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(os.path.dirname(path), f"{folder}/{os.path.dirname(path)}")
    write_if_new(f"{folder}/{path}", changed)
    owner = path if path.endswith(".cpp") else next(
        one for one in SCOPE if one.endswith(".cpp") and f'"{os.path.basename(path)}"' in read(one))
    command = ["g++", "-std=c++20", f"-I{folder}/src", "-Iinclude", "-Isrc", "-w", "-fsyntax-only", f"{folder}/{owner}"]
    good = subprocess.run(command, capture_output=True).returncode == 0
    shutil.rmtree(folder)
    return good

def plain(source, one):
    end, text = one.end, one.text
    if one.how == "never":
        end, text = one.end, source[one.begin:one.end] + f"; {one.text} && false"
    if one.how == "statement":
        text = ";"
    if one.how == "case":
        begin, end = source.rindex("case", 0, one.at), source.index(":", one.at + len(text)) + 1
        return source[:begin] + source[end:]
    return source[:one.begin] + text + source[end:]

def build(jobs):
    env = dict(os.environ)
    if shutil.which("ccache"):
        env.update(CMAKE_CXX_COMPILER_LAUNCHER="ccache", CCACHE_BASEDIR=WORK, CCACHE_NOHASHDIR="1")
    with open(f"{WORK}/build.log", "w") as log:
        for command in (["cmake", "-S", COPY, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DDPSLAVE_MUTANTS=ON",
                         "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DCMAKE_CXX_FLAGS=-w -Wno-narrowing -D_GLIBCXX_ASSERTIONS"],
                        ["cmake", "--build", BUILD, "-j", str(jobs), "--target", *PROGRAMS]):
            if subprocess.run(command, env=env, stdout=log, stderr=subprocess.STDOUT).returncode != 0:
                sys.exit(f"tools/run mutants: the copy was not built. See {WORK}/build.log")

# --- running -----------------------------------------------------------------------------------------------------

class Server:
    """A test program that runs its tests again and again (mutant.hpp)."""

    def __init__(self, program):
        self.process = subprocess.Popen([f"{BUILD}/tests/{program}", "--gtest_fail_fast", "--gtest_brief=1"], text=True,
                                        env={**os.environ, **SHORT, "DPSLAVE_MUTANTS_SERVE": "1"}, encoding="latin-1",
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)

    def run(self, number, tests, seconds, reached="-"):
        """(status, test that failed, processor seconds). The limit is of processor time: a busy machine kills nothing."""
        self.process.stdin.write(f"{number} {seconds} {reached} {':'.join(tests)}\n")
        self.process.stdin.flush()
        failed = ""
        for line in self.process.stdout:
            if line.startswith("ENDED "):
                status, used = map(int, line.split()[1:])
                return "time" if -status in (signal.SIGXCPU, signal.SIGALRM, signal.SIGKILL) else status, failed, used / 1e6
            if line.startswith("[  FAILED  ] ") and not failed:
                failed = line.split()[3].rstrip(",")
        sys.exit("tools/run mutants: a test program ended")


thread = threading.local()


def server(program):
    """One of each program for each thread."""
    if not hasattr(thread, "servers"):
        thread.servers = {}
    if program not in thread.servers:
        thread.servers[program] = Server(program)
    return thread.servers[program]


def tests_of(program):
    text = subprocess.run([f"{BUILD}/tests/{program}", "--gtest_list_tests"], capture_output=True, encoding="latin-1", check=True).stdout
    suite, tests = "", []
    for line in text.split("\n"):
        if line and not line.startswith(" ") and line.split("#")[0].strip().endswith("."):
            suite = line.split("#")[0].strip()
        elif line.startswith("  ") and "DISABLED_" not in line:
            tests.append(suite + line.split("#")[0].strip())
    return tests

def measure(program, test):
    """(test, seconds, mutants that it comes to) of the source as it is. What waits for a thread or a port comes late."""
    file = f"{WORK}/reached/{program}.{digest(test)[:12]}"
    begin = time.monotonic()
    status, _, _ = server(program).run(0, [test], 120, file)
    used = time.monotonic() - begin
    if status != 0:
        sys.exit(f"tools/run mutants: {program} fails without any mutant: {test}")
    reached = frozenset(map(int, read(file).split()))
    os.remove(file)
    return test, used, reached


def measure_all(jobs):
    """program -> its tests, cheapest first; remembered for as long as the program is the same."""
    os.makedirs(f"{WORK}/reached", exist_ok=True)
    known = {}
    for program in PROGRAMS:
        with open(f"{BUILD}/tests/{program}", "rb") as file:
            wanted = hashlib.sha256(file.read()).hexdigest() + str(SHORT)
        cache = f"{WORK}/reached/{program}.pickle"
        if os.path.exists(cache):
            with open(cache, "rb") as file:
                of, known[program] = pickle.load(file)
            if of == wanted:
                continue
        tests = tests_of(program)
        say(f"{program}: which of its {len(tests)} tests comes to which mutant")
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            known[program] = sorted(pool.map(measure, [program] * len(tests), tests), key=lambda one: one[1])
        with open(cache, "wb") as file:
            pickle.dump((wanted, known[program]), file)
    return known

KILLS = collections.Counter()  # which tests have ended how many mutants: they are asked first


def groups_of(tests):
    """Tests that run in one process each: first those that have seen most, then the quickest."""
    seen_most = [one for one in sorted(tests, key=lambda one: -KILLS[one[0]])[:8] if KILLS[one[0]] and one[1] < 0.1]
    rest = [one for one in tests if one not in seen_most]
    groups = [seen_most] if seen_most else []
    while rest:
        group = [rest.pop(0)]
        while rest and sum(one[1] for one in group) + rest[0][1] < 0.3:
            group.append(rest.pop(0))
        groups.append(group)
    return groups


def judge(number, programs, known):
    """(verdict, by what)."""
    came = False
    for program in programs:
        for group in groups_of([one for one in known[program] if number in one[2]]):
            came = True
            seconds = 2 + int(10 * sum(one[1] for one in group))
            status, failed, _ = server(program).run(number, [one[0] for one in group], seconds)
            if status == REFUSED:
                return "compiler", "static_assert"
            if status == "time":
                return "time", program
            if status != 0:
                KILLS[failed] += 1
                return "killed", f"{program} {failed or status}"
    return "alive", "" if came else "no test comes to it"


# --- results -----------------------------------------------------------------------------------------------------

class Results:
    """A file with a row for each mutant judged; it is read again, so that a run goes on where it was stopped."""

    def __init__(self, found):
        self.path = f"{WORK}/results.csv"
        self.sources = {path: digest(source)[:12] for path, (source, _) in found.items()}
        self.rows = {}
        if os.path.exists(self.path):
            with open(self.path, newline="", encoding="latin-1") as file:
                for key, of, verdict, by in csv.reader(file):
                    if of == self.sources.get(key.split(":")[0]):
                        self.rows[key] = (verdict, by)
                        KILLS[by.split(" ")[-1]] += 1
        with open(self.path, "w", newline="", encoding="latin-1") as file:
            csv.writer(file).writerows([key, self.sources[key.split(":")[0]], *row] for key, row in self.rows.items())
        self.file = open(self.path, "a", newline="", encoding="latin-1", buffering=1)

    def add(self, key, verdict, by):
        self.rows[key] = (verdict, by)
        csv.writer(self.file).writerow([key, self.sources[key.split(":")[0]], verdict, by])

def main():
    parser = argparse.ArgumentParser(prog="tools/run mutants")
    parser.add_argument("--file", action="append", help="only mutants of this source; may stand several times")
    parser.add_argument("--operator", action="append", help="only mutants of this operator; may stand several times")
    parser.add_argument("--list", action="store_true", help="only say what there is")
    parser.add_argument("--fresh", action="store_true", help="forget the results of earlier runs")
    parser.add_argument("--as-built", action="store_true", help="judge with the programs that were built last")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--consistent", action="store_true", help="only look whether explanations and page fit the sources")
    arguments = parser.parse_args()
    if arguments.consistent:
        sys.exit(consistent())

    os.makedirs(WORK, exist_ok=True)
    say("Looking for what can be changed")
    found = find_all(arguments.jobs)
    everything = [(path, source, one) for path, (source, mutants) in found.items() for one in mutants]
    chosen = [(path, source, one) for path, source, one in everything
              if (not arguments.file or path in arguments.file) and (not arguments.operator or one.operator in arguments.operator)]
    if arguments.list:
        for path, _, one in chosen:
            print(f"{path}:{one.line}: {one.operator}: {one.change}   {one.key}")
        return
    if arguments.fresh and os.path.exists(f"{WORK}/results.csv"):
        os.remove(f"{WORK}/results.csv")

    say(f"Making a copy with {len(everything)} mutants")
    left_out = make_copy(found, arguments.jobs)
    print(f"{len(left_out)} of them do not compile in it")
    if not arguments.as_built:
        say("Building it")
        build(arguments.jobs)
    known = measure_all(arguments.jobs)

    results = Results(found)
    work = [(path, source, one) for path, source, one in chosen if results.rows.get(one.key, ("alive",))[0] == "alive"]
    work.sort(key=lambda item: item[2].key in results.rows)  # what is known to be alive comes last
    say(f"Judging {len(work)} of {len(chosen)} mutants")
    begin, done = time.monotonic(), 0

    def one_of(item):
        path, source, one = item
        if one.key in left_out:
            return one, ("alive", "compiles only alone") if compiles_alone(path, source, one) else ("compiler", "")
        return one, judge(one.number, SCOPE[path], known)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for finished in concurrent.futures.as_completed([pool.submit(one_of, item) for item in work]):
            one, verdict = finished.result()
            results.add(one.key, *verdict)
            done += 1
            if done % 100 == 0:
                alive = sum(row[0] == "alive" for row in results.rows.values())
                print(f"{done} of {len(work)}, {(time.monotonic() - begin) / done:.2f} s each, alive by now: {alive}", flush=True)

    report(chosen, results)

def explanations():
    """key -> (line of the source, change, reason), of mutants that no test can see."""
    with open(EXPLAINED, newline="", encoding="latin-1") as file:
        return {row["key"]: (row["line"], row["change"], row["reason"]) for row in csv.DictReader(file)}


def consistent():
    """What needs no compiler: every explanation is of a line that is there, and the page lists the operators. Gives the exit
    status."""
    wrong = []
    for key, (line, _, reason) in explanations().items():
        path, operator, known, _ = key.split(":")
        there = path in SCOPE and line in (" ".join(one.split()) for one in read(path).split("\n"))
        if not there or digest(line)[:6] != known or operator not in places.OPERATORS or not reason:
            wrong.append(f"tests/mutants/explained.csv: {key}: no such line in {path}, or no reason")
    page = read("docs/internals/mutants.md")
    wrong += [f"docs/internals/mutants.md: no row | {name} | {text} |" for name, text in places.OPERATORS.items()
              if f"| {name} | {text} |" not in page]
    wrong += [f"docs/internals/mutants.md: no row of {path}" for path in SCOPE if f"| {path} |" not in page]
    print("\n".join(wrong))
    return 1 if wrong else 0


def report(chosen, results):
    """Prints the tables and what nobody explains. Gives the exit status."""
    explained = explanations()
    table = {"file": collections.defaultdict(collections.Counter), "operator": collections.defaultdict(collections.Counter)}
    open_ones, stale = [], []
    for path, source, one in chosen:
        verdict, by = results.rows[one.key]
        line = " ".join(source.split("\n")[one.line - 1].split())
        is_explained = explained.get(one.key, ("",))[:2] == (line, one.change)
        if verdict == "alive":
            verdict = "explained" if is_explained else "open"
        if verdict == "open":
            open_ones.append(f"{path}:{one.line}: {line}\n    {one.operator}: {one.change}  [{one.key}] {by}")
        elif is_explained and verdict != "explained":
            stale.append(f"{one.key}: it is not alive ({by})")
        table["file"][path][verdict] += 1
        table["operator"][one.operator][verdict] += 1
    keys = {one.key for _, _, one in chosen}
    files = {path for path, _, _ in chosen}
    stale += [f"{key}: there is no such mutant" for key in explained if key not in keys and key.split(":")[0] in files]
    for title, rows in table.items():
        print(f"\n| {title} | mutants | killed | by time limit | by compiler | alive, explained | alive |\n|---|---|---|---|---|---|---|")
        for name, row in [*rows.items(), ("all", sum(rows.values(), collections.Counter()))]:
            counts = " | ".join(str(row[verdict]) for verdict in ("killed", "time", "compiler", "explained", "open"))
            print(f"| {name} | {sum(row.values())} | {counts} |")
    for title, lines in (("Alive, and nobody explains it", open_ones), ("Explained, but", stale)):
        if lines:
            say(f"{title}: {len(lines)}")
            print("\n".join(lines))
    return 1 if open_ones or stale else 0


if __name__ == "__main__":
    main()
