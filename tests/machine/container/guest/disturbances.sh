# SPDX-License-Identifier: Apache-2.0
# What the service manager is for: a program that hangs, is killed, or is stopped.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

# Stops one thread of a process and nothing else, as a debugger does, until it is gone or 60 s are over.
stall_thread() {
    perl -e '
        my ($thread) = @ARGV;
        my ($ptrace, $seize, $interrupt, $wait_all) =
            ((`uname -m` =~ /^aarch64/ ? 117 : 101), 0x4206, 0x4207, 0x40000000);
        syscall($ptrace, $seize, $thread + 0, 0, 0) == 0 or die "PTRACE_SEIZE: $!\n";
        syscall($ptrace, $interrupt, $thread + 0, 0, 0) == 0 or die "PTRACE_INTERRUPT: $!\n";
        alarm 60;
        while (waitpid($thread, $wait_all) > 0) { print "stopped\n" if ($? & 0xff) == 0x7f; }' "$1"
}
is_stopped() { grep -q '^State:.*tracing stop' "/proc/$1/task/$2/status"; }

# How often the drive's output was set to zero.
zeroes() { grep -c -F "tag 56 written 0.00" /host/drive1.log; }
zeroes_more_than() { [ "$(zeroes)" -gt "$1" ]; }

# of_thread PID: the thread of this process that stands still.
main_thread() { echo "$1"; }
is_woken_by_watchdog() {
    local of_thread=$1 pid thread before zeroes
    pid=$(main_pid)
    thread=$("$of_thread" "$pid")
    before=$(restarts)
    zeroes=$(zeroes)
    mark
    stall_thread "$thread" &
    eventually is_stopped "$pid" "$thread"
    [ "$thread" = "$pid" ] || expect_no_text "$(grep '^State' "/proc/$pid/task/$pid/status")" "stop" # main lives
    eventually zeroes_more_than "$zeroes"
    expect_equal "process at the safe state of the drive" "$(main_pid)" "$pid"
    expect_equal "restarts until then" "$(restarts)" "$before"
    eventually restarted_since "$before"
    eventually has_said "Watchdog timeout"
    eventually exchanging
    expect_other "process" "$(main_pid)" "$pid"
    wait
}
prove "given a bus thread that stands still alone, when the watchdog's time is over, then the drive was safe before, and a new one exchanges data" \
    is_woken_by_watchdog bus_thread
prove "given a main thread that stands still alone, when the watchdog's time is over, then the drive was safe before, and a new one exchanges data" \
    is_woken_by_watchdog main_thread

# The port of a hanging thread cannot be taken away: the program ends without it, and the drive is not left running.
stops_without_its_bus_thread() {
    local pid thread zeroes
    pid=$(main_pid)
    thread=$(bus_thread "$pid")
    zeroes=$(zeroes)
    mark
    stall_thread "$thread" &
    eventually is_stopped "$pid" "$thread"
    systemctl stop dpslaved
    eventually has_said "the bus thread hangs"
    eventually zeroes_more_than "$zeroes"
    [ -z "$(pgrep -x dpslaved)" ] || fail "a process is left"
    wait
    systemctl start dpslaved
    eventually exchanging
}
prove "given a bus thread that hangs, when the service is stopped, then it ends in time and the drive's outputs are zero" \
    stops_without_its_bus_thread

survives_kill() {
    local pid before
    pid=$(main_pid)
    before=$(restarts)
    kill -9 "$pid"
    eventually restarted_since "$before"
    eventually exchanging
    expect_other "process" "$(main_pid)" "$pid"
}
prove "given Data_Exchange, when the daemon is killed with -9, then it is back in Data_Exchange" survives_kill

stops() {
    local zeroes
    zeroes=$(zeroes)
    mark
    expect_status 0 systemctl stop dpslaved
    expect_equal "state" "$(property dpslaved ActiveState)" inactive
    expect_equal "result" "$(property dpslaved Result)" success
    expect_equal "exit status" "$(property dpslaved ExecMainStatus)" 0
    eventually has_said "leaving the bus"
    [ ! -e /run/dpslaved ] || fail "/run/dpslaved is still there"
    eventually zeroes_more_than "$zeroes"
    expect_status 3 dpctl status
    systemctl start dpslaved
    eventually exchanging
}
prove "given Data_Exchange, when the service is stopped, then it ends with 0 and the drive's outputs are zero" stops
