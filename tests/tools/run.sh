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
names=$(tools/run --help | sed -nE 's/^  ([a-z]+) .* \([0-9]+ min\)$/\1/p')
[ "$(wc -w <<<"$names")" -ge 7 ] || fail "tools/run --help lists only: $names"
for words in "" nothing soa; do
    # shellcheck disable=SC2086 # no word at all is one of the cases
    tools/run $words >/dev/null 2>&1
    [ $? = 2 ] || fail "tools/run $words does not end with 2"
done
for name in $(grep -ohE '`tools/run [a-z]+' CONTRIBUTING.md tests/README.md | cut -d' ' -f2); do
    grep -qxF "$name" <<<"$names" || fail "tools/run has no $name"
done
for file in $(grep -ohE '`(tools|\.ci)/[a-z-]+' CONTRIBUTING.md tests/README.md | tr -d '`' | sort -u); do
    [ -x "$file" ] || fail "there is no command $file"
done
exit $wrong
