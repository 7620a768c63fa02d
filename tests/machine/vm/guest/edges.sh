# SPDX-License-Identifier: Apache-2.0
# The driver enable as the kernel saw it: each edge of a GPIO line and each write to the port, in their order.
# shellcheck shell=bash

tracing=/sys/kernel/tracing
start_trace() {
    mountpoint -q "$tracing" || mount -t tracefs tracefs "$tracing"
    echo 0 >"$tracing/tracing_on"
    : >"$tracing/trace"
    echo 1 >"$tracing/events/gpio/gpio_value/enable"
    [ -e "$tracing/events/kprobes/sent" ] || echo 'p:sent uart_write' >>"$tracing/kprobe_events"
    echo 'comm == "bus"' >"$tracing/events/kprobes/sent/filter"
    echo 1 >"$tracing/events/kprobes/sent/enable"
    echo 1 >"$tracing/tracing_on"
}
# Ends between two replies: those that run have to be whole.
end_trace() {
    echo 0 >"$tracing/tracing_on"
    cat "$tracing/trace" >"$bench/edges"
    echo 0 >"$tracing/events/kprobes/sent/enable"
    echo 0 >"$tracing/events/gpio/gpio_value/enable"
}

direct_by_gpio() { # LINE ACTIVE-LOW [BAUD]
    configure "port = \"$bus_port\"" "baud = ${3:-19200}" 'direction = "gpio"' "gpio_chip = \"$(chip_device)\"" "gpio_line = $1" \
        "gpio_active_low = $2" </dev/null
}
expect_level() { expect_equal "level of line $1" "$(level "$1")" "$2"; } # LINE LEVEL
has_level() { [ "$(level "$1")" = "$2" ]; }

# The trace of a whole life of a master: what it saw answered is what the line was active for.
edges_frame_replies() { # LINE ACTIVE BAUD
    local replies before
    before=$(counter replies)
    start_trace
    master "$bus_far_port" "$3" "start 30s" "out 1 = 700" "run 1s" "demand read 62" "expect demand = 1100" unlock
    sleep 0.2
    end_trace
    replies=$("$PWD/judge-edges" "$(sysfs_number "$1")" "$2" "$bench/edges")
    expect_equal "replies with driver enable" "$replies" $(($(counter replies) - before))
    [ "$replies" -ge 20 ] || fail "there were only $replies replies"
    expect_level "$1" $((1 - $2))
}
# Looks at the line until it has the level, then sends the signal at once: at 9600 bit/s a reply takes 20 ms and more.
catch_level() { # LINE LEVEL PID SIGNAL
    perl -e '
        my ($file, $pattern, $pid, $signal) = @ARGV;
        my $end = time + 30;
        while (time < $end) {
            open(my $f, "<", $file) or die "$file: $!\n";
            local $/;
            if (<$f> =~ /$pattern/) { kill $signal, $pid or die "no process $pid\n"; exit 0 }
        }
        die "the line was never so\n"' "$(level_file "$1")" "$(level_pattern "$1" "$2")" "$3" "$4"
}
