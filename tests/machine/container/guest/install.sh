# SPDX-License-Identifier: Apache-2.0
# Installed, and nothing configured.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

# Every file that is not a log, a cache or the state of the packaging system.
all_files() {
    find / -xdev \( -path /host -o -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tmp -o -path /var/log \
        -o -path /var/cache -o -path /var/lib/dpkg -o -path /var/lib/systemd/catalog -o -path /var/tmp \) -prune \
        -o -print | grep -v -E '^/etc/((passwd|group|shadow|gshadow|subuid|subgid)-|\.pwd\.lock)$' | sort
}
all_files >/run/files-before

installs() {
    dpkg -i /host/debs/*.deb
    expect_equal "state of dpslaved" "$(dpkg-query -W -f '${Status}' dpslaved)" "install ok installed"
    expect_equal "state of dpslaved-sim" "$(dpkg-query -W -f '${Status}' dpslaved-sim)" "install ok installed"
}
require "given a bare system, when the packages are installed, then both are configured" installs

has_user() {
    local entry
    entry=$(getent passwd dpslaved)
    expect_text "$entry" nologin
    getent group dpslaved
    expect_equal "user id below 1000" "$(($(id -u dpslaved) < 1000))" 1
    expect_text "$(id -Gn dpslaved)" dialout
    getent group dpslaved-devices
}
prove "given the package, when it was installed, then there is a system user dpslaved that may use serial ports" has_user

is_enabled() { expect_equal "dpslaved.service" "$(systemctl is-enabled dpslaved)" enabled; }
prove "given the package, when the machine boots, then the service is started" is_enabled

is_skipped() {
    mark
    expect_status 0 systemctl start dpslaved
    expect_equal "state" "$(property dpslaved ActiveState)" inactive
    expect_equal "result" "$(property dpslaved Result)" exec-condition
    eventually has_said "$config"
    expect_equal "status of the condition" "$(systemctl is-failed dpslaved || true)" inactive
}
prove "given the configuration as shipped, when the service starts, then it is skipped and the log names the file to edit" \
    is_skipped
