#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: second_tries.sh SOURCE
# Tests that need their second try are named, and no more than two of them pass. The judge is a real ctest.
set -u
# shellcheck source=../../tools/lib.sh
source "$1/tools/lib.sh"
set +e

dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
wrong=0
expect() { # WHAT EXPECTED GOT
    [ "$2" = "$3" ] && return
    printf '%s: expected "%s", got "%s"\n' "$@"
    wrong=1
}

# Fails at its first call, in a way of its own; passes at the second.
once() { # NAME MARK COMMAND
    printf 'add_test(%s /bin/sh -c "[ -e %s ] || { touch %s; %s; }")\n' "$1" "$2" "$2" "$3"
}
{
    echo 'add_test(system.Good.Passes /bin/true)'
    once system.Flaky.FailsOnce/0 failed 'exit 1'
    once system.Crash.CrashesOnce crashed 'kill -SEGV \$\$'
    once system.Slow.IsTooSlowOnce slept 'sleep 5'
    echo 'set_tests_properties(system.Slow.IsTooSlowOnce PROPERTIES TIMEOUT 1)'
    echo 'add_test(system.Bad.NeverPasses /bin/false)'
    echo 'add_test(system.Skip.IsSkipped /bin/sh -c "exit 77")'
    echo 'set_tests_properties(system.Skip.IsSkipped PROPERTIES SKIP_RETURN_CODE 77)'
} >CTestTestfile.cmake
ctest --parallel 2 --output-on-failure --repeat until-pass:2 >log 2>&1
expect "tests that needed their second try" \
    "system.Crash.CrashesOnce system.Flaky.FailsOnce/0 system.Slow.IsTooSlowOnce" \
    "$(second_tries <log | sort | xargs)"

judge() { # NAME...: says what judge_second_tries prints and how it ends
    printf '%s\n' "$@" | sed '/^$/d' >names
    (judge_second_tries names) 2>&1 | sed 's/\x1b\[[0-9]*m//g' | sed '/^$/d' | xargs
    return "${PIPESTATUS[0]}"
}
expect "without a second try" "" "$(judge)"
said=$(judge one two)
expect "end with two" 0 $?
expect "words with two" "==> Needed a second try: 2 one two" "$said"
said=$(judge one two three)
expect "end with three" 1 $?
case $said in
    *"one two three"*"more than 2 tests"*) ;;
    *) expect "words with three" "one two three ... more than 2 tests" "$said" ;;
esac
exit $wrong
