# SPDX-License-Identifier: Apache-2.0
# The service after a boot, unchanged.
# shellcheck shell=bash

runs_since_boot() {
    expect_equal "the first process" "$(cat /proc/1/comm)" systemd
    eventually is_active
    expect_equal "restarts" "$(systemctl show dpslaved -P NRestarts)" 0
    dpctl status
}

exchanges_on_the_configured_bus() {
    start_drive
    start_master "$bus_far_port" 19200
    send_to_drive "set 55 12.50"
    send_to_master "wait 20s for in 1 = 1250"
    send_to_master "expect in 1 = 1250"
    eventually grep -q "as expected, in 1 is 1250" "$bench/master.log"
    send_to_master "out 1 = 500"
    eventually grep -q "tag 56 written 5.00" "$bench/drive.log"
    exchanging
}

bus_thread_is_real_time() {
    local pid bus locked size
    pid=$(main_pid)
    bus=$(ps -T -p "$pid" -o comm=,cls=,rtprio= | awk '$1 == "bus" {print $2, $3}')
    expect_equal "scheduling of the bus thread" "$bus" "FF 80"
    locked=$(awk '/^VmLck/ {print $2}' "/proc/$pid/status")
    size=$(awk '/^VmRSS/ {print $2}' "/proc/$pid/status")
    [ "$locked" -ge "$size" ] || fail "$locked kB of memory are locked, and $size kB are in use"
}

port_is_taken() {
    expect_status 2 setpriv --reuid=nobody --regid=dialout --clear-groups sh -c ": <$bus_port"
    expect_text "$output" "busy"
}

require "given an installed and configured package, when the machine has booted, then the service runs" runs_since_boot
require "given a master and a drive on serial ports, when the master starts up, then values go both ways" \
    exchanges_on_the_configured_bus
prove "given the service, when its threads are looked at, then the bus thread is SCHED_FIFO and all memory is locked" \
    bus_thread_is_real_time
prove "given the port of the bus, when another process opens it, then it is busy" port_is_taken
