# SPDX-License-Identifier: Apache-2.0
# The sandbox: what the running daemon has, and what a program in its place can do. Devices are left to the virtual
# machine: not every host lets a container enforce DeviceAllow=.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

status_of() { sed -n "s/^$1:[[:space:]]*//p" "/proc/$(main_pid)/status"; }

has_given_up_rights() {
    local set_
    for set_ in CapInh CapPrm CapEff CapBnd CapAmb; do
        expect_equal "$set_" "$(status_of "$set_")" 0000000000000000
    done
    expect_equal NoNewPrivs "$(status_of NoNewPrivs)" 1
    expect_equal "Seccomp (2 = filter)" "$(status_of Seccomp)" 2
    expect_equal "user ids" "$(status_of Uid | tr -s '\t' ' ')" "$(id -u dpslaved | sed 's/.*/& & & &/')"
    expect_equal "network interfaces" "$(tail -n +3 "/proc/$(main_pid)/net/dev" | cut -d: -f1 | tr -d ' ')" lo
    expect_other "network namespace" "$(readlink "/proc/$(main_pid)/ns/net")" "$(readlink /proc/1/ns/net)"
}
prove "given the service, when its process is looked at, then it has no capability, a filter, its own user and no network" \
    has_given_up_rights

is_judged_safe() {
    expect_status 0 systemd-analyze verify --man=no dpslaved.service dpslaved@second.service
    expect_no_text "$output" dpslaved
    expect_status 0 systemd-analyze security --no-pager --threshold=10 dpslaved.service # tenths
}
prove "given the installed units, when systemd judges them, then it has no violation, and sees an exposure of 1.0 at most" \
    is_judged_safe

# The unit as it is, with another program in it.
probe() {
    touch /home/of-the-system /root/of-the-system /tmp/of-the-system
    drop_in dpslaved@probe.service probe "[Service]
Type=oneshot
Restart=no
WatchdogSec=0
Environment=RUNTIME=/run/dpslaved-probe
StandardOutput=journal
ExecCondition=
ExecStart=
ExecStart=/usr/bin/perl /usr/local/sandbox.pl
ExecStopPost="
    cp /host/sandbox.pl /usr/local/
    mark
    systemctl start dpslaved@probe || true
    journalctl --sync
    said dpslaved@probe
    rm /usr/local/sandbox.pl /home/of-the-system /root/of-the-system /tmp/of-the-system
    no_drop_in dpslaved@probe.service probe
}
holds() {
    local report outside
    report=$(probe)
    printf '%s\n' "$report"
    expect_equal "what is allowed" "$(allowed <<<"$report")" "$(printf '%s\n' "socket of AF_UNIX" \
        "reading its configuration" "writing to its private /tmp" "writing to its runtime folder" | sort)"
    expect_text "$report" "another personality: refused" # the last one: it has come to the end
    # The container itself refuses some of it to every process; of the rest the unit's refusal is a proof.
    outside=$(RUNTIME=/run perl /host/sandbox.pl)
    expect_equal "more than 20 are allowed outside the unit" "$(($(allowed <<<"$outside" | wc -l) > 20))" 1
}
allowed() { sed -n 's/: allowed$//p' | sort; }
prove "given the unit's sandbox, when another program runs in it, then it can do nothing but what the daemon needs" holds

# A container can be given no more than its host may give: without CAP_SYS_RESOURCE no higher limit.
reports_real_time() {
    local limit policy
    limit=$(awk '/^Max realtime priority/ { print $4 }' "/proc/$(main_pid)/limits")
    policy=$(chrt -p "$(bus_thread "$(main_pid)")")
    if [ "$limit" -ge 80 ]; then
        expect_text "$policy" SCHED_FIFO
    else
        expect_text "$policy" SCHED_OTHER
        journalctl -o cat -u dpslaved | grep -F "LimitRTPRIO=80 in the unit or the capability CAP_SYS_NICE"
    fi
}
prove "given the right to real time, the bus thread has SCHED_FIFO; without it, the log says what to allow" \
    reports_real_time

takes_real_time() {
    local pid
    drop_in dpslaved.service real-time $'[Service]\nAmbientCapabilities=CAP_SYS_NICE CAP_IPC_LOCK
CapabilityBoundingSet=CAP_SYS_NICE CAP_IPC_LOCK'
    systemctl restart dpslaved
    eventually exchanging
    pid=$(main_pid)
    expect_text "$(chrt -p "$(bus_thread "$pid")")" "SCHED_FIFO"
    expect_text "$(chrt -p "$(bus_thread "$pid")")" "priority: 80"
    expect_text "$(chrt -p "$pid")" "SCHED_OTHER"
    expect_equal "locked memory" "$(($(status_of VmLck | tr -dc 0-9) > 1000))" 1
    no_drop_in dpslaved.service real-time
    systemctl restart dpslaved
    eventually exchanging
}
prove "given the capabilities that the log named, when the service starts, then only the bus thread has SCHED_FIFO 80" \
    takes_real_time
