# SPDX-License-Identifier: Apache-2.0
# Data exchange whatever comes: another rate, noise, a dead process, a port that goes. A master is exchanging throughout.
# shellcheck shell=bash

# The count of Data_Exchange telegrams grows by ten and more.
goes_on() {
    local from
    from=$(counter data_exchange)
    counts_ten() { [ "$(counter data_exchange)" -ge $((from + 10)) ]; }
    eventually counts_ten
}

# From here the drive and the master of start.sh go on running.

# Asks qemu until it has done all. A port that was never opened echoes: qemu's own greeting then comes back to it, and
# 0xFF ends what it takes that for.
ask_monitor() { # COMMAND...
    local attempt
    stty -F "$monitor_port" raw -echo
    for attempt in 1 2 3 4 5; do
        exec 8<>"$monitor_port"
        printf '\xff\n{"execute":"qmp_capabilities"}\n' >&8
        printf '%s\n' "$@" >&8
        timeout 2 cat <&8 | tee "$bench/monitor.log" || true
        exec 8>&-
        [ "$(grep -c '"return"' "$bench/monitor.log")" -le $# ] || return 0 # one is that of qmp_capabilities
    done
    fail "qemu did not do it in $attempt attempts: $*"
}

breaks_are_survived() {
    local before one_break
    before=$(counter "flaw: bad character")
    one_break='{"execute":"chardev-send-break","arguments":{"id":"bus"}}'
    ask_monitor "$one_break" "$one_break"
    counts_a_break() { [ "$(counter "flaw: bad character")" -gt "$before" ]; }
    eventually counts_a_break
    goes_on
    exchanging
}

noise_is_survived() {
    local before=0 round
    flaws() { dpctl counters | awk '/flaw:/ {sum += $1} END {print sum}'; }
    before=$(flaws)
    for round in 1 2 3 4 5 6 7 8; do
        head -c 200 /dev/urandom >"$bus_far_port"
        sleep "0.$round"
    done
    goes_on
    [ "$(flaws)" -gt "$before" ] || fail "no flaw was counted"
    eventually exchanging
    dpctl counters
}

# A year on, two years back, and a year on again: in the end the clock is right. `eventually` goes by this clock, so it
# is asked between the steps.
clock_steps_are_not_noticed() {
    local pid step too_late value=700
    pid=$(main_pid)
    too_late=$(counter too_late)
    mark_log
    for step in "+1 year" "-2 years" "+1 year"; do
        date -s "$step"
        goes_on
        exchanging
        value=$((value + 100))
        send_to_master "out 1 = $value"
        eventually grep -q "tag 56 written ${value%??}.00" "$bench/drive.log"
    done
    expect_equal "the process" "$(main_pid)" "$pid"
    expect_equal "too_late" "$(counter too_late)" "$too_late"
    expect_no_text "$(service_log)" "Wait_Prm"
    expect_no_text "$(service_log)" "does not answer"
}

returns_after_kill() {
    local pid
    pid=$(main_pid)
    mark_log
    kill -9 "$pid"
    other_process() { is_active && [ "$(main_pid)" != "$pid" ] && [ "$(main_pid)" != 0 ]; }
    eventually other_process
    eventually exchanging
    goes_on
}

# A card that comes back has the usual clock again: 19200 bit/s it can do.
vanished_port_returns() {
    local restarts
    configure "port = \"$card_port\"" 'baud = 19200' 'direction = "none"' </dev/null
    restart_service
    start_master "$card_far_port" 19200
    restarts=$(systemctl show dpslaved -P NRestarts)
    eventually exchanging
    echo "$card_slot" >/sys/bus/pci/drivers/serial/unbind
    eventually logged "$card_port is missing"
    is_active
    echo "$card_slot" >/sys/bus/pci/drivers/serial/bind
    goes_on
    eventually exchanging
    expect_equal "restarts of the service" "$(systemctl show dpslaved -P NRestarts)" "$restarts"
    leave_master
}
trigger_is_one_octet() { expect_equal "rx_trig_bytes" "$(cat "/sys/class/tty/${bus_port##*/}/rx_trig_bytes")" 1; }
# The flag of the port (TIOCGSERIAL, ASYNC_LOW_LATENCY), asked by another program than the service.
low_latency_is_set() {
    expect_equal "low latency" "$(perl -e '
        use Fcntl;
        sysopen(my $port, $ARGV[0], O_RDONLY | O_NOCTTY | O_NONBLOCK) or die "$ARGV[0]: $!\n";
        my $serial = "\0" x 128;
        ioctl($port, 0x541E, $serial) or die "TIOCGSERIAL: $!\n";
        print unpack("x16 L", $serial) >> 13 & 1, "\n"' "$bus_port")" 1
}

prove "given a UART with a FIFO, when the service has it, then it interrupts after one octet" trigger_is_one_octet
prove "given a UART, when the service has it, then it is asked for low latency" low_latency_is_set
prove "given data exchange, when the line breaks, then the break is counted and the exchange goes on" breaks_are_survived
prove "given data exchange, when random octets come between the telegrams, then they are counted and the exchange goes on" \
    noise_is_survived
prove "F32: given data exchange, when the clock is set a year on, two back and one on, then bus and drive notice nothing" \
    clock_steps_are_not_noticed
prove "given data exchange, when the process is killed, then systemd starts another and the master has it in Data_Exch again" \
    returns_after_kill
leave_master
prove "given data exchange, when the UART's card goes and comes back, then the same process exchanges data again" vanished_port_returns
