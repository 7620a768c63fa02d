# SPDX-License-Identifier: Apache-2.0
# Shared by the machine tests, on the side of the guest: tests as sentences, and patience.
#
#   source /host/guest.sh
#   prove "given …, when …, then …" a_function      one test; goes on after a failure
#   require "given …, when …, then …" a_function    one test; without it nothing further makes sense
#   subject FILE                                    the tests in it
#   finish                                          exit status 0 if all have passed
#
# Results go to standard output; what each test did (set -x) goes to the file $trace, and its end to the results when
# the test has failed. A test is a function in which every command counts, as with set -e: so never write `prove …` in
# an `if` or before `||`, where bash ignores set -e. A pipe fails with any of its programs: give `grep -q`, which does
# not read to the end, its text by <<<.
# shellcheck shell=bash
set -uo pipefail

trace=${trace:-/host/trace.log}
patience=${patience:-20} # seconds for what normally takes a moment: the machine may be slow and loaded
tests_run=0
tests_failed=0

now_ms() { echo $(($(date +%s%N) / 1000000)); }

prove() {
    local sentence=$1 began from status
    shift
    began=$(now_ms)
    tests_run=$((tests_run + 1))
    printf '\n==== %s\n' "$sentence" >>"$trace"
    from=$(($(wc -l <"$trace") + 1))
    (
        set -eE
        exec >>"$trace" 2>&1
        set -x
        "$@"
    )
    status=$?
    if [ "$status" -eq 0 ]; then
        printf 'ok - %s (%d ms)\n' "$sentence" $(($(now_ms) - began))
    else
        tests_failed=$((tests_failed + 1))
        printf 'not ok - %s (%d ms)\n' "$sentence" $(($(now_ms) - began))
        tail -n "+$from" "$trace" | tail -n 12 | sed 's/^/#   /'
        ! declare -F on_failure >/dev/null || on_failure | sed 's/^/#   /'
    fi
    return "$status"
}

require() {
    prove "$@" # not in front of ||: there bash ignores set -e, in the test as well
    # shellcheck disable=SC2181
    [ $? -eq 0 ] || { echo "# nothing further can be shown without this" && finish; }
}

# A file that is not there or cannot be parsed has no tests: that is a failure, not silence.
subject() {
    if bash -n "$1"; then
        # shellcheck source=/dev/null
        source "$1"
    else
        tests_failed=$((tests_failed + 1))
        printf 'not ok - %s cannot be read\n' "$1"
    fi
}

finish() {
    printf '1..%d\n' "$tests_run"
    if [ "$tests_failed" -ne 0 ]; then
        printf '# %d of %d failed\n' "$tests_failed" "$tests_run"
        exit 1
    fi
    exit 0
}

# Fails the test with a sentence.
fail() {
    echo "FAILED: $*"
    return 1
}

# expect_equal WHAT GOT WANTED
expect_equal() { [ "$2" = "$3" ] || fail "$1 is '$2', not '$3'"; }

# expect_other WHAT GOT UNWANTED
expect_other() { [ "$2" != "$3" ] || fail "$1 is still '$2'"; }

# expect_text TEXT WANTED: WANTED (a fixed string) is somewhere in TEXT.
expect_text() { grep -q -F -e "$2" <<<"$1" || fail "'$2' is not in: $1"; }

# expect_no_text TEXT UNWANTED
expect_no_text() { ! grep -q -F -e "$2" <<<"$1" || fail "'$2' is in: $1"; }

# expect_status WANTED COMMAND...: the exit status of the command; its output (both streams) goes into $output.
# shellcheck disable=SC2034 # output is for the test
expect_status() {
    local wanted=$1 got=0
    shift
    output=$("$@" 2>&1) || got=$?
    printf '%s\n' "$output"
    [ "$got" -eq "$wanted" ] || fail "'$*' ended with $got, not $wanted"
}

# eventually COMMAND...: asks again and again, at most $patience seconds.
eventually() {
    local -
    set +x # what is asked again and again is of no interest in the trace
    local end=$((SECONDS + patience))
    until { "$@"; } >/dev/null 2>&1; do
        [ "$SECONDS" -lt "$end" ] || fail "'$*' did not come true within $patience s" || return 1
        sleep 0.1
    done
}
