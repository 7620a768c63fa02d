# SPDX-License-Identifier: Apache-2.0
# Lamps through each of the kernel's three ways, by the service in its sandbox. In data exchange red is off and green
# flashes with 2 Hz; without a master red is on and green flashes with 1 Hz (manual of the option board, chapter 9).
# shellcheck shell=bash

lamp=dpslaved-green
configure_lamps() { # RED GREEN
    configure "port = \"$bus_port\"" 'baud = 19200' 'direction = "none"' <<END
[station.leds]
red = "$1"
green = "$2"
END
}
pin_is() { [ "$(level "$1")" = "$2" ]; } # LINE LEVEL

# A lamp flashes: the pin is seen dark, lit, dark and lit again.
pin_flashes() { # LINE
    local value
    for value in 0 1 0 1; do eventually pin_is "$1" "$value"; done
}
# The kernel reports changes only, so four more lines are two flashes.
class_lamp_flashes() {
    local seen
    changed_four_times() { [ "$(wc -l <"$bench/lamp.log")" -ge $((seen + 4)) ]; }
    seen=$(wc -l <"$bench/lamp.log")
    eventually changed_four_times
}

sysfs_pin_and_class() {
    eventually test -e "/sys/class/leds/$lamp/brightness"
    udevadm settle
    configure_lamps "gpio:$(sysfs_number "$sysfs_lamp_line")" "led:$lamp"
    restart_service
    expect_equal "direction of the exported pin" "$(cat "/sys/class/gpio/gpio$(sysfs_number "$sysfs_lamp_line")/direction")" out
    eventually pin_is "$sysfs_lamp_line" 1
    class_lamp_flashes
    start_master "$bus_far_port" 19200
    eventually pin_is "$sysfs_lamp_line" 0
    class_lamp_flashes
    pin_is "$sysfs_lamp_line" 0
    leave_master
}
character_device() {
    configure_lamps "line:$(chip_device):$lamp_line" "line:$(chip_device):$((lamp_line + 1))"
    restart_service
    eventually pin_is "$lamp_line" 1
    pin_flashes $((lamp_line + 1))
    start_master "$bus_far_port" 19200
    eventually pin_is "$lamp_line" 0
    pin_flashes $((lamp_line + 1))
    leave_master
}
dark_at_the_end() {
    restart_service
    eventually pin_is "$lamp_line" 1
    stop_service
    pin_is "$lamp_line" 0
    pin_is $((lamp_line + 1)) 0
}
lamp_is_not_there() {
    configure_lamps "gpio:9999" "led:no-such-lamp"
    restart_service
    is_active
    expect_text "$(service_log)" "9999"
    expect_text "$(service_log)" "no-such-lamp"
    start_master "$bus_far_port" 19200
    eventually exchanging
    leave_master
}

./make-lamp "$lamp" "$bench/lamp.log" &
lamp_pid=$!
prove "given lamps by sysfs GPIO and LED class, when a master comes, then red goes out and green flashes" sysfs_pin_and_class
prove "given lamps by the GPIO character device, when a master comes, then red goes out and green flashes" character_device
prove "given lit lamps, when the service stops, then they are dark" dark_at_the_end
prove "given lamps that are not there, when the service starts, then the log names them and data are exchanged" lamp_is_not_there
kill "$lamp_pid"
