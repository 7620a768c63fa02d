# SPDX-License-Identifier: Apache-2.0
# A machine that is not as it should be: the service says so in a sentence, and either goes on or ends cleanly.
# shellcheck shell=bash

plain() { configure "port = \"$bus_port\"" "baud = ${1:-19200}" 'direction = "none"' </dev/null; }

rate_is_impossible() {
    setserial "$card_far_port" baud_base 115200
    configure "port = \"$card_far_port\"" 'baud = 500000' 'direction = "none"' </dev/null
    refused 3 "500000"
    expect_text "$output" "$card_far_port"
    setserial "$card_far_port" baud_base 1500000
}
port_is_not_there() {
    configure 'port = "/dev/ttyS42"' 'baud = 19200' 'direction = "none"' </dev/null
    refused 3 "/dev/ttyS42"
}
port_cannot_switch() {
    configure "port = \"$bus_port\"" 'baud = 19200' 'direction = "kernel"' </dev/null
    refused 3 "TIOCSRS485"
}
by_rts() {
    configure "port = \"$bus_port\"" 'baud = 19200' 'direction = "rts"' </dev/null
    restart_service
    expect_text "$(service_log)" "driver enable: RTS"
    master "$bus_far_port" 19200 "start 30s" "run 500ms" unlock
}
# A bus in service has a telegram at least every 320 ms, or the search begins anew: this master repeats more often. What
# comes at another rate is not garbled here (qemu has no rates), so only that the search ends is shown.
baud_is_found() {
    configure "port = \"$bus_port\"" 'baud = "auto"' 'direction = "none"' </dev/null
    restart_service
    local slots=(--slot 100ms --retries 15)
    master "$bus_far_port" 93750 "try start 10s" "try start 10s" "try start 10s" "wait 10s for state data-exchange" unlock
}

no_right_to_real_time() {
    plain
    systemctl stop dpslaved
    install -d -o dpslaved /run/dpslaved
    prlimit --rtprio=0:0 --memlock=65536:65536 setpriv --reuid=dpslaved --regid=dpslaved --init-groups \
        --bounding-set=-all --inh-caps=-all dpslaved --config "$conf" >"$bench/poor.log" 2>&1 &
    local pid=$!
    master "$bus_far_port" 19200 "start 30s" "run 300ms" unlock
    kill "$pid"
    wait "$pid"
    grep -i "SCHED_FIFO" "$bench/poor.log"
    grep -i "memory" "$bench/poor.log"
    cat "$bench/poor.log"
}
disk_is_full_and_read_only() {
    plain
    fallocate -l "$(($(stat -f -c '%a * %S' /)))" /ballast || true
    dd if=/dev/zero of=/ballast.end bs=1k 2>/dev/null || true
    ! echo x >/one-more-file || fail "the disk is not full"
    restart_service
    master "$bus_far_port" 19200 "start 30s" "run 300ms" unlock
    rm -f /ballast /ballast.end /one-more-file
    echo u >/proc/sysrq-trigger # read-only, even with open files
    is_read_only() { ! touch /one-more-file; }
    eventually is_read_only
    restart_service
    master "$bus_far_port" 19200 "start 30s" "run 300ms" unlock
    mount -o remount,rw /
}
comes_back_at_once() {
    plain
    systemctl stop dpslaved
    mark_log
    configure 'port = "/dev/ttyS42"' 'baud = 19200' 'direction = "none"' </dev/null
    systemctl start dpslaved || true
    tries_again() { [ "$(systemctl show dpslaved -P NRestarts)" -ge 1 ]; }
    eventually tries_again
    plain
    eventually is_active
}
stays_down() {
    systemctl stop dpslaved
    echo "nonsense = 1" >>"$conf"
    systemctl start dpslaved || true
    sleep 1
    expect_equal "state" "$(systemctl is-failed dpslaved)" failed
    expect_equal "exit status" "$(systemctl show dpslaved -P ExecMainStatus)" 1
    plain
    systemctl reset-failed dpslaved
}

prove "given a UART whose clock gives at most 115200 bit/s, when 500000 are configured, then dpslaved ends with 3 and says so" \
    rate_is_impossible
prove "given a port that is not there, when dpslaved starts, then it ends with 3 and names it" port_is_not_there
prove "given a UART whose driver cannot switch, when direction is kernel, then dpslaved ends with 3 and says so" port_cannot_switch
prove "given direction rts, when a master is served, then data are exchanged" by_rts
prove "given baud auto, when a master speaks, then the rate is found and data are exchanged" baud_is_found
prove "given no right to real time, when dpslaved runs, then it says so and exchanges data" no_right_to_real_time
prove "given a full disk and then a read-only one, when the service starts, then it exchanges data" disk_is_full_and_read_only
prove "given a port that comes later than the service, when it is there, then the service runs" comes_back_at_once
prove "given a faulty configuration, when the service starts, then it stays down with status 1" stays_down
