# SPDX-License-Identifier: Apache-2.0
# Who switches the RS-485 transceiver to sending: a GPIO line here, which is judged by the kernel's trace and by its pin.
# shellcheck shell=bash
source ./edges.sh || exit 1

high_around_each_reply() {
    direct_by_gpio "$enable_line" false
    restart_service
    expect_level "$enable_line" 0
    expect_text "$(service_log)" "driver enable: line $enable_line"
    edges_frame_replies "$enable_line" 1 19200
}
low_around_each_reply() {
    pull "$low_enable_line" up
    direct_by_gpio "$low_enable_line" true 1500000
    restart_service
    expect_level "$low_enable_line" 1
    edges_frame_replies "$low_enable_line" 0 1500000
}

# --- Never left active -----------------------------------------------------------------------------------------------

low_after_stop() {
    stop_service
    expect_level "$enable_line" 0
}
low_after_crash() {
    local signal
    for signal in SEGV ABRT KILL; do
        restart_service
        start_master "$bus_far_port" 9600
        catch_level "$enable_line" 1 "$(main_pid)" "$signal"
        eventually has_level "$enable_line" 0
        eventually exchanging
        leave_master
    done
}

# The bare program, killed again and again: every other time at a random moment, else just while the line is active.
# Only the kernel releases the line then.
low_after_kills() {
    local kills=0 active=0 pid limit end
    limit=$(cat kills)
    end=$((SECONDS + ${kill_seconds:-40}))
    systemctl stop dpslaved
    mkdir -p /run/dpslaved
    start_endless_master "$bus_far_port" 9600
    while { [ "$limit" -gt 0 ] && [ "$kills" -lt "$limit" ]; } || { [ "$limit" -eq 0 ] && [ "$SECONDS" -lt "$end" ]; }; do
        dpslaved --config "$conf" >"$bench/killed.log" 2>&1 &
        pid=$!
        eventually grep -q "driver enable" "$bench/killed.log"
        if [ $((kills % 2)) -eq 0 ]; then
            catch_level "$enable_line" 1 "$pid" KILL
            active=$((active + 1))
        else
            sleep "0.$((RANDOM % 900 + 100))"
            kill -9 "$pid"
        fi
        wait "$pid" || true
        expect_level "$enable_line" 0
        kills=$((kills + 1))
    done
    end_endless_master
    echo "$kills kills, $active of them while the line was active"
    echo "# $kills kills, $active of them while the line was active" >"$bench/kills"
}
# A master that begins anew whenever its slave is back.
start_endless_master() { # PORT BAUD
    touch "$bench/endless"
    while [ -e "$bench/endless" ]; do master "$1" "$2" "try start 5s" "run 20s" || true; done >"$bench/endless.log" 2>&1 &
    endless=$!
}
end_endless_master() {
    rm "$bench/endless"
    pkill -f -- "^dpsim master --port $bus_far_port " || true # it may be just between two masters
    wait "$endless" || true
}

# A two-wire drive line: at 9600 bit/s a request takes 8 ms and more, with a master or without.
direct_drive_line_by_gpio() {
    direct_by_gpio "$enable_line" false 9600
    sed -i "/^\[\[line\]\]/a direction = \"gpio\"\ngpio_chip = \"$(chip_device)\"\ngpio_line = $drive_enable_line" "$conf"
}
drive_line_is_released() {
    direct_drive_line_by_gpio
    restart_service
    expect_text "$(service_log)" "driver enable: line $drive_enable_line"
    catch_level "$drive_enable_line" 1 "$(main_pid)" KILL
    eventually has_level "$drive_enable_line" 0
    eventually is_active
    stop_service
    expect_level "$drive_enable_line" 0
}

# --- Trouble with the chip ---------------------------------------------------------------------------------------------

chip_goes_and_comes() {
    local pid from
    direct_by_gpio "$enable_line" false
    restart_service
    pid=$(main_pid)
    start_master "$bus_far_port" 19200
    mark_log
    unplug_chip
    says_so() { service_log | grep -i "driver enable"; }
    eventually says_so
    eventually grep -q "no longer answers" "$bench/master.log" # safe service: not a word without driver enable
    is_active
    from=$(counter replies)
    plug_chip
    answers() { [ "$(counter replies)" -ge $((from + 20)) ]; }
    eventually answers
    eventually exchanging
    expect_equal "the process" "$(main_pid)" "$pid"
    leave_master
    expect_level "$enable_line" 0
}

chip_is_busy() {
    local holder
    direct_by_gpio "$enable_line" false
    gpioset --mode=signal "$(chip_device)" "$enable_line=0" &
    holder=$!
    held() { gpioinfo "$(chip_device)" | grep "line *$enable_line:" | grep used; }
    eventually held
    refused 3 "gpioset"
    kill "$holder"
    wait "$holder" || true
}
chip_is_not_there() {
    direct_by_gpio "$enable_line" false
    sed -i 's#^gpio_chip.*#gpio_chip = "/dev/gpiochip9"#' "$conf"
    refused 3 "/dev/gpiochip9"
}
line_is_not_there() {
    direct_by_gpio 99 false
    refused 3 "99"
}

prove "given direction gpio at 19200 bit/s, when a master is served, then the line is high around each reply and low else" \
    high_around_each_reply
prove "given an active-low line at 1.5 Mbit/s, when a master is served, then the line is low around each reply and high else" \
    low_around_each_reply
direct_by_gpio "$enable_line" false 9600
prove "given the line high because of a reply, when the service crashes, then the line is low and the service comes back" \
    low_after_crash
prove "given direction gpio, when the service stops, then the line is low" low_after_stop
prove "given the bare program, when it is killed at random moments and while the line is high, then the line is low" \
    low_after_kills
cat "$bench/kills" 2>/dev/null
prove "given a drive line with direction gpio, when the service is killed within a request, then the line is low" \
    drive_line_is_released
direct_by_gpio "$enable_line" false 9600
prove "given data exchange, when the GPIO chip goes and comes back, then the log says so and the same process exchanges again" \
    chip_goes_and_comes
prove "given a line that another program has, when dpslaved starts, then it ends with 3 and names that program" chip_is_busy
prove "given a GPIO chip that is not there, when dpslaved starts, then it ends with 3 and names it" chip_is_not_there
prove "given a line that the chip has not, when dpslaved starts, then it ends with 3 and names it" line_is_not_there
