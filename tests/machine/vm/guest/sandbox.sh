# SPDX-License-Identifier: Apache-2.0
# What the service may do, tried from inside: the unit as installed, with a probe in place of the program.
# shellcheck shell=bash

# Runs a program as dpslaved.service would run its own; what it says goes to standard output.
in_sandbox() { # COMMAND...
    local unit=/run/systemd/system/dpslaved-probe.service
    sed -E '/^(ExecCondition|ExecReload|ExecStopPost|WatchdogSec|Restart[A-Za-z]*|Type|RuntimeDirectory[A-Za-z]*)=/d
        s#^ExecStart=.*#Type=oneshot\nRuntimeDirectory=dpslaved-probe\nStandardOutput=file:/run/probe.out\nStandardError=file:/run/probe.out\nExecStart=/run/probe#' \
        "$(systemctl show dpslaved -P FragmentPath)" >"$unit"
    printf '#!/bin/bash\n%s\n' "$*" >/run/probe
    chmod 755 /run/probe
    : >/run/probe.out
    systemctl daemon-reload
    systemctl start dpslaved-probe.service || echo "the probe failed"
    cat /run/probe.out
}
# Opens each device as root in the service's control group: permissions would let it, so only DeviceAllow can refuse.
open_in_its_cgroup() { # DEVICE...
    bash -c 'echo $$ >"/sys/fs/cgroup$0/cgroup.procs" || exit 1
        for device in "$@"; do (: <"$device") && echo "$device: opened"; done' \
        "$(systemctl show dpslaved -P ControlGroup)" "$@" 2>&1 || true
}

devices_are_those_allowed() {
    local device said allowed=("$drive_far_port" "$(chip_device)" /dev/null) shut=(/dev/vda /dev/kmsg /dev/hwrng)
    for device in "${allowed[@]}" "${shut[@]}"; do : <"$device"; done # root has the right, and they are there
    said=$(open_in_its_cgroup "${allowed[@]}" "${shut[@]}")
    echo "$said"
    for device in "${allowed[@]}"; do expect_text "$said" "$device: opened"; done
    for device in "${shut[@]}"; do expect_text "$said" "$device: Operation not permitted"; done
}

nothing_but_real_time() {
    local pid status
    pid=$(main_pid)
    status=$(cat "/proc/$pid/status")
    [ "$(awk '/^Uid/ {print $2}' <<<"$status")" -ne 0 ]
    for name in CapInh CapPrm CapEff CapBnd CapAmb; do
        expect_equal "$name" "$(awk -v name="$name:" '$1 == name {print $2}' <<<"$status")" 0000000000000000
    done
    expect_equal NoNewPrivs "$(awk '/^NoNewPrivs/ {print $2}' <<<"$status")" 1
    expect_equal Seccomp "$(awk '/^Seccomp:/ {print $2}' <<<"$status")" 2
    expect_equal "limit of locked memory" "$(awk '/^Max locked memory/ {print $4}' "/proc/$pid/limits")" unlimited
    expect_equal "limit of the real-time priority" "$(awk '/^Max realtime priority/ {print $4}' "/proc/$pid/limits")" 99
    [ ! -e /dev/cpu_dma_latency ] || expect_text "$(ls -l "/proc/$pid/fd")" /dev/cpu_dma_latency
}

the_rest_is_shut() {
    local said trigger=/sys/class/tty/${bus_port##*/}/rx_trig_bytes
    said=$(in_sandbox "far=$drive_far_port chip=$(chip_device) trigger=$trigger"'
        try() { if ("${@:2}") >/dev/null 2>&1; then echo "$1: allowed"; else echo "$1: refused"; fi; }
        opens() { : <>"$1"; }
        touch_it() { echo >>"$1"; }
        internet() { perl -MSocket -e "socket(my \$s, PF_INET, SOCK_STREAM, 0) or exit 1"; }
        unix() { perl -MSocket -e "socket(my \$s, PF_UNIX, SOCK_STREAM, 0) or exit 1"; }
        try "internet socket" internet
        try "Unix socket" unix
        try "real time" chrt -f 80 true
        try "name space" unshare -U true
        try "configuration" touch_it /etc/dpslaved/dpslaved.toml
        try "program" touch_it /usr/bin/dpctl
        try "root program" su -c true
        try "home" ls /root
        try "foreign process" ls /proc/1/fd
        try "kernel setting" touch_it /proc/sys/kernel/sysrq
        try "serial port" opens $far
        try "GPIO chip" opens $chip
        try "memory" opens /dev/mem
        try "sysfs GPIO" test -w /sys/class/gpio/export
        try "trigger" test ! -e $trigger -o -w $trigger')
    echo "$said"
    for allowed in "Unix socket" "real time" "serial port" "GPIO chip" "sysfs GPIO" trigger; do
        expect_text "$said" "$allowed: allowed"
    done
    for refused in "internet socket" "name space" configuration program "root program" home "foreign process" \
        "kernel setting" memory; do
        expect_text "$said" "$refused: refused"
    done
}

prove "given root's own rights, when it opens devices from the service's control group, then only serial ports and GPIO chips open" \
    devices_are_those_allowed
prove "given the service, when its process is looked at, then it has no capability, a system call filter and no limit of locked memory" \
    nothing_but_real_time
prove "given the unit with a probe in place of the program, when the probe tries all accesses, then only the needed ones are allowed" \
    the_rest_is_shut
