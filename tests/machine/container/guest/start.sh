# SPDX-License-Identifier: Apache-2.0
# In service: ready when it says so, and exchanging data with the master and the drive on the host.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

two_stations >"$config"

starts() {
    mark
    expect_status 0 systemctl start dpslaved
    expect_equal "type" "$(property dpslaved Type)" notify
    expect_equal "state right after the start" "$(property dpslaved ActiveState)" active
    expect_status 0 dpctl status # ready: the socket is open, without a wait
    expect_equal "user of the process" "$(stat -c %U "/proc/$(main_pid)")" dpslaved
}
require "given a configuration, when the service has started, then it serves at once and as its own user" starts

exchanges() {
    master 1 start
    eventually exchanging
    expect_text "$(dpctl status)" unwinder
    eventually status_names_the_master
}
status_names_the_master() { property dpslaved StatusText | grep -F "unwinder: Data_Exch with master 2"; }
require "given a pty of the host as bus, when a master starts up, then the station is in Data_Exchange and the unit says so" \
    exchanges

carries_values() {
    drive 1 "set 55 12.50"
    expect_no_text "$(master 1 "try wait 10s for in 1 = 1250")" "in 1 = 1250:" # a failure repeats the command
    master 1 "out 1 = 4200"
    eventually drive_has_said 1 "tag 56 written 42.00"
}
prove "given Data_Exchange, when drive and master change a value, then the other one has it" carries_values
