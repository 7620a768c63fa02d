# SPDX-License-Identifier: Apache-2.0
# What the tests in the container have around them: the configuration, the masters and drives on the host, the service.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share
# shellcheck source=../../guest.sh
source /host/guest.sh || exit 1
# shellcheck source=/dev/null
source /host/world.env || exit 1 # bus_baud, drive_baud
# shellcheck disable=SC2154 # what world.env sets
: "$bus_baud" "$drive_baud"
export SYSTEMD_PAGER=cat LC_ALL=C DEBIAN_FRONTEND=noninteractive

config=/etc/dpslaved/dpslaved.toml
socket_of_second=/run/dpslaved-second/control.sock

# ---- configuration: two stations of 590 drives, as patient as the masters are (max_tsdr)

# bus_and_line NUMBER [SOCKET]
bus_and_line() {
    cat <<CONFIG
[bus]
port = "/dev/ttyPB$1"
baud = $bus_baud
direction = "none"
max_tsdr = 65535
[control]
socket = "${2:-/run/dpslaved/control.sock}"
[[line]]
name = "p3"
port = "/dev/ttyDRIVE$1"
protocol = "ei-ascii"
baud = $drive_baud
CONFIG
}
# station NAME ADDRESS UNIT
station() {
    printf '[[station]]\nname = "%s"\naddress = %s\nprofile = "590"\nline = "p3"\nunit = "%s"\ntags = "/usr/share/dpslaved/tags/example.csv"\nwhen_drive_lost = "hold"\n' "$@"
}
two_stations() {
    bus_and_line 1
    station unwinder 5 00
    station rewinder 6 01
}

# ---- the service

property() { systemctl show --value -p "$2" "$1"; }
is() { [ "$(property "$1" "$2")" = "$3" ]; } # is UNIT PROPERTY VALUE
main_pid() { property dpslaved MainPID; }
restarts() { property dpslaved NRestarts; }
restarted_since() { [ "$(restarts)" -gt "$1" ]; }
exchanging() { dpctl status unwinder --wait 0 --quiet; }
second() { dpctl --socket "$socket_of_second" "$@"; }

drop_in() { # UNIT NAME TEXT
    mkdir -p "/etc/systemd/system/$1.d"
    printf '%s\n' "$3" >"/etc/systemd/system/$1.d/$2.conf"
    systemctl daemon-reload
}
no_drop_in() { # UNIT NAME
    rm -f "/etc/systemd/system/$1.d/$2.conf"
    rmdir --ignore-fail-on-non-empty "/etc/systemd/system/$1.d" 2>/dev/null || true
    systemctl daemon-reload
}

# Brings everything back to where each group of tests begins, whatever became of the last one.
in_service() {
    two_stations >"$config"
    no_drop_in dpslaved.service real-time
    systemctl reset-failed dpslaved.service
    exchanging || systemctl restart dpslaved
    eventually exchanging
}

# The thread "bus" of a process.
bus_thread() {
    local task
    for task in /proc/"$1"/task/*; do
        [ "$(cat "$task/comm")" != bus ] || { basename "$task" && return; }
    done
    fail "process $1 has no thread named bus"
}

# counter GROUP NAME: of dpctl counters, whose groups begin in the first column.
counter() {
    dpctl counters | awk -v group="$1" -v name="$2" '
        /^[^ ]/ { here = $1 == group }
        here && $3 == name { print $1; found = 1 }
        END { exit !found }' || fail "no counter $2 of $1"
}
cycles() { counter unwinder data_exchange; }
cycles_beyond() { [ "$(cycles)" -gt "$1" ]; }
# goes_on_exchanging: some more cycles from now on.
goes_on_exchanging() {
    local now
    now=$(cycles)
    eventually cycles_beyond $((now + 20))
}

# ---- the journal, from a mark on; by time, because --after-cursor together with -u may leave out the first line

mark() {
    journalctl --sync
    date +%s.%6N >/run/journal-mark
}
said() { journalctl --since "@$(cat /run/journal-mark)" -o cat -u "${1:-dpslaved}"; }
has_said() { grep -q -F -e "$1" <<<"$(said "${2:-dpslaved}")"; } # has_said TEXT [UNIT]

# ---- masters and drives on the host

# master NUMBER COMMAND...: sends the commands and prints the output until they were done.
master() {
    local log=/host/master$1.log token from
    token="done $(date +%s%N)"
    from=$(wc -l <"$log")
    printf '%s\n# %s\n' "${*:2}" "$token" >"/host/master$1.in"
    eventually grep -q -F -e "> # $token" "$log"
    tail -n "+$((from + 1))" "$log"
}
drive() { printf '%s\n' "${*:2}" >"/host/drive$1.in"; } # drive NUMBER COMMAND...
drive_has_said() { grep -q -F -e "$2" "/host/drive$1.log"; }

# What stands in the way of each other test when this one has failed.
on_failure() {
    systemctl --no-pager -l -n 8 status dpslaved.service 2>&1
    dpctl status 2>&1
}
