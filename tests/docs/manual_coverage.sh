#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# manual_coverage.sh ROOT: fails if a row of docs/reference/manual-coverage.md is missing, doubled or without a proof, or if a
# proof names a test or a file that does not exist. In docs/internals/security.md each row that is met names a test. It first makes sure that it would
# notice.
set -eu
cd "$1"
table=docs/reference/manual-coverage.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# ---- what has to be there

span() { # LETTER FIRST LAST
    seq -f "$1-%03g" "$2" "$3"
}
{
    span A 1 12; span A 20 27; span A 30 38; span A 40 57; span A 60 72; span A 80 89; span A 100 115
    span B 1 14; span B 20 29; echo B-029a; span B 30 35; span B 40 55; span B 60 73; span B 80 94
    span C 1 26; span C 30 48; span C 60 71; span C 100 129
    span D 1 10
    seq -f 'X-%02g' 1 56; echo X-58; echo X-12a; echo X-12b
} | LC_ALL=C sort > "$scratch/ids"

# Tests by the names of ctest. gtest: "program Suite.Test" of TEST and TEST_F, "program Suite.Test P" of TEST_P,
# "program Instance/Suite" of its instances. Others: the name itself.
for list in tests/*/CMakeLists.txt; do
    folder=${list%/*}
    sed 's/#.*//' "$list" | tr '\n' ' ' | grep -oE '(dpslave_test|dpslave_system_test)\([^)]*' | while read -r call; do
        kind=${call%%(*}
        call=${call#*(}
        program=${call%% *}
        [ "$kind" = dpslave_test ] || program=system
        for source in $(printf '%s\n' "$call" | grep -oE '[A-Za-z0-9_./]+\.cpp'); do
            # A name may stand on the next line.
            tr '\n' ' ' < "$folder/$source" |
                grep -oE '\b(TEST|TEST_F|TEST_P|INSTANTIATE_TEST_SUITE_P)\( *[A-Za-z0-9_]+, *[A-Za-z0-9_]+ *[,)]' |
                sed -nE -e "s/^TEST(_F)?\( *([A-Za-z0-9_]+), *([A-Za-z0-9_]+).*/$program \2.\3/p" \
                    -e "s/^TEST_P\( *([A-Za-z0-9_]+), *([A-Za-z0-9_]+).*/$program \1.\2 P/p" \
                    -e "s/^INST[A-Z_]*\( *([A-Za-z0-9_]+), *([A-Za-z0-9_]+).*/$program \1\/\2/p" || true
        done
    done || true
    sed 's/#.*//' "$list" | tr '\n' ' ' | grep -oE 'add_test\( *NAME [A-Za-z0-9_.]+' | sed 's/.* //' || true
done | sort -u > "$scratch/tests"
# tests/page: "page Class.test_of_it".
for source in tests/page/test_*.py; do
    sed -nE -e 's/^class ([A-Za-z0-9_]+)\(.*/\1/p' -e 's/^    def (test_[A-Za-z0-9_]+)\(.*/.\1/p' "$source" |
        awk '/^\./ {print "page " class $0; next} {class = $0}'
done >> "$scratch/tests"
# tests/purity names its own in a loop.
for room in fdl dp base led; do echo "purity.symbols_of_$room"; done >> "$scratch/tests"

# unknown: of the lines "ROW NAME" those whose name, as in fdl.Instance/Suite.Test/Case or dp.Suite.Test, is no test.
unknown() {
    awk -v tests="$scratch/tests" '
        BEGIN { while ((getline line < tests) > 0) known[line] = 1 }
        function has_case(program, word) {
            if (word == "*") return 1
            return system("grep -rqF \"\\\"" word "\\\"\" tests/" program) == 0
        }
        function is_test(name,    program, rest, suite, test, instance_case) {
            if (name in known) return 1
            program = name; sub(/\..*/, "", program)
            rest = substr(name, length(program) + 2)
            if (rest !~ /\//) return (program " " rest) in known
            if (rest !~ /\/.*\..*\//) return 0
            suite = rest; sub(/\..*/, "", suite)
            test = substr(rest, length(suite) + 2)
            instance_case = test; sub(/^[^\/]*\//, "", instance_case)
            sub(/\/.*/, "", test)
            return (program " " substr(suite, index(suite, "/") + 1) "." test " P") in known &&
                   (program " " suite) in known && has_case(program, instance_case)
        }
        {
            name = substr($0, index($0, " ") + 1)
            if (!(name in judged)) judged[name] = is_test(name)
            if (!judged[name]) print
        }'
}

# ---- the check: sentences about what is wrong with a table; nothing = it is right

faults_of() { # TABLE
    grep -oE '^\| [A-DX]-[0-9]+[ab]? \|' "$1" | tr -d '| ' | LC_ALL=C sort > "$scratch/rows"
    LC_ALL=C comm -23 "$scratch/ids" "$scratch/rows" | sed 's/$/: the row is missing/'
    uniq -d "$scratch/rows" | sed 's/$/: the row stands more than once/'
    uniq "$scratch/rows" | LC_ALL=C comm -13 "$scratch/ids" - | sed 's/$/: there is no such row/'
    awk -F '|' '/^\| [A-DX]-[0-9]/ {
        gsub(/ /, "", $2)
        proof = $4
        gsub(/^ +| +$/, "", proof)
        if (NF != 5) print $2 ": the row has " NF - 2 " columns, not 3"
        else if ($3 ~ /^ *$/) print $2 ": the promise is empty"
        else if (proof !~ /^not yet(: .+)?$/ && proof !~ /`/) print $2 ": neither a proof nor \"not yet\": " proof
    }' "$1"
    # "*open:*" and what follows is a gap in words, not a proof.
    grep -E '^\| [A-DX]-[0-9]' "$1" | sed -E 's/; \*open:\*.*//' | awk -F '|' '{
        gsub(/ /, "", $2)
        while (match($4, /`[^`]*`/)) {
            print $2, substr($4, RSTART + 1, RLENGTH - 2)
            $4 = substr($4, RSTART + RLENGTH)
        }
    }' | unknown | while read -r row name; do
        [ -f "$name" ] || echo "$row: there is neither a test nor a file $name"
    done
}

# ---- would it notice?

cat > "$scratch/damages" <<'END'
/^\| A-044 /d
/^\| D-003 /p
s/^\| A-057 \|/| A-058 |/
s/^(\| A-050 \|.*\|)[^|]*\|$/\1 soon |/
s/^\| A-051 \|/& x |/
/^\| A-054 /s/`dp\.[^`]*`/`dp.OptionBoard.No`/
/^\| A-053 /s/`dp\.OptionBoard\./`fdl.OptionBoard./
/^\| A-084 /s/Manual\/\*/Manual\/No/
/^\| A-010 /s/HA389815Chapter9/No/
/^\| A-012 /s/wiring\.md/wire.md/
/^\| C-037 /s/test_adds_by_drag_and_drop/test_no/
END
cat > "$scratch/sentences" <<'END'
A-044: the row is missing
A-057: the row is missing
D-003: the row stands more than once
A-058: there is no such row
A-050: neither a proof nor "not yet": soon
A-051: the row has 4 columns, not 3
A-054: there is neither a test nor a file dp.OptionBoard.No
A-053: there is neither a test nor a file fdl.OptionBoard.RefusesFewerIdentifiersThanTags
A-084: there is neither a test nor a file led.HA389815Chapter9/OptionBoardLeds.ShowTheRowOfTheManual/No
A-010: there is neither a test nor a file led.No/OptionBoardLeds.ShowTheRowOfTheManual/*
A-012: there is neither a test nor a file docs/guide/wire.md
C-037: there is neither a test nor a file page.Lists.test_no
END
sed -E -f "$scratch/damages" "$table" > "$scratch/damaged.md"
faults_of "$scratch/damaged.md" > "$scratch/noticed"
if grep -vxF -f "$scratch/noticed" "$scratch/sentences" > "$scratch/blind"; then
    sed 's/^/this check is blind, it did not notice: /' "$scratch/blind" >&2
    exit 2
fi

faults_of "$table" > "$scratch/faults"
if [ -s "$scratch/faults" ]; then
    sed "s|^|$table: |" "$scratch/faults" >&2
    exit 1
fi

# ---- the proofs of the other table

test_name='`([a-z_]+\.[A-Z][A-Za-z0-9]*\.[A-Za-z0-9_]+|tests/[a-z_/.]+)`'
unproven() { # TABLE
    grep -E '^\| [A-Z]+ [0-9]+\.[0-9]+[^|]*\| met \|' "$1" | grep -vE "$test_name" | sed -E 's/^\| ([A-Z0-9. ]+) .*/\1: it is met, and no test is named/'
    grep -oE "$test_name" "$1" | tr -d '`' | sed 's/^/- /' | unknown | while read -r _ name; do
        [ -f "$name" ] || echo "there is neither a test nor a file $name"
    done
}
table=docs/internals/security.md
sed -E -e 's/system\.Attack\.From/system.Attack.No/' -e 's/^(\| CR 3\.8 .*) Test `.*` \|$/\1 |/' "$table" > "$scratch/damaged.md"
[ "$(unproven "$scratch/damaged.md" | wc -l)" -eq 2 ] || { echo "this check is blind to a test that is not there, or to a row without one" >&2 && exit 2; }
unproven "$table" > "$scratch/faults"
if [ -s "$scratch/faults" ]; then
    sed "s|^|$table: |" "$scratch/faults" >&2
    exit 1
fi
