# SPDX-License-Identifier: Apache-2.0
# Names of what this machine has. Each port "far" hears what the one without says, and the other way round.
# shellcheck shell=bash
# shellcheck disable=SC2034 # for those who source this

bus_port=/dev/ttyS1 bus_far_port=/dev/ttyS4 # the near one on the ISA bus, all others on PCI cards
drive_port=/dev/ttyS5 drive_far_port=/dev/ttyS6
card_port=/dev/ttyS7 card_far_port=/dev/ttyS8
card_slot=0000:00:13.0    # of $card_port, for its driver
monitor_port=/dev/ttyS9   # qemu's monitor (QMP)

chip_label=board
enable_line=3      # driver enable of the RS-485 transceiver
low_enable_line=4  # the same, low while sending
drive_enable_line=6 # driver enable of a two-wire drive line
lamp_line=5        # a lamp by the GPIO character device
sysfs_lamp_line=2  # a lamp by sysfs GPIO

# A GPIO chip of eight lines appears, as on a board.
plug_chip() {
    local chip=/sys/kernel/config/gpio-sim/$chip_label
    mkdir -p "$chip/bank0"
    echo 8 >"$chip/bank0/num_lines"
    echo "$chip_label" >"$chip/bank0/label"
    echo 1 >"$chip/live"
}
# It is taken away, even in use.
unplug_chip() { echo 0 >"/sys/kernel/config/gpio-sim/$chip_label/live"; }
# /dev/gpiochipN of the chip.
chip_device() { echo "/dev/$(cat "/sys/kernel/config/gpio-sim/$chip_label/bank0/chip_name")"; }
# Where the pin of a line shows its level, as output or input, and what is then found there.
level_file() { # LINE
    local chip=/sys/kernel/config/gpio-sim/$chip_label
    echo "/sys/devices/platform/$(cat "$chip/dev_name")/$(cat "$chip/bank0/chip_name")/sim_gpio$1/value"
}
level_pattern() { echo "^$2"; } # LINE LEVEL
level() { cat "$(level_file "$1")"; }
# The number of a line for sysfs GPIO, and in the kernel's trace.
sysfs_number() { # LINE
    local folder
    for folder in /sys/class/gpio/gpiochip*; do
        [ "$(cat "$folder/label")" != "$chip_label" ] || echo $(($(cat "$folder/base") + $1))
    done
}
# The level of a pin that is not driven, as a resistor on the board sets it.
pull() { echo "pull-$2" >"$(dirname "$(level_file "$1")")/pull"; } # LINE up|down
