# SPDX-License-Identifier: Apache-2.0
# A virtual machine that has the packages installed and runs one script, /host/run. Sourced by the steps amd64 and arm64:
#   architecture=amd64 flavour=rt-amd64
#   make_machine FOLDER...         its disk: Debian, the packages of DEBS, and the files of the named folders on top
#   run_machine QEMU ARGUMENT...   boots it, prints what its script prints, and ends with its status
# What lies in $shared is /host in the machine. Needs root and Debian's package mirror, but no hardware
# virtualisation: qemu translates (TCG).
# shellcheck shell=bash

# shellcheck source=../lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/../lib.sh"
# shellcheck source=base.sh
source "$machine/vm/base.sh"

# A folder of this run alone.
folder=$(mktemp -d "${TMPDIR:-/tmp}/dpslaved-$machine_step.XXXXXX")
shared=$folder/host
mkdir "$shared"
qemu=
leave() {
    local status=$?
    trap - EXIT
    [ -z "$qemu" ] || kill "$qemu" 2>/dev/null || true
    wait 2>/dev/null || true
    [ "$status" -eq 0 ] || keep "$shared"/*.log "$folder"/*.log
    rm -rf "$folder"
    exit "$status"
}
trap leave EXIT
trap 'exit 130' INT TERM

# The packages of the list DEBS that suit $architecture.
suiting_debs() {
    local deb
    for deb in ${DEBS:-}; do
        case $deb in *_"$architecture".deb | *_all.deb) echo "$deb" ;; esac
    done
}

make_machine() { # FOLDER...
    local debs own root=$folder/root
    need_root "makes the disk of a machine"
    mapfile -t debs < <(suiting_debs | grep -v -e -dbgsym_)
    [ ${#debs[@]} -gt 0 ] || die "DEBS names no package for $architecture"
    install_missing mmdebstrap e2fsprogs kmod cpio zstd xz-utils
    make_base "${debs[@]}"
    step "disk with ${debs[*]##*/}"
    cp -a --reflink=auto "$root_folder" "$root"
    mkdir -p "$root/debs" "$root/host"
    cp "${debs[@]}" "$root/debs/"
    chroot "$root" sh -c 'DEBIAN_FRONTEND=noninteractive dpkg -i /debs/*.deb' >"$folder/install.log" 2>&1 ||
        die "the packages cannot be installed: $(tail -n 5 "$folder/install.log")"
    rm -r "$root/debs"
    install_kernel_modules "$root"
    for own in "$machine/vm/root" "$@"; do cp -r "$own/." "$root/"; done
    mke2fs -q -F -t ext4 -O ^has_journal -d "$root" "$folder/disk" 600M >"$folder/mke2fs.log"
    rm -rf "$root"
    cp "$machine/guest.sh" "$machine"/vm/guest/* "$shared/"
}

install_kernel_modules() { # ROOT
    local into=$1/lib/modules/$kernel file
    mkdir -p "$into/extra"
    while read -r file; do
        install -D -m 644 "$file" "$into/${file#*"/lib/modules/$kernel/"}"
    done < <(module_files "$kernel_folder" configfs 9p)
    [ -z "$modules_folder" ] || cp "$modules_folder"/*.ko "$into/extra/"
    cp "$kernel_folder/lib/modules/$kernel"/modules.{builtin,builtin.modinfo,order} "$into/"
    depmod -b "$1" "$kernel"
}

run_machine() { # QEMU ARGUMENT...
    local status limit=${MACHINE_LIMIT:-900}
    step "boot of linux $kernel"
    timeout -k 5 "$limit" "$@" -smp 2 -nodefaults -no-user-config -display none -nic none -no-reboot \
        -kernel "$kernel_folder/boot/vmlinuz-$kernel" -initrd "$kernel_folder/initrd" \
        -drive "file=$folder/disk,if=none,id=disk,format=raw,cache=unsafe" -device virtio-blk-pci,drive=disk \
        -device virtio-rng-pci -fsdev "local,id=host,path=$shared,security_model=none" \
        -device virtio-9p-pci,fsdev=host,mount_tag=host >"$folder/qemu.log" 2>&1 &
    qemu=$!
    follow "$shared/results.log" "$qemu" &
    local tail_pid=$!
    wait "$qemu" || true
    qemu=
    wait "$tail_pid" || true
    status=$(cat "$shared/status" 2>/dev/null || echo none)
    step "machine ended, its tests with status $status"
    [ "$status" != none ] || {
        tail -n 40 "$folder/console.log" "$folder/qemu.log"
        die "the machine ended, or took longer than $limit s, before its tests did"
    }
    [ "$status" = 0 ] || die "tests failed in the machine"
}
