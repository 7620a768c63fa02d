# SPDX-License-Identifier: Apache-2.0
# Upgraded, removed, purged.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

upgrades() {
    local invocation second before
    systemctl enable --now dpslaved@second
    eventually second status --wait 0 --quiet
    before=$(sha256sum "$config")
    invocation=$(property dpslaved InvocationID)
    second=$(property dpslaved@second InvocationID)
    dpkg --force-confdef --force-confold -i /host/next/*.deb
    expect_text "$(dpkg-query -W -f '${Version}' dpslaved)" +next1
    expect_equal "edited configuration" "$(sha256sum "$config")" "$before"
    expect_text "$(tail -n 1 "$config.dpkg-dist")" "# of the next version"
    expect_other "run of dpslaved" "$(property dpslaved InvocationID)" "$invocation"
    expect_other "run of dpslaved@second" "$(property dpslaved@second InvocationID)" "$second"
    eventually exchanging
    eventually second status --wait 0 --quiet
    is_enabled
}
prove "given an edited configuration, when the package is upgraded, then it is kept and both buses have the new program" upgrades

stays_stopped() {
    systemctl stop dpslaved dpslaved@second
    dpkg --force-confold -i /host/next/*.deb
    ! is dpslaved ActiveState active || fail "the upgrade has started the service"
    ! is dpslaved@second ActiveState active || fail "the upgrade has started the service of the second bus"
    systemctl start dpslaved dpslaved@second
    eventually exchanging
}
prove "given a service that was stopped, when the package is upgraded, then it stays stopped" stays_stopped

reinstalls() {
    dpkg --force-confold -i /host/next/*.deb
    eventually exchanging
}
prove "given the package, when it is installed over itself, then it exchanges data again" reinstalls

removes() {
    dpkg -r dpslaved-sim dpslaved
    ! is dpslaved ActiveState active || fail "the service still runs"
    ! is dpslaved@second ActiveState active || fail "the service of the second bus still runs"
    [ -z "$(pgrep -x dpslaved)" ] || fail "a process is left"
    [ -s "$config" ] || fail "the configuration was removed"
    [ ! -e /run/dpslaved ] || fail "/run/dpslaved is left"
    ! command -v dpslaved dpctl dpsim || fail "a program is left"
}
prove "given the service running, when the packages are removed, then it is stopped and only the configuration is left" removes

installs_again() {
    dpkg -i /host/next/*.deb
    eventually exchanging
    dpkg -r dpslaved-sim dpslaved
}
prove "given the removed package, when it is installed again, then it finds its configuration and exchanges data" installs_again

# What the administrator has put there, only the administrator removes; "enable" of a further bus goes with the package.
purges() {
    rm -rf /etc/dpslaved/second.toml /etc/systemd/system/dpslaved.service.d /etc/systemd/system/dpslaved@.service.d
    dpkg -P dpslaved-sim dpslaved
    all_files >/run/files-after
    expect_equal "what is left" "$(comm -13 /run/files-before /run/files-after)" ""
    expect_equal "what is missing" "$(comm -23 /run/files-before /run/files-after)" ""
    systemctl daemon-reload
    expect_equal "the unit" "$(property dpslaved LoadState)" not-found
    getent passwd dpslaved
}
prove "given the removed package, when it is purged, then nothing is left but the system user" purges
