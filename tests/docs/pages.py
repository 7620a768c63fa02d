#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pages.py links|sentences ROOT, pages.py commands ROOT PROGRAM...: fails if a page

links      leads to a file or a heading that does not exist
commands   shows a command of these programs with a subcommand or an option that its --help does not know
sentences  has a sentence that is too long, or is a chain of semicolons

First it makes sure that it would notice.
"""
import pathlib
import re
import subprocess
import sys

LONGEST = 33  # words of a sentence
# For those who install, operate and repair. The reference and the table of promises are for those who change the code.
PAGES = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "debian/README.md", "gsd/README.md",
         "config/tags/README.md", "docs/**/*.md", "docs/man/*.scd"]
NOT_SENTENCES = ["docs/reference/manual-coverage.md", "docs/reference/profibus-dp.md", "docs/reference/drive-protocols.md",
                 "docs/devices/tag-table.md"]


def pages(root):
    if not (root / "CMakeLists.txt").exists():  # as installed
        return sorted(root.rglob("*.md"))
    return [page for pattern in PAGES for page in sorted(root.glob(pattern))]


def without_blocks(text):
    """The lines of a page; those of fenced blocks are empty."""
    inside, lines = False, []
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        lines.append("" if fence or inside else line)
        inside ^= fence
    return lines


def anchor(heading):
    """The name that a heading has in a link."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")


def anchors(text):
    return {anchor(line.lstrip("#")) for line in without_blocks(text) if line.startswith("#")}


def faults_of_links(name, text, root):
    for number, line in enumerate(without_blocks(text), 1):
        for target in re.findall(r"\]\(([^)\s]+)\)", line):
            if "://" in target or name.endswith(".scd"):
                continue
            path, _, wanted = target.partition("#")
            base = root if name == "debian/README.md" else (root / name).parent  # installed one folder above docs/
            if path and not (base / path).exists():
                yield f"{name}:{number}: there is no {target}"
            elif wanted and wanted not in anchors((base / path).read_text() if path else text):
                yield f"{name}:{number}: {path or name} has no heading #{wanted}"


def shown(name, text):
    """(line, command) of each command that a page shows, in a block or between backticks; in a manual page in bold."""
    inside = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif inside:
            # A comment is not part of the command, and a block may show several joined by && or |.
            for part in re.split(r"&&|\|\s|;\s", re.sub(r"(^|\s)#.*", "", line)):
                yield number, part.strip().removeprefix("$ ")
        else:
            spans = re.findall(r"`([^`]+)`", line)
            if name.endswith(".scd"):
                spans += re.findall(r"\*((?:dpctl|dpsim|dpslaved) [^*]+)\*", line)
            for span in spans:
                yield number, span.strip()


class Program:
    """What a program's --help knows: the options of each of its commands."""

    def __init__(self, path):
        self.path, self.known = path, {}

    def help(self, command):
        if command not in self.known:
            text = subprocess.run([self.path, *command, "--help"], capture_output=True, text=True, check=False).stdout
            section = "".join(re.findall(r"^(?:Commands|Look|Watch|Operate|Offline|Version):\n((?: .*\n)+)", text, re.M))
            self.known[command] = (set(re.findall(r"^  ([a-z][a-z-]*)", section, re.M)),
                                   set(re.findall(r"(?:^ +|, ?)(--?[a-z][a-z-]*)", text, re.M)) | {"--help", "-h"})
        return self.known[command]


def faults_of_commands(name, text, programs):
    for number, line in shown(name, text):
        words = line.split()
        while words and re.match(r"sudo$|\w+=", words[0]):
            words.pop(0)
        program = programs.get(words[0].rpartition("/")[2]) if words else None
        if program is None:
            continue
        command, options, skip = (), set(program.help(())[1]), False
        for word in words[1:]:
            commands = program.help(command)[0]
            if word.startswith("--"):
                if word.partition("=")[0] not in options:
                    yield f"{name}:{number}: '{' '.join((words[0], *command))}' has no option {word}"
                skip = word in ("--socket", "--timeout", "--config", "--profiles")
            elif skip:
                skip = False
            elif commands:
                if not re.match(r"[a-z][a-z-]*$", word):
                    break  # a place for a command, as in "dpctl COMMAND"
                if word not in commands:
                    if not command:
                        yield f"{name}:{number}: '{words[0]}' has no command {word}"
                    break
                command += (word,)
                options |= program.help(command)[1]


def sentences(name, text):
    """(line, sentence) of a page: of paragraphs, items of lists and cells of tables; headings and blocks are left out."""
    paragraph, start = "", 0
    for number, line in enumerate(without_blocks(text) + [""], 1):
        line = line.rstrip() if name.endswith(".scd") else line.strip()
        item = re.match(r"\s*([-*]|\d+\.)\s|\|", line) or (name.endswith(".scd") and not re.match(r"\t?[^\t*_]", line))
        if (not line or line.startswith("#") or item) and paragraph:
            for sentence in re.split(r"(?<=[.!?])[*_)\"]*\s+(?=[*_`(\"\[]*[A-Z0-9])", paragraph):
                yield start, sentence
            paragraph = ""
        if line and not line.startswith("#"):
            for cell in line.strip("|").split(" | ")[:-1] if line.startswith("|") else []:
                yield number, cell
            rest = line.strip("|").split(" | ")[-1] if line.startswith("|") else line
            start = start if paragraph else number
            paragraph = f"{paragraph} {rest.strip()}".strip()


def faults_of_sentences(name, text):
    for number, sentence in sentences(name, text):
        plain = re.sub(r"\]\([^)]*\)", "]", re.sub(r"`[^`]*`", "X", sentence))
        words = len(re.findall(r"[^\W\d_][\w'-]*|\d[\w.,-]*", plain))
        chain = plain.count("; ") > 1
        if words > LONGEST:
            yield f"{name}:{number}: {words} words in one sentence: {sentence[:90]}"
        elif chain:
            yield f"{name}:{number}: a chain of semicolons: {sentence[:90]}"


def notices(kind, programs):
    """Whether this check sees what is wrong, and only that."""
    root = pathlib.Path(__file__).parent
    if kind == "links":
        text = "# One head\n[a](#one-head) [b](#no-head) [c](pages.py) [d](no.md)\n```\n[e](no.md)\n```\n"
        return len(list(faults_of_links("x.md", text, root))) == 2
    if kind == "commands":
        text = "`dpctl status` `dpctl sttus` `dpctl hex 288 --none`\n```\ndpctl doctor --rules && dpctl gsd nothing\ndpctl x\n```\n"
        return len(list(faults_of_commands("x.md", text, programs))) == (3 if "dpctl" in programs else 0)
    text = "A b; c; d.\n\n" + "word " * (LONGEST + 1) + ".\n\n" + "Short one. " * LONGEST + "\n```\na; b; c; d\n```\n"
    return len(list(faults_of_sentences("x.md", text))) == 2


def main():
    kind, root = sys.argv[1], pathlib.Path(sys.argv[2])
    programs = {pathlib.Path(path).name: Program(path) for path in sys.argv[3:]}
    if not notices(kind, programs):
        sys.exit(f"pages.py {kind}: this check is blind or sees what is not there")
    faults, read, commands = [], 0, 0
    for page in pages(root):
        name, text = str(page.relative_to(root)), page.read_text()
        read += 1
        if kind == "links":
            faults += faults_of_links(name, text, root)
        elif kind == "commands":
            commands += len([line for _, line in shown(name, text) if line.startswith("dp")])
            faults += faults_of_commands(name, text, programs)
        elif name not in NOT_SENTENCES:
            faults += faults_of_sentences(name, text)
    for fault in faults:
        print(fault)
    sys.exit(bool(faults) or read < 15 or (kind == "commands" and commands < 100))


main()
