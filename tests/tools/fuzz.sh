#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: fuzz.sh SOURCE
# tools/run fuzz fails with a crash, a timeout, a leak and a target that did not run. It adds up what ran, and goes on until the
# goal. Programs stand for the targets that end as libFuzzer does.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/targets"
wrong=0
expect() { # WHAT EXPECTED GOT
    [ "$2" = "$3" ] && return
    printf '%s: expected "%s", got "%s"\n' "$@"
    wrong=1
}

# target NAME COMMANDS: $artifacts is what names of findings begin with.
target() {
    {
        # shellcheck disable=SC2016 # it is the program that takes them
        printf '#!/bin/sh\nfor word; do case $word in -artifact_prefix=*) artifacts=${word#*=} ;; esac; done\n'
        printf '%s\n' "$2"
    } >"$dir/targets/fuzz_$1"
    chmod +x "$dir/targets/fuzz_$1"
}
ran() { # EXECUTIONS
    printf 'echo "#9 NEW    cov: 42 ft: 7 corp: 3/9b"\necho "Done %s runs in 2 second(s)"\necho "stat::number_of_executed_units: %s"' "$1" "$1"
}
fuzz() { # WORD...: what tools/run fuzz prints, without colours; its status
    "$source/tests/fuzz/run" --folder "$dir" --tally "$dir/tally" "$@" 2>&1 | sed 's/\x1b\[[0-9]*m//g'
    return "${PIPESTATUS[0]}"
}
source=$1

target dp "$(ran 100)"
said=$(fuzz --target dp --record)
expect "a target that ran" 0 $?
expect "its row" "| dp | 100 | 42 |" "$(echo "$said" | grep -o '| dp | 100 | 42 |')"
expect "its row of the tally" "$(date +%F);dp;100;2;42;0" "$(tail -n1 "$dir/tally")"

ends() { # WHAT COMMANDS WORDS: the run fails and says so, and the good one beside it changes nothing
    target toml "$2"
    said=$(fuzz --target dp --target toml)
    expect "$1" 1 $?
    case $said in *"$3"*) ;; *) expect "words of $1" "$3" "$said" ;; esac
}
# shellcheck disable=SC2016
ends "a crash" 'touch ${artifacts}crash-1; echo "BROKEN: a rule"; '"$(ran 5)"'; exit 77' "toml: BROKEN: a rule
Repeat it with: $dir/targets/fuzz_toml $dir/findings/toml/crash-1"
# shellcheck disable=SC2016
ends "a timeout" 'touch ${artifacts}timeout-1; echo "ERROR: libFuzzer: timeout after 20 seconds"; '"$(ran 5)"'; exit 70' "toml: ERROR: libFuzzer: timeout"
ends "a fault at the end" "$(ran 5); exit 1" "toml did not run to its end"
ends "a run that was killed" 'kill -KILL $$' "toml did not run to its end"
ends "a run without executions" "$(ran 0)" "toml did not run to its end"
rm "$dir/targets/fuzz_toml"
said=$(fuzz --target toml)
expect "a target that is missing" 1 $?

# The goal: what was run before counts, each target gets what it lacks, then those of the wire get the rest.
for name in fdl dp ei_ascii modbus; do target $name "$(ran 10000000)"; done
for name in gsd varlink toml tag_table pcapng trace; do target $name "$(ran 1000000)"; done
printf 'date;target;executions;seconds;edges;findings\n2026-01-01;fdl;50000000;9000;1;0\n' >"$dir/tally"
fuzz --goal >/dev/null
expect "the way to the goal" 0 $?
executions() { awk -F';' -v name="$1" '$2 == name { sum += $3 } END { print sum + 0 }' "$dir/tally"; }
expect "executions of fdl, which had enough" 50000000 "$(executions fdl)"
for name in gsd varlink toml tag_table pcapng trace; do expect "executions of $name" 1000000 "$(executions $name)"; done
expect "executions of dp, ei_ascii and modbus" 50000000 $(($(executions dp) + $(executions ei_ascii) + $(executions modbus)))
expect "the sum" "| together | 106000000 | | 0 |" "$(fuzz --sum | tail -n1)"

# A finding ends one target, not the way of the others.
# shellcheck disable=SC2016
target toml 'touch ${artifacts}crash-1; '"$(ran 7)"'; exit 77'
rm "$dir/tally"
fuzz --goal --target toml --target gsd >/dev/null
expect "the way to the goal with a finding" 1 $?
expect "the finding" "| toml | 7 | 42 | 1 |" "$(fuzz --sum | grep toml)"
expect "the other target" "| gsd | 1000000 | 42 | 0 |" "$(fuzz --sum | grep gsd)"
exit $wrong
