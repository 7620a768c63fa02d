# SPDX-License-Identifier: Apache-2.0
"""Finds what can be changed in a source: each change is one mutant.

clang++ parses the file as the build does, and its syntax tree says where each expression begins and ends and of what
type it is. So a change never depends on a guess about precedence or types.
"""
import json
import re
import subprocess
from dataclasses import dataclass

BOUNDARY = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
EQUALITY = {"==": "!=", "!=": "=="}
LOGIC = {"&&": "||", "||": "&&"}
ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "*"}
BITS = {"&": "|", "|": "&", "^": "|", "<<": ">>", ">>": "<<"}
ASSIGNMENT = {"+=": "-=", "-=": "+=", "|=": "&=", "&=": "|=", "^=": "|=", "<<=": ">>=", ">>=": "<<=", "++": "--", "--": "++"}
CALLS = {"min": "max", "max": "min", "any_of": "all_of", "all_of": "any_of", "none_of": "all_of"}

# What each operator does, as docs/internals/mutants.md lists it (a test compares the two).
OPERATORS = {
    "boundary": "`<` for `<=`, `>` for `>=`, and back",
    "equality": "`==` for `!=`, and back",
    "logic": "*and* for *or*, and back",
    "clause": "one side of an *and* or an *or* taken out",
    "negation": "a *not* taken out",
    "condition": "a condition that always holds, or never",
    "arithmetic": "`+` for `-`, `*` for `/`, and back, `*` for `%`",
    "bits": "*and* for *or* of bits, *or* for *exclusive or*, a shift to the other side, a complement taken out",
    "assignment": "`+=` for `-=`, `++` for `--`, and back, also of the operators on bits",
    "constant": "a number one larger or smaller, `true` for `false`, and back, a character one further",
    "statement": "an assignment, a call, `return;`, `break` or `continue` taken out",
    "value": "another value of the same enumeration, in a table also `none`, where there is one",
    "case": "a `case` taken out: its value is as one that no case names",
    "algorithm": "`min` for `max`, `any_of` for `all_of`, and back, `all_of` for `none_of`",
}


@dataclass
class Mutant:
    """One change of the octets begin to end of a file."""
    begin: int
    end: int
    operator: str
    change: str       # what a reader is told: "< for <="
    how: str          # expression, condition, case, never (of a variable in a condition), statement
    text: str         # the alternative; of a case its label
    at: int           # where it is shown
    number: int = 0   # its number at run time
    key: str = ""
    line: int = 0


def syntax_tree(path, flags):
    """The declarations of namespace dpslave, in the order in which clang++ prints them."""
    command = ["clang++-14", *flags, "-fsyntax-only", "-Xclang", "-ast-dump=json", "-Xclang", "-ast-dump-filter=dpslave", path]
    text = subprocess.run(command, check=True, capture_output=True, encoding="latin-1").stdout
    decoder, at, trees = json.JSONDecoder(), 0, []
    while text[at:at + 1]:
        tree, at = decoder.raw_decode(text, at)
        trees.append(tree)
        while text[at:at + 1].isspace():
            at += 1
    return trees


class Finder:
    """Walks the tree of one file. clang++ names a file only where it changes, so every location is looked at in order."""

    def __init__(self, path, name_in_tree, source):
        self.source = source
        self.wanted = name_in_tree
        self.file = ""
        self.enums = {}      # id of an enumerator -> names of its enumeration
        self.constants = {}  # type -> names of the constants of it in this file
        self.found = {}
        self.parents = []
        self.in_table = False  # within a table of rows

    # --- places -------------------------------------------------------------------------------------------------

    def locate(self, place):
        """Notes the file; gives (file, offset, length), or None inside a macro."""
        for inside in ("spellingLoc", "expansionLoc"):
            if inside in place:
                self.locate(place[inside])
        if "spellingLoc" in place or "offset" not in place:
            return None
        self.file = place.get("file", self.file)
        return self.file, place["offset"], place["tokLen"]

    def visit_places(self, node):
        if "loc" in node:
            self.locate(node["loc"])
        begin = self.locate(node["range"]["begin"]) if "range" in node else None
        end = self.locate(node["range"]["end"]) if "range" in node else None
        node["span"] = None
        if begin and end and begin[0] == end[0] == self.wanted:
            node["span"] = (begin[1], end[1] + end[2])
        for child in node.get("inner", []):
            self.visit_places(child)

    def text(self, node):
        return self.source[node["span"][0]:node["span"][1]]

    # --- mutants ------------------------------------------------------------------------------------------------

    def add(self, node, operator, change, text, how="expression", at=None):
        begin, end = node["span"]
        self.found.setdefault((begin, end, operator, text),
                              Mutant(begin, end, operator, change, how, text, begin if at is None else at))

    def collect(self, node):
        kind = node.get("kind")
        if kind == "EnumDecl":
            values = [one for one in node.get("inner", []) if one["kind"] == "EnumConstantDecl"]
            names = [one["name"] for one in values if one["name"] != "count"]
            for one in values:
                self.enums[one["id"]] = names
        if kind == "VarDecl" and node.get("constexpr") and node["span"] and "::" not in node["type"]["qualType"] and \
                re.fullmatch(r"const [A-Z]\w+", node["type"]["qualType"]):
            self.constants.setdefault(node["type"]["qualType"], []).append(node["name"])
        for child in node.get("inner", []):
            self.collect(child)

    def walk(self, node):
        kind = node.get("kind", "")
        if kind in ("StaticAssertDecl", "EnumDecl") or (kind == "FunctionDecl" and self.is_consteval(node)):
            return
        if kind == "ConstantExpr":  # case labels, sizes of arrays
            return
        handler = getattr(self, "on_" + kind, None)
        if handler and node["span"]:
            if handler(node) == "done":
                return
        outside = self.in_table
        self.in_table = outside or (kind == "VarDecl" and node.get("name", "").endswith("Table"))
        self.parents.append(node)
        for child in node.get("inner", []):
            self.walk(child)
        self.parents.pop()
        self.in_table = outside

    def is_consteval(self, node):
        return bool(node["span"]) and self.text(node).startswith("consteval")

    def on_BinaryOperator(self, node):
        left, right = node["inner"]
        self.binary(node, left, right)

    on_CompoundAssignOperator = on_BinaryOperator

    def on_CXXOperatorCallExpr(self, node):
        if len(node["inner"]) == 3:
            self.binary(node, node["inner"][1], node["inner"][2])

    def on_CXXRewrittenBinaryOperator(self, node):
        """`a != b` by `==`, `a < b` by `<=>`: the operands are somewhere below."""
        below = node
        while below.get("inner"):
            below = below["inner"][0]
            if below["kind"] == "CXXOperatorCallExpr" and len(below["inner"]) == 3 and self.operator_between(*below["inner"][1:]):
                break
        else:
            return "done"
        below["span"] = node["span"]
        self.binary(node, *below["inner"][1:])
        self.parents.append(node)
        for child in below["inner"][1:]:
            self.walk(child)
        self.parents.pop()
        return "done"

    def operator_between(self, left, right):
        if not left["span"] or not right["span"]:
            return ""
        between = self.source[left["span"][1]:right["span"][0]]
        return re.sub(r"//[^\n]*|/\*.*?\*/", "", between, flags=re.S).strip()

    def binary(self, node, left, right):
        operator = self.operator_between(left, right)
        a, b = (f"({self.text(one)})" if one["span"] else "" for one in (left, right))
        for name, table in (("boundary", BOUNDARY), ("equality", EQUALITY), ("logic", LOGIC), ("arithmetic", ARITHMETIC),
                            ("bits", BITS), ("assignment", ASSIGNMENT)):
            if operator not in table:
                continue
            if name in ("arithmetic", "bits") and not self.is_number(node):
                continue
            if name == "equality" and self.is_condition(node):
                continue  # always and never are harder to see
            self.add(node, name, f"{table[operator]} for {operator}", f"{a} {table[operator]} {b}", at=left["span"][1])
        if operator in LOGIC:
            self.add(node, "clause", f"without {self.short(right)}", f"static_cast<bool>{a}", at=right["span"][0])
            self.add(node, "clause", f"without {self.short(left)}", f"static_cast<bool>{b}", at=left["span"][0])

    def is_condition(self, node):
        parent = self.parents[-1] if self.parents else {}
        return parent.get("kind") in ("IfStmt", "ConditionalOperator") and \
            [one for one in parent["inner"] if one.get("kind") != "DeclStmt"][0] is node

    def short(self, node):
        return " ".join(self.text(node).split())

    def is_number(self, node):
        kind = node["type"].get("desugaredQualType", node["type"]["qualType"])
        return bool(re.fullmatch(r"(const )?((unsigned|signed) )?(bool|char|short|int|long( long)?|double|float)", kind)) or \
            any(word in kind for word in ("chrono", "Tbit", "Instant", "dependent"))

    def on_UnaryOperator(self, node):
        operator, operand = node["opcode"], node["inner"][0]
        if not operand["span"] or not (node.get("isPostfix") or self.text(node).startswith(operator)):
            return
        inner = self.text(operand)
        if operator == "!":
            self.add(node, "negation", "without !", f"static_cast<bool>({inner})")
        elif operator == "~":
            self.add(node, "bits", "without ~", inner)
        elif operator in ("++", "--") and not self.is_step_of_loop(node):
            other = ASSIGNMENT[operator]
            self.add(node, "assignment", f"{other} for {operator}", inner + other if node.get("isPostfix") else other + inner)

    def is_step_of_loop(self, node):
        return any(one["kind"] == "ForStmt" and one["inner"][3] is child
                   for one, child in zip(self.parents, self.parents[1:] + [node]))

    def on_IntegerLiteral(self, node):
        text = self.text(node)
        parts = re.fullmatch(r"(0x[0-9A-Fa-f']+|[0-9']+)([a-z_A-Z]*)", text)
        if not parts:
            return
        number, suffix = parts.groups()
        value = int(number.replace("'", ""), 0)
        for other in (value + 1, value - 1):
            if other >= 0:
                new = (hex(other) if number.startswith("0x") else str(other)) + suffix
                self.add(node, "constant", f"{new} for {text}", new)

    on_UserDefinedLiteral = on_IntegerLiteral

    def on_CharacterLiteral(self, node):
        self.add(node, "constant", f"one more than {self.text(node)}", f"static_cast<char>({self.text(node)} + 1)")

    def on_CXXBoolLiteralExpr(self, node):
        other = "false" if node["value"] else "true"
        self.add(node, "constant", f"{other} for {self.text(node)}", other)

    def on_DeclRefExpr(self, node):
        meant = node["referencedDecl"]
        text = self.text(node)
        before, name = text[:text.rfind("::") + 2] if "::" in text else "", meant.get("name", "")
        if meant["kind"] == "EnumConstantDecl" and text.endswith(name):
            self.other_values(node, before, name, self.enums.get(meant["id"], []))
        elif meant["kind"] == "VarDecl" and text == name:
            names = self.constants.get(meant["type"]["qualType"], [])
            if name in names:
                self.other_values(node, "", name, names)

    def on_CallExpr(self, node):
        called = node["inner"][0]
        while called["kind"] != "DeclRefExpr" and called.get("inner"):
            called = called["inner"][0]
        if called["kind"] != "DeclRefExpr" or not called["span"]:
            return
        name = re.search(r"\b(%s)\b" % "|".join(CALLS), self.text(called))
        if name:
            begin = called["span"][0] + name.start()
            other = CALLS[name[1]]
            text = self.source[node["span"][0]:begin] + other + self.source[begin + len(name[1]):node["span"][1]]
            self.add(node, "algorithm", f"{other} for {name[1]}", text, at=begin)

    def other_values(self, node, before, name, names):
        if name not in names or len(names) < 2:
            return
        after = names[(names.index(name) + 1) % len(names)]
        for other in dict.fromkeys([after] + (["none"] if "none" in names and self.in_table else [])):
            if other != name:
                self.add(node, "value", f"{other} for {name}", before + other)

    # --- statements ---------------------------------------------------------------------------------------------

    def condition(self, node, which=("true", "false")):
        if not node["span"] or node["kind"] in ("CXXBoolLiteralExpr", "IntegerLiteral"):
            return
        for value in which:
            word = "always" if value == "true" else "never"
            self.add(node, "condition", f"{word}: {self.short(node)}", f"(static_cast<void>({self.text(node)}), {value})", "condition")

    def on_ConditionalOperator(self, node):
        self.condition(node["inner"][0])

    def on_IfStmt(self, node):
        inner = list(node["inner"])
        if node.get("hasInit"):
            inner.pop(0)
        if node.get("hasVar"):
            declared = inner.pop(0)["inner"][0]
            if declared["span"]:
                self.add(declared, "condition", f"never: {declared['name']}", declared["name"], "never")
        else:
            self.condition(inner[0])
        for child in inner[1:]:
            self.statement(child)

    def on_WhileStmt(self, node):
        if not node.get("hasVar"):
            self.condition(node["inner"][0], ("false",))
        self.statement(node["inner"][-1])

    def on_ForStmt(self, node):
        self.statement(node["inner"][-1])

    on_CXXForRangeStmt = on_ForStmt
    on_DefaultStmt = on_ForStmt

    def on_CaseStmt(self, node):
        self.statement(node["inner"][-1])

    def on_CompoundStmt(self, node):
        for child in node.get("inner", []):
            self.statement(child)

    def statement(self, node):
        kind = node.get("kind", "")
        is_expression = kind.endswith(("Expr", "Operator", "ExprWithCleanups"))
        is_jump = kind in ("BreakStmt", "ContinueStmt") or (kind == "ReturnStmt" and not node.get("inner"))
        if not node.get("span") or not (is_expression or is_jump) or kind in ("ConditionalOperator",):
            return
        end = self.source.index(";", node["span"][1]) + 1
        if self.source[node["span"][1]:end].strip() != ";":
            return
        whole = {"span": (node["span"][0], end)}
        self.add(whole, "statement", f"without {self.short(whole)}", "", "statement")

    def on_SwitchStmt(self, node):
        if node.get("hasInit") or node.get("hasVar"):
            return
        asked, body = node["inner"][0], node["inner"][-1]
        has_default = any(one["kind"] == "DefaultStmt" for one in body.get("inner", []))
        for case in body.get("inner", []):
            labels = []
            while case["kind"] == "CaseStmt":
                labels.append(case["inner"][0])
                case = case["inner"][-1]
            if case["kind"] in ("BreakStmt", "DefaultStmt") and not (has_default and case["kind"] == "BreakStmt"):
                continue  # without its name the same happens
            for label in labels:
                if label["span"] and asked["span"]:
                    self.add(asked, "case", f"without case {self.text(label)}", self.text(label), "case", label["span"][0])


def mutants_of(path, flags, root):
    """All mutants of a file, in the order of its lines, numbered from 0 and with their keys."""
    with open(f"{root}/{path}", encoding="latin-1", newline="") as file:
        source = file.read()
    parsed = path
    if path.endswith(".hpp"):  # a header is parsed alone
        flags = [*flags, "-x", "c++"]
    finder = Finder(path, parsed, source)
    trees = syntax_tree(parsed, flags)
    for tree in trees:
        finder.visit_places(tree)
    for tree in trees:
        finder.collect(tree)
    for tree in trees:
        finder.walk(tree)
    return source, sorted(finder.found.values(), key=lambda one: (one.at, one.begin, one.end, one.operator, one.text))
