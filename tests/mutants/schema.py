# SPDX-License-Identifier: Apache-2.0
"""Writes a copy of the sources in which every mutant is, chosen at run time (mutant.hpp).

So a file is compiled once for all of its mutants. What the compiler needs as a constant cannot be chosen at run time: such
a mutant is taken out of the copy, and the compiler judges it as a plain change of the source.
"""
import re

# Which kind of change lies around which, where both begin and end at the same place.
LAYERS = ["expression", "condition", "case", "never", "statement"]


class Region:
    """All mutants of one kind of one stretch of the source."""

    def __init__(self, begin, end, how, mutants):
        self.begin, self.end, self.how, self.mutants, self.inner = begin, end, how, mutants, []


def regions_of(mutants):
    """The outermost regions; each has those within it."""
    found = {}
    for one in mutants:
        found.setdefault((one.begin, one.end, one.how), []).append(one)
    ordered = sorted((Region(*key, inside) for key, inside in found.items()),
                     key=lambda one: (one.begin, -one.end, -LAYERS.index(one.how)))
    top, stack = [], []
    for region in ordered:
        while stack and stack[-1].end <= region.begin:
            stack.pop()
        if stack and region.end > stack[-1].end:
            raise ValueError(f"two changes cross each other at octet {region.begin}")
        (stack[-1].inner if stack else top).append(region)
        stack.append(region)
    return top


class Writer:
    """The text of the copy; every alternative begins on a line of its own, so that a message of the compiler names it."""

    def __init__(self, source):
        self.source = source
        self.parts = []
        self.line = 1
        self.lines = {}  # line of the copy -> mutants that stand there

    def put(self, text):
        self.parts.append(text)
        self.line += text.count("\n")

    def alternative(self, mutant, text):
        first = self.line + 1
        self.put(f"\n{text}\n")
        for line in range(first, self.line):
            self.lines.setdefault(line, []).append(mutant)

    def stretch(self, begin, end, regions):
        at = begin
        for region in regions:
            self.put(self.source[at:region.begin])
            getattr(self, "put_" + region.how)(region)
            at = region.end
        self.put(self.source[at:end])

    def inside(self, region):
        self.stretch(region.begin, region.end, region.inner)

    def put_expression(self, region):
        self.put("(")
        for one in region.mutants:
            self.alternative(one, f"mutants::is({one.number}) ? ({one.text}) :")
        self.put("(")
        self.inside(region)
        self.put("))")

    def put_condition(self, region):
        self.put("(")
        for one in region.mutants:
            self.alternative(one, f"mutants::is({one.number}) ? {one.text} :")
        self.put("static_cast<bool>(")
        self.inside(region)
        self.put("))")

    def put_case(self, region):
        for one in region.mutants:
            self.put("mutants::without_case(")
        self.inside(region)
        for one in region.mutants:
            self.alternative(one, f", {one.number}, {one.text})")

    def put_never(self, region):
        self.inside(region)
        for one in region.mutants:
            self.alternative(one, f"; !mutants::is({one.number}) && static_cast<bool>({one.text})")

    def put_statement(self, region):
        one, = region.mutants
        self.alternative(one, f"{{ if (!mutants::is({one.number}))")
        self.inside(region)
        self.put(" }")


def run_time(text, kept, tag):
    """Tables and functions of the compiler become those of the run; a static_assert ends the program. `kept`: names that
    stay constants of the compiler."""
    def declaration(match):
        before, rest = match[1] or "", text[match.end():]
        if re.match(r"[^;={]*\(", rest):  # a function
            return before + ("" if "inline" in before else "inline ")
        name = re.match(r"[^={;]*?(\w+)\s*[={\[]", rest)
        return match[0] if name and name[1] in kept else before + "const "
    text = re.sub(r"(?<!if )\b((?:inline |static )*)(?:constexpr|consteval)\s+", declaration, text)
    return re.sub(r"^static_assert\(([^;\"]*?)(?:, \"[^\"]*\")?\);",
                  lambda match: f"[[maybe_unused]] static const bool compiles_{tag}_{match.start()} = mutants::compiles({match[1]});",
                  text, flags=re.M)


def mutated(source, mutants, kept, tag):
    """The text of the copy, and which mutants stand in which of its lines."""
    writer = Writer(source)
    writer.put('#include "mutant.hpp"\n')
    writer.stretch(0, len(source), regions_of(mutants))
    text = "".join(writer.parts)
    changed = run_time(text, kept, tag)
    if changed.count("\n") != text.count("\n"):
        raise ValueError("a line was lost")
    return changed, writer.lines
