#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: gate.sh SOURCE
# Each unit test of tools/check with a thread, a process or a terminal stands in tests/gate.txt, with the event that it waits for.
set -u
cd "$1" || exit 1
wrong=0
fail() {
    printf '%s\n' "$*"
    wrong=1
}
mapfile -t rows < <(grep -vE '^(#|$)' tests/gate.txt)
[ ${#rows[@]} -gt 40 ] || fail "tests/gate.txt has only ${#rows[@]} rows"
for row in "${rows[@]}"; do
    [[ $row =~ ^(smoke|unit)\ [a-z_]+\ [^\ ]+\ \|\ [^\ ].+$ ]] || fail "no row: $row"
done
listed=$(printf '%s\n' "${rows[@]}" | sed -nE 's/^unit ([a-z_]+) ([^ ]+) .*/\2/p' | tr ':' '\n' | sed -E 's/^\*//; s/\.\*$//')
# The folders whose programs tools/check runs, without those of the real programs.
sources=$(find tests/base tests/trace tests/io tests/modbus tests/control tests/app tests/fdl tests/dp tests/drive tests/gsd tests/input \
    tests/profile tests/pcapng tests/config tests/report tests/tec tests/led tests/arguments tests/configurator tests/dpsim tests/drive_line \
    tests/model -name '*_test.cpp')
for file in $(grep -lE 'std::(thread|jthread|async)\b|\bPty\b|::fork\(|EXPECT_(EXIT|DEATH)|OnABus|\bBench line|socketpair\(' $sources); do
    for suite in $(grep -oE '^TEST(_F|_P)?\([A-Za-z0-9]+' "$file" | cut -d'(' -f2 | sort -u); do
        grep -qxF "$suite" <<<"$listed" || fail "$file: $suite has a thread, a process or a terminal. Say in tests/gate.txt what it waits for"
    done
done
exit $wrong
