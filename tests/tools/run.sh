#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: run.sh SOURCE
# tools/run lists its table and refuses another name. What CONTRIBUTING.md and tests/README.md tell a person to run is there.
set -u
cd "$1" || exit 1
wrong=0
fail() { # WORDS
    printf '%s\n' "$*"
    wrong=1
}
names=$(tools/run | sed -nE 's/^([a-z0-9-]+) +[0-9]+ min .*/\1/p')
[ "$(wc -w <<<"$names")" -ge 20 ] || fail "tools/run lists only: $names"
for words in nothing soa "model faults nothing" "--changed no-such-commit"; do
    # shellcheck disable=SC2086 # several words
    tools/run $words >/dev/null 2>&1 </dev/null && fail "tools/run $words does not fail"
done
for name in $(grep -ohE '`tools/run [a-z0-9-]+' CONTRIBUTING.md tests/README.md docs -r | cut -d' ' -f2); do
    [[ $name == --* ]] || grep -qxF -e "$name" <<<"$names" || fail "tools/run has no $name"
done
diff <(tools/run --document) <(grep -E '^\| `tools/run ' CONTRIBUTING.md) || fail "the table of CONTRIBUTING.md is not that of tools/run --document"
# Each row judges paths that exist, and its command is there.
files=$(find . -name .git -prune -o -path ./build -prune -o -type f -printf '%P\n')
while IFS=$'\t' read -r name paths; do
    for path in $paths; do
        grep -qE "^$path" <<<"$files" || fail "$name: nothing in the tree is $path"
    done
    grep -qE "^row_${name//-/_}\(\) " tools/run || fail "tools/run has no command for $name"
done < <(sed -n "/^table='/,/^'/p" tools/run | sed -nE "s/^([a-z0-9-]+) \| .* \| ([^|].*)$/\1\t\2/p")
for file in $(grep -ohE '`(tools|\.ci)/[a-z-]+' CONTRIBUTING.md tests/README.md | tr -d '`' | sort -u); do
    [ -x "$file" ] || fail "there is no command $file"
done
exit $wrong
