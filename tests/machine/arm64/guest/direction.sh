# SPDX-License-Identifier: Apache-2.0
# Who switches the RS-485 transceiver to sending: the driver of the PL011, or a line of the PL061. That chip's driver
# keeps the level of a line whose user died, as those of most boards do.
# shellcheck shell=bash
source ./edges.sh || exit 1

# Flags and delays that the driver of the port holds (TIOCGRS485), asked by another program than the service.
rs485_of() { # PORT
    perl -e '
        use Fcntl;
        sysopen(my $port, $ARGV[0], O_RDONLY | O_NOCTTY | O_NONBLOCK) or die "$ARGV[0]: $!\n";
        my $rs485 = "\0" x 32;
        ioctl($port, 0x542E, $rs485) or die "TIOCGRS485: $!\n";
        my ($flags, $before, $after) = unpack("L3", $rs485);
        printf "%s %s %s, %d ms before, %d ms after\n", $flags & 1 ? "enabled" : "off", $flags & 2 ? "on-send" : "-",
            $flags & 4 ? "after-send" : "-", $before, $after' "$1"
}
by_the_driver() {
    configure "port = \"$bus_port\"" 'baud = 93750' 'direction = "kernel"' </dev/null
    restart_service
    expect_text "$(service_log)" "driver enable: by the driver of the UART"
    expect_equal "RS-485 settings" "$(rs485_of "$bus_port")" "enabled on-send -, 0 ms before, 0 ms after"
    master "$bus_far_port" 93750 "start 30s" "out 1 = 900" "run 1s" unlock
}
high_around_each_reply() {
    direct_by_gpio "$enable_line" false
    restart_service
    expect_level "$enable_line" 0
    edges_frame_replies "$enable_line" 1 19200
}

# The bare program killed while the line is high: the kernel leaves it high here, and --release is what makes it low.
release_makes_low() {
    local pid
    direct_by_gpio "$enable_line" false 9600
    systemctl stop dpslaved
    mkdir -p /run/dpslaved
    dpslaved --config "$conf" >"$bench/killed.log" 2>&1 &
    pid=$!
    eventually grep -q "driver enable" "$bench/killed.log"
    master "$bus_far_port" 9600 "try start 20s" "run 10s" >"$bench/master.log" 2>&1 &
    catch_level "$enable_line" 1 "$pid" KILL
    wait "$pid" || true
    expect_level "$enable_line" 1
    dpslaved --config "$conf" --release
    expect_level "$enable_line" 0
    wait || true
}
# The end of a service that is not started again: what is low then was made low by ExecStopPost, although the
# configuration is being edited.
low_after_crash() {
    direct_by_gpio "$enable_line" false 9600
    mkdir -p /run/systemd/system/dpslaved.service.d
    printf '[Service]\nRestart=no\n' >/run/systemd/system/dpslaved.service.d/once.conf
    systemctl daemon-reload
    restart_service
    start_master "$bus_far_port" 9600
    cp "$conf" "$bench/good.toml"
    echo "bus = [" >>"$conf"
    catch_level "$enable_line" 1 "$(main_pid)" KILL
    eventually systemctl is-failed dpslaved
    expect_level "$enable_line" 0
    cp "$bench/good.toml" "$conf"
    rm -r /run/systemd/system/dpslaved.service.d
    systemctl daemon-reload
    restart_service
    eventually exchanging
    leave_master
}

prove "given direction kernel, when a master is served, then the PL011 switches RS-485 and data are exchanged" by_the_driver
prove "given direction gpio, when a master is served, then the line is high around each reply and low else" high_around_each_reply
prove "given a chip that keeps its levels, when dpslaved was killed while sending, then --release makes the line low" release_makes_low
prove "given a chip that keeps its levels, when the service is killed while sending, then its ExecStopPost makes it low" \
    low_after_crash
