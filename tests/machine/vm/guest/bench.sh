# SPDX-License-Identifier: Apache-2.0
# The bench of the machine tests, in the machine: configuration, simulated drive and master, and ways to look at the
# service from outside. Sourced after guest.sh and ports.sh.
# shellcheck shell=bash

conf=/etc/dpslaved/dpslaved.toml
# What is shown of a test that failed.
on_failure() {
    echo "the log of the service:"
    journalctl -u dpslaved --no-pager -o short-precise -n 12
    for log in master drive; do [ ! -e "$bench/$log.log" ] || tail -n 4 "$bench/$log.log"; done
}
bench=/run/bench
mkdir -p "$bench"

# --- The service -------------------------------------------------------------------------------------------------------

# Writes the configuration: the [bus] table from the arguments ('key = value'), behind it the station and its drive, then
# what comes on standard input. A machine that is translated is slow: max_tsdr is as long as it can be.
# A master that an earlier test left behind would speak on: it goes.
configure() { # KEY=VALUE...
    local setting
    [ ! -e "$bench/master.pid" ] || kill "$(cat "$bench/master.pid")" 2>/dev/null || true
    {
        echo "[bus]"
        printf 'max_tsdr = 65535\n'
        for setting in "$@"; do printf '%s\n' "$setting"; done
        printf '\n[[line]]\nname = "p3"\nport = "%s"\nprotocol = "ei-ascii"\nbaud = 9600\ntimeout_ms = 1000\n' "$drive_port"
        printf '\n[[station]]\nname = "unwinder"\naddress = 5\nprofile = "590"\nline = "p3"\nunit = "00"\ntags = "/usr/share/dpslaved/tags/example.csv"\nwhen_drive_lost = "hold"\n'
        [ -t 0 ] || cat
    } >"$conf"
}
main_pid() { systemctl show dpslaved -P MainPID; }
is_active() { [ "$(systemctl is-active dpslaved)" = active ]; }
is_dead() { ! pgrep -x dpslaved >/dev/null; }
# What the service logged since the last mark.
mark_log() { log_cursor=$(journalctl -u dpslaved -n 0 --show-cursor | sed -n 's/^-- cursor: //p'); }
service_log() { journalctl -u dpslaved --no-pager -o cat --after-cursor "$log_cursor"; }
logged() { service_log | grep -q -F -e "$1"; }
restart_service() {
    systemctl reset-failed dpslaved 2>/dev/null || true
    mark_log
    systemctl restart dpslaved
}
stop_service() {
    systemctl stop dpslaved
    is_dead
}
# Starts the bare program with the present configuration: it has to end by itself, with this status and text.
refused() { # STATUS TEXT
    systemctl stop dpslaved
    expect_status "$1" timeout 20 dpslaved --config "$conf"
    expect_text "$output" "$2"
}
# One number of `dpctl counters`, by its name there; the station's own when `bus` has none of that name.
counter() { # NAME
    dpctl --json counters | perl -0777 -ne 'print "$1\n" while /"name": "\Q'"$1"'\E"[^{}]*"value": (\d+)/g' | head -n 1
}

# --- Drive and master --------------------------------------------------------------------------------------------------

# These run on from one test to the next; a test is a shell of its own, so what they are called lies in files.

# A 590 at the far end of the drive's line; what is written to it is in $bench/drive.log.
start_drive() {
    rm -f "$bench/drive.in"
    mkfifo "$bench/drive.in"
    dpsim drive --profile 590 --port "$drive_far_port" --baud 9600 --log <>"$bench/drive.in" >"$bench/drive.log" 2>&1 &
    eventually grep -q ready "$bench/drive.log"
}
send_to_drive() { echo "$*" >"$bench/drive.in"; }

# DP masters are patient with a slow machine.
master_options=(--slave 5 --tags "55,56w,288" --watchdog 20s --cycle 20ms --script -)
slots=(--slot 500ms --retries 5)
# A master that ends after these commands, or at the first that fails.
master() { # PORT BAUD COMMAND...
    printf '%s\n' "${@:3}" | timeout 60 dpsim master --port "$1" --baud "$2" "${master_options[@]}" "${slots[@]}"
}
# A master that exchanges until leave_master; commands go through send_to_master, its answers are in $bench/master.log.
start_master() { # PORT BAUD
    rm -f "$bench/master.in"
    mkfifo "$bench/master.in"
    dpsim master --port "$1" --baud "$2" "${master_options[@]}" "${slots[@]}" <>"$bench/master.in" >"$bench/master.log" 2>&1 &
    echo $! >"$bench/master.pid"
    send_to_master "start 30s"
    eventually grep -q "station is in data exchange" "$bench/master.log"
}
send_to_master() { echo "$*" >"$bench/master.in"; }
leave_master() {
    send_to_master quit
    timeout "$patience" tail --pid="$(cat "$bench/master.pid")" -f /dev/null
    rm "$bench/master.pid"
}
exchanging() { dpctl status --wait 0 --quiet; }
