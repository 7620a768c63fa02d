# SPDX-License-Identifier: Apache-2.0
# Who may do what, asked of the service in its real sandbox.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

useradd --groups dpslaved mechanic
useradd visitor
as() { runuser -u "$1" -- "${@:2}"; }

operator_operates() {
    as mechanic dpctl status
    expect_status 0 as mechanic dpctl write --station unwinder 62 95.5
    eventually drive_has_said 1 "tag 62 written 95.5"
}
prove "given a user in the group dpslaved, when a tag is written, then the drive has it" operator_operates

visitor_looks() {
    local command
    for command in status show io diag counters; do expect_status 0 as visitor dpctl "$command"; done
    expect_status 0 as visitor dpctl status unwinder --wait 0 --quiet
    expect_status 5 as visitor dpctl write --station unwinder 62 33.3
    expect_text "$output" "only root and members of the group 'dpslaved' may do this"
    ! drive_has_said 1 "tag 62 written 33.3" || fail "the drive was written"
}
prove "given a user outside the group, when the state is read then it is shown, and a write is refused with the reason" visitor_looks

visitor_reloads_not() {
    local pid
    pid=$(main_pid)
    expect_status 5 as visitor dpctl reload
    expect_text "$output" "only root and members of the group 'dpslaved' may do this"
    expect_status 0 as mechanic dpctl reload
    expect_equal "process" "$(main_pid)" "$pid"
    exchanging
}
prove "given the same two, when they reload, then only the one of the group may" visitor_reloads_not

visitor_kills_not() {
    ! as visitor kill "$(main_pid)" || fail "a visitor could kill the daemon"
    ! as visitor touch /run/dpslaved/x || fail "a visitor could write to /run/dpslaved"
    ! as visitor rm -f /run/dpslaved/control.sock || fail "a visitor could remove the socket"
    exchanging
}
prove "given a user outside the group, when the process or its socket is attacked, then the system refuses" visitor_kills_not
