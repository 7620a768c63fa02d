# SPDX-License-Identifier: Apache-2.0
# Every rate that the service can be given, looked up in the port by another program.
# shellcheck shell=bash

# What the kernel has for the port (TCGETS2, c_ospeed), asked by another program than the service.
rate_of() { # PORT
    perl -e '
        use Fcntl;
        sysopen(my $port, $ARGV[0], O_RDONLY | O_NOCTTY | O_NONBLOCK) or die "$ARGV[0]: $!\n";
        my $termios2 = "\0" x 44;
        ioctl($port, 0x802C542A, $termios2) or die "TCGETS2: $!\n";
        print unpack("x40 L", $termios2), "\n"' "$1"
}

each_rate_is_set() { # BAUD
    configure "port = \"$bus_port\"" "baud = $1" 'direction = "none"' </dev/null
    restart_service
    master "$bus_far_port" "$1" "start 30s" "out 1 = $((RANDOM % 1000))" "run 300ms"
    expect_equal "rate of $bus_port" "$(rate_of "$bus_port")" "$1"
}
for rate in 9600 19200 45450 93750 187500 500000 1500000; do
    prove "given a bus at $rate bit/s, when the service starts, then its UART has that rate and exchanges data" each_rate_is_set "$rate"
done

