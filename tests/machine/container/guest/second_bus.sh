# SPDX-License-Identifier: Apache-2.0
# dpslaved@second.service beside dpslaved.service.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

runs_second_bus() {
    { bus_and_line 2 "$socket_of_second" && station tension 5 00; } >/etc/dpslaved/second.toml
    expect_status 0 systemctl start dpslaved@second
    master 2 start
    eventually second status --wait 0 --quiet
    exchanging
}
prove "given a second configuration, when dpslaved@second starts, then both buses exchange data" runs_second_bus

lives_alone() {
    systemctl stop dpslaved
    second status --wait 0 --quiet
    second status
    systemctl start dpslaved
    eventually exchanging
    systemctl stop dpslaved@second
    exchanging
}
prove "given two buses, when one service is stopped, then the other one goes on" lives_alone
