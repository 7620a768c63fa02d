# SPDX-License-Identifier: Apache-2.0
# Starts that come to nothing: a faulty configuration, a wrong option, a port that is not there yet.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

is_not_restarted() { # STATUS
    eventually is dpslaved ActiveState failed
    expect_equal "exit status" "$(property dpslaved ExecMainStatus)" "$1"
    sleep 0.5
    expect_equal "state, in which a restart would be waited for" "$(property dpslaved SubState)" failed
    expect_equal "restarts" "$(restarts)" 0
    systemctl reset-failed dpslaved
}

refuses_faults() {
    two_stations | sed 's/address = 5/address = 500/' >"$config"
    mark
    expect_status 1 systemctl start dpslaved
    eventually has_said "$config:$(grep -n 'address = 500' "$config" | cut -d: -f1):"
    is_not_restarted 1
}
prove "given a faulty configuration, when the service starts, then the log has file and line, and it is not restarted" \
    refuses_faults

refuses_usage() {
    two_stations >"$config"
    drop_in dpslaved.service wrong $'[Service]\nExecStart=\nExecStart=/usr/bin/dpslaved --no-such-option'
    expect_status 1 systemctl start dpslaved
    is_not_restarted 2
}
prove "given a wrong option in the unit, when the service starts, then it fails with 2 and is not restarted" refuses_usage
no_drop_in dpslaved.service wrong

waits_for_port() {
    local pid
    two_stations | sed 's,/dev/ttyPB1,/dev/ttyLATE,' >"$config"
    mark
    expect_status 0 systemctl start dpslaved
    pid=$(main_pid)
    eventually has_said /dev/ttyLATE
    expect_text "$(dpctl status)" "/dev/ttyLATE is not there"
    ln -s ttyPB1 /dev/ttyLATE
    eventually has_said "/dev/ttyLATE is back"
    expect_equal "process" "$(main_pid)" "$pid"
    expect_equal "restarts" "$(restarts)" 0
    systemctl stop dpslaved
    rm /dev/ttyLATE
}
prove "given a port that is not there, when it comes later, then the service is up before and behind it" waits_for_port
