# SPDX-License-Identifier: Apache-2.0
# A full disk and a read-only root: nothing that the daemon needs.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

fill() { # FOLDER: with the file "filler", until nothing fits any more
    head -c 600M /dev/zero >"$1/filler" || true
    head -c 4096 /dev/zero >"$1/filler-2" || true
    ! head -c 4096 /dev/zero >"$1/filler-3" 2>/dev/null || fail "$1 is not full"
}
serves() { # VALUE
    goes_on_exchanging
    expect_status 0 dpctl status
    expect_status 0 dpctl write --station unwinder 62 "$1"
    eventually drive_has_said 1 "tag 62 written $1"
}

serves_with_full_disk() {
    local before
    fill /var/tmp # the root
    mount -o remount,size=16M /run # else it is as large as a fifth of the memory
    fill /run                      # where the journal is
    serves 71.0
    before=$(restarts)
    kill -9 "$(main_pid)"
    eventually restarted_since "$before"
    eventually exchanging
}
prove "F25: given a full disk and a full journal, when the service serves and is killed, then nothing is lost but log lines" \
    serves_with_full_disk
rm -f /var/tmp/filler* /run/filler*
mount -o remount,size=20% /run

serves_with_read_only_root() {
    journalctl --relinquish-var # the one file on / that is open for writing
    mount -o remount,bind,ro /
    ! touch /var/tmp/x 2>/dev/null || fail "/ can still be written"
    serves 72.0
    expect_equal "too_late" "$(counter bus too_late)" 0
    expect_status 0 systemctl restart dpslaved
    eventually exchanging
    goes_on_exchanging
    expect_equal "too_late of the new process" "$(counter bus too_late)" 0
}
prove "F26: given a read-only root, when the service serves and is restarted, then it is back in Data_Exchange" \
    serves_with_read_only_root
mount -o remount,bind,rw /
journalctl --flush
