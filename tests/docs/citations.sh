#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# citations.sh ROOT: fails if src, include, tests, config or docs cite a section, a row, a manual or a page that the
# repository does not have. It first makes sure that it would notice. What is a citation:
#   wire reference 1.5; section 4.10                 a section of docs/reference/profibus-dp.md
#   wire reference 6.4, C2; row P11; TEST(X, P11_…)  a row of its section 6.4
#   C-19; TEST(X, C19_…)                             a line of its section 10
#   TEST(X, F07_…)                                   a row of docs/internals/reliability.md: reliability.sh looks at them
#   EI-ASCII reference, section 3                    a section of docs/reference/drive-protocols.md
#   (also "EI-ASCII and Modbus reference" and "Modbus reference")
#   A-084, B-029a, X-48; an instance A084            a row of docs/reference/manual-coverage.md
#   HA389815                                         a manual that one of the three pages names
#   docs/guide/wiring.md, [text](wiring.md)          a page, by as much of its path as is cited
set -eu
root=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wire=docs/reference/profibus-dp.md
drive=docs/reference/drive-protocols.md
rows=docs/reference/manual-coverage.md

# ---- what there is: "kind name", one a line

between() { # FIRST LAST FILE: the lines between two that match
    sed -n "/$1/,/$2/p" "$3"
}
there() {
    sed -nE 's/^##+ ([0-9]+(\.[0-9]+)?)\.? .*/wire \1/p' "$wire"
    sed -nE 's/^## ([0-9]+)\. .*/drive \1/p' "$drive"
    between '^### 6\.4 ' '^### 6\.5 ' "$wire" | sed -nE 's/^\| ([A-Z][0-9]+) \|.*/transition \1/p'
    between '^## 10\. ' '^## 11\. ' "$wire" | sed -nE 's/^\| (C-[0-9][0-9]) \|.*/conformance \1/p'
    sed -nE 's/^\| ([A-DX]-[0-9]+[ab]?) \|.*/row \1/p' "$rows"
    { between '^## Sources' '^## 1\.' "$drive"; cat "$rows"; } | grep -oE 'HA[0-9]+[A-Z0-9]*' | sed 's/^/manual /'
    # A page is cited by its name and as much of its path as is needed.
    find . -name '*.md' ! -path './build/*' | awk '{ while (sub(/^[^\/]*\//, "")) print "page " $0 }'
}

# ---- what is cited: "file:line kind name", one a line

# A citation may go on in the next line, behind the marks of a comment: each line is read together with the one that
# follows it, and what begins in the first of the two counts. `last` is the line before them.
cat > "$scratch/cited.awk" <<'AWK'
function cite(kind, name) { print file ":" at " " kind " " name }

# The numbers at the start of text, as in "1.3, 1.5 and 11": each is a section. Behind them may stand ", C2".
function sections(kind, text,    name) {
    while (match(text, /^ *[0-9]+(\.[0-9]+)?/)) {
        name = substr(text, 1, RLENGTH)
        sub(/^ */, "", name)
        cite(kind, name)
        text = substr(text, RLENGTH + 1)
        if (kind == "wire" && match(text, /^, [A-Z][0-9]+/)) cite("transition", substr(text, 3, RLENGTH - 2))
        if (!match(text, /^(,| and| or| to) *[0-9]/)) return
        text = substr(text, RLENGTH)
    }
}

# Calls found(what matched, what follows) of a kind for each match that begins in the first line.
function each(kind, pattern,    text, from) {
    text = both
    from = 0
    while (match(text, pattern)) {
        start = from + RSTART
        if (start > length(first)) return
        matched = substr(text, RSTART, RLENGTH)
        before = last " " substr(both, 1, start - 1)
        from += RSTART + RLENGTH - 1
        text = substr(text, RSTART + RLENGTH)
        found(kind, text)
    }
}

function found(kind, after) {
    if (kind == "wire") sections("wire", after)
    else if (kind == "section") {
        # "reference, section" says which page; alone it is the page at hand, or the wire reference.
        if (before ~ /[Ww]ire reference[,:(]* *$/) sections("wire", after)
        else if (before ~ /(EI-ASCII|Modbus) reference[,:(]* *$/) sections("drive", after)
        else if (before ~ /[Rr]eference[,:(]* *\(?$/) cite("nameless", "reference")
        else sections(file ~ /drive-protocols\.md$/ ? "drive" : "wire", after)
    } else if (kind == "row") {
        if (before ~ /([A-Za-z0-9_-]|page )$/ || after ~ /^[A-Za-z0-9_]/) return
        cite(matched ~ /^C-[0-9][0-9]$/ ? "conformance" : "row", matched)
    } else if (kind == "transition") {
        if (before !~ /[A-Za-z]$/) { sub(/^rows? /, "", matched); cite(kind, matched) }
    } else if (kind == "test") {
        sub(/.*, */, "", matched)
        sub(/_$/, "", matched)
        if (matched ~ /^C[0-9][0-9]$/) cite("conformance", "C-" substr(matched, 2))
        else if (matched !~ /^F[0-9]/) cite("transition", matched)
    } else if (kind == "instance") {
        sub(/.*\( */, "", matched)
        cite("row", substr(matched, 1, 1) "-" substr(matched, 2))
    } else if (kind == "own") {
        gsub(/[^0-9.]/, "", matched)
        cite("wire", matched)
    } else if (kind == "manual") {
        if (before !~ /[A-Za-z0-9]$/) cite(kind, matched)
    } else {
        if (before ~ /:$/) return # an address of the web
        sub(/^(\.\.\/)+/, "", matched)
        sub(/^_?\/usr\/share\/doc\/dpslaved\//, "", matched) # where the package installs it
        cite("page", matched)
    }
}

function look(second) {
    both = first " " second
    if (both ~ /[Ww]ire reference/) each("wire", "[Ww]ire reference,? *")
    if (both ~ /[Ss]ections? [0-9]/) each("section", "[Ss]ections? ")
    if (file ~ /profibus-dp\.md$/) each("own", "\\((see )?[0-9]+\\.[0-9]+[,)]")
    if (first ~ /[ABCDX]-[0-9]/) each("row", "[ABCDX]-[0-9]+[ab]?")
    if (both ~ /rows? [A-Z][0-9]/) each("transition", "rows? [A-Z][0-9]+")
    if (first ~ /HA[0-9]/) each("manual", "HA[0-9][0-9][0-9][0-9][0-9][0-9]+[A-Z0-9]*")
    if (first ~ /\.md/) each("page", "[A-Za-z0-9_.\\/-]*[A-Za-z0-9_-]\\.md")
    if (first ~ /TEST/) {
        each("test", "TEST(_F|_P)?\\([A-Za-z0-9_]+, *[A-Z][0-9]+_")
        each("instance", "INSTANTIATE_TEST_SUITE_P\\( *[A-DX][0-9][0-9][0-9][ab]?")
    }
}

{
    line = $0
    sub(/^[ \t]*(\/\/\/?<?|#+)?[ \t]*/, "", line)
    if (at) look(FNR == 1 ? "" : line)
    last = FNR == 1 ? "" : first
    first = line
    file = FILENAME
    at = FNR
}
END { if (at) look("") }
AWK

# ---- the check: a sentence for each citation of something that is not there; nothing = all is right

cat > "$scratch/faults.awk" <<'AWK'
NR == FNR { there[$0]; next }
!(($2 " " $3) in there) {
    if ($2 == "wire") fault = wire " has no section " $3
    else if ($2 == "drive") fault = drive " has no section " $3
    else if ($2 == "transition") fault = wire ", section 6.4, has no row " $3
    else if ($2 == "conformance") fault = wire ", section 10, has no line " $3
    else if ($2 == "row") fault = rows " has no row " $3
    else if ($2 == "manual") fault = "no page says what " $3 " is"
    else if ($2 == "page") fault = "there is no page " $3
    else fault = "which reference? Write \"wire reference\" or \"EI-ASCII reference\""
    print $1 ": " fault
}
AWK
faults_of() ( # ROOT
    cd "$1"
    there > "$scratch/there"
    find README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md src include tests config docs -type f ! -path 'tests/docs/*.sh' ! -path 'tests/docs/*.py' ! -name '*.pcapng' ! -name '*.tar.gz' |
        LC_ALL=C sort | xargs awk -f "$scratch/cited.awk" | uniq > "$scratch/cited"
    awk -v wire="$wire" -v drive="$drive" -v rows="$rows" -f "$scratch/faults.awk" "$scratch/there" "$scratch/cited"
)

# ---- would it notice?

mkdir -p "$scratch/tree/src" "$scratch/tree/docs/reference" "$scratch/tree/docs/guide"
(cd "$scratch/tree" && mkdir include tests config && touch README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md docs/guide/wiring.md)
cat > "$scratch/tree/$wire" <<'END'
## 1. Physical layer
### 1.5 What a receiver tolerates (1.5), (see 1.9)
### 4.10 Global_Control
### 6.4 Transition table
| C2 | WCFG | a row of 6.4 |
| P11 | DXCH | a row of 6.4 |
### 6.5 Disagreements
| P13 | DXCH | no row of 6.4 |
## 10. Certification
| C-19 | a line of the list |
## 11. Linux
| C-31 | no line of the list |
END
cat > "$scratch/tree/$drive" <<'END'
## Sources
| H389 | HA389815 |
## 1. Framing
See section 3 and section 1.5.
## 3. Mnemonics
END
cat > "$scratch/tree/$rows" <<'END'
| A-084 | a row |
| B-029a | a row |
| C-019 | a row |
| X-48 | a row |
END
cat > "$scratch/tree/src/right.cpp" <<'END'
/// Source: wire reference 1, 1.5 and 11; row P11. Also wire
/// reference 6.4, C2 and Wire reference, section 4.10.
// EI-ASCII and Modbus reference, sections 1 to 3; EI-ASCII
// reference, section 3. Section 4.10. On a wire 3.5 characters; HA389815 ch. 6; C-19, C-019, X-48, B-029a.
TEST(Rows, P11_Is) TEST_F(Rows, C19_Is) INSTANTIATE_TEST_SUITE_P(A084, ...) docs/guide/wiring.md, http://a.b/c.md
END
cat > "$scratch/tree/src/wrong.cpp" <<'END'
/// wire reference 4.13
/// wire reference 1.5, 1.8 and 15; and once more: wire
/// reference 3.4; section 4.14, and wire reference 6.4, C9
/// EI-ASCII reference, section 14; EI-ASCII and Modbus
/// reference, sections 1 to 99
/// the reference, section 5
/// rows P13, C-31, A-058, X-60 and HA999999
TEST_F(Rows, P14_Is) TEST(Rows, C32_Is)
    INSTANTIATE_TEST_SUITE_P(A059, Is)
/// docs/wire.md
END
cat > "$scratch/expected" <<END
$wire:2: $wire has no section 1.9
$wire:12: $wire, section 10, has no line C-31
$drive:4: $drive has no section 1.5
src/wrong.cpp:1: $wire has no section 4.13
src/wrong.cpp:2: $wire has no section 1.8
src/wrong.cpp:2: $wire has no section 15
src/wrong.cpp:2: $wire has no section 3.4
src/wrong.cpp:3: $wire has no section 4.14
src/wrong.cpp:3: $wire, section 6.4, has no row C9
src/wrong.cpp:4: $drive has no section 14
src/wrong.cpp:5: $drive has no section 99
src/wrong.cpp:6: which reference? Write "wire reference" or "EI-ASCII reference"
src/wrong.cpp:7: $wire, section 6.4, has no row P13
src/wrong.cpp:7: $wire, section 10, has no line C-31
src/wrong.cpp:7: $rows has no row A-058
src/wrong.cpp:7: $rows has no row X-60
src/wrong.cpp:7: no page says what HA999999 is
src/wrong.cpp:8: $wire, section 6.4, has no row P14
src/wrong.cpp:8: $wire, section 10, has no line C-32
src/wrong.cpp:9: $rows has no row A-059
src/wrong.cpp:10: there is no page docs/wire.md
END
faults_of "$scratch/tree" | LC_ALL=C sort > "$scratch/noticed"
LC_ALL=C sort "$scratch/expected" > "$scratch/sentences"
if ! diff "$scratch/sentences" "$scratch/noticed" > "$scratch/blind"; then
    echo "this check is blind (<) or sees what is not there (>):" >&2
    grep '^[<>]' "$scratch/blind" >&2
    exit 2
fi

faults_of "$root" > "$scratch/faults"
if [ -s "$scratch/faults" ]; then
    cat "$scratch/faults" >&2
    exit 1
fi
