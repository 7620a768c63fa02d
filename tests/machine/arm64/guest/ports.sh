# SPDX-License-Identifier: Apache-2.0
# Names of what this machine has. Each port "far" hears what the one without says, and the other way round.
# shellcheck shell=bash
# shellcheck disable=SC2034 # for those who source this

bus_port=/dev/ttyAMA0 bus_far_port=/dev/ttyS0 # PL011, and on a PCI card
drive_port=/dev/ttyS1 drive_far_port=/dev/ttyS2

enable_line=2
chip_device() { # of the PL061
    local chip
    for chip in /sys/bus/gpio/devices/gpiochip*; do echo "/dev/${chip##*/}" && return; done
}
# The number of a line for sysfs GPIO, and in the kernel's trace.
sysfs_number() { echo $(($(cat /sys/class/gpio/gpiochip*/base) + $1)); } # LINE
# Where the level of a line is to be seen while a process has it as an output, and what is found there.
level_file() { echo /sys/kernel/debug/gpio; } # LINE
level_pattern() { # LINE LEVEL
    local levels=(lo hi)
    echo "gpio-$(sysfs_number "$1") .*out ${levels[$2]}"
}
# The level of a line. One that no process has is taken for a moment: sysfs GPIO leaves direction and level as they are.
level() { # LINE
    local level number
    for level in 0 1; do
        if grep -q -E -e "$(level_pattern "$1" "$level")" "$(level_file "$1")"; then echo "$level" && return; fi
    done
    number=$(sysfs_number "$1")
    echo "$number" >/sys/class/gpio/export
    cat "/sys/class/gpio/gpio$number/value"
    echo "$number" >/sys/class/gpio/unexport
}
