#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""words.py ROOT: fails if a page, a comment or a message has a word of words.txt, or if a comment in one of the judged
libraries begins as half a sentence: "What ...", "So many ...", "Nothing: ...".

First it makes sure that it would notice.
"""
import pathlib
import re
import sys

PAGES = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "debian/README.md", "config/**/*.toml", "docs/**/*.md",
         "docs/man/*.scd"]
SOURCES = ["include/**/*.hpp", "src/**/*.hpp", "src/**/*.cpp"]
# Those whose comments are judged only by their words.
SHELL = re.compile(r"(src|include/dpslave)/(app|dpctl|dpslaved|control|report|api)/|/drive/poller")
HALF = re.compile(r"(What|Which|Whether|How|Of|So many|So much)\b(?!.*\?)|.*\b[Nn]othing: (it|there|none|no)\b")


def word_list(path):
    pairs = [line.split(" | ") for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [(re.compile(rf"\b{word}", re.IGNORECASE), plain) for word, plain in pairs]


def faults_of_words(name, text, words):
    for number, line in enumerate(text.split("\n"), 1):
        for word, plain in words:
            if found := word.search(line):
                yield f"{name}:{number}: \"{found[0]}\": write {plain}"


def faults_of_comments(name, text):
    """The first sentence of each comment that has a line of its own."""
    before = ""
    for number, line in enumerate(text.split("\n"), 1):
        comment = re.match(r"\s*///?<? (.*)", line)
        if comment and not re.match(r"\s*//(?!.*SPDX)", before) and HALF.match(comment[1]):
            yield f"{name}:{number}: half a sentence: {comment[1][:80]}"
        before = line


def notices(words):
    page = "A checksum and a check sum, after\na Time-out.\n"
    comment = "/// What it does.\nint a;\n/// It does it.\n/// What that is, follows.\nint b;\n// Who is it?\nint c;\n    // Of the line.\n"
    return len(list(faults_of_words("x", page, words))) == 2 and len(list(faults_of_comments("x", comment))) == 2


def main():
    root = pathlib.Path(sys.argv[1])
    words = word_list(pathlib.Path(__file__).parent / "words.txt")
    if not notices(words):
        sys.exit("words.py: this check is blind or sees what is not there")
    faults, read = [], 0
    for path in sorted({path for pattern in PAGES + SOURCES for path in root.glob(pattern)}):
        name, text = str(path.relative_to(root)), path.read_text()
        read += 1
        faults += faults_of_words(name, text, words)
        if name.endswith("pp") and not SHELL.search(name):
            faults += faults_of_comments(name, text)
    print("\n".join(faults))
    sys.exit(bool(faults) or read < 300)


main()
