# SPDX-License-Identifier: Apache-2.0
# What the virtual machines are made of, made once and cached: Debian's kernel, the modules that Debian leaves out, and
# a small root file system. Sourced by vm.sh; $architecture and $flavour say what is wanted.
# The makers run where bash ignores set -e (see cached in lib.sh): each command that matters says so itself.
# shellcheck shell=bash

# apt-get or apt-cache for packages of $architecture, whatever the host is.
apt_for() { # PROGRAM ARGUMENT...
    local program=$1 state=$machine_cache/apt-$architecture
    shift
    if [ "$architecture" = "$(dpkg --print-architecture)" ]; then
        "$program" "$@"
        return
    fi
    mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
    : >>"$state/status"
    "$program" -o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture" -o "Dir::State::lists=$state/lists" \
        -o "Dir::Cache=$state/cache" -o "Dir::State::status=$state/status" -o Acquire::Languages=none "$@"
}

# Fetches a package into a folder.
fetch() { # FOLDER PACKAGE
    (cd "$1" && apt_for apt-get download -qq "$2" 2>/dev/null) ||
        die "apt-get cannot download $2: is there a package mirror in reach, and did apt-get update run?"
}

# The kernel's full name, e.g. 6.1.0-56-amd64: what the package linux-image-$flavour depends on today.
kernel_version() {
    [ "$architecture" = "$(dpkg --print-architecture)" ] || apt_for apt-get update -qq >/dev/null 2>&1 ||
        die "apt-get update for $architecture failed: is there a package mirror in reach?"
    apt_for apt-cache depends "linux-image-$flavour" 2>/dev/null | sed -n 's/.*Depends: linux-image-//p' | head -n 1
}

# The kernel with its modules; busybox for the first steps.
make_kernel() { # FOLDER
    local package
    for package in "linux-image-$kernel" busybox-static; do
        fetch "$1" "$package"
        dpkg-deb -x "$1/$package"_*.deb "$1" || die "$package cannot be unpacked"
    done
    rm -f "$1"/*.deb
    depmod -b "$1" "$kernel" || die "depmod failed for $kernel"
    make_initrd "$1" || die "the initial RAM disk cannot be made"
}

# The files of kernel modules and of those that they need, in the order in which they are loaded.
module_files() { # FOLDER NAME...
    local folder=$1 name
    shift
    for name in "$@"; do
        modprobe -d "$folder" -S "$kernel" --show-depends "$name" || return
    done | awk '/^insmod/ && !seen[$2]++ {print $2}'
}

# initrd: loads the drivers of the disk and of the shared folder, then hands over to systemd.
make_initrd() { # FOLDER
    local work=$1/initrd.work file files number=100
    files=$(module_files "$1" virtio_pci virtio_blk ext4 9pnet_virtio 9p) || return
    mkdir -p "$work"/{bin,proc,sys,dev,newroot,mod} && cp "$1/bin/busybox" "$work/bin/" && cp "$machine/vm/init" "$work/init" || return
    while read -r file; do
        number=$((number + 1))
        cp "$file" "$work/mod/$number-$(basename "$file")" || return
    done <<<"$files"
    (cd "$work" && find . | cpio -o -H newc --quiet | zstd -q -3 -f -o "$1/initrd") && rm -rf "$work"
}

# gpio-sim (a GPIO chip that can be looked at from both sides) and uleds (lamps of the LED class), which Debian's kernels
# leave out, built from Debian's kernel source against its headers.
make_modules() { # FOLDER
    local source
    source=linux-source-$(cut -d. -f1,2 <<<"$kernel")
    fetch "$1" "$source"
    dpkg-deb --fsys-tarfile "$1/$source"_*.deb | tar -xO "./usr/src/$source.tar.xz" | xz -T0 -dc |
        tar -x -C "$1" --strip-components=3 "$source/drivers/gpio/gpio-sim.c" "$source/drivers/gpio/gpiolib.h" \
            "$source/kernel/irq/irq_sim.c" "$source/drivers/leds/uleds.c" || die "$source cannot be unpacked"
    rm -f "$1"/*.deb
    # irq_to_desc() is not there for modules; the other function is, and does the same.
    sed -i 's/handle_simple_irq(irq_to_desc(irqnum))/generic_handle_irq_safe(irqnum)/' "$1/irq_sim.c" &&
        printf '#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >>"$1/irq_sim.c" &&
        echo 'obj-m := irq_sim.o gpio-sim.o uleds.o' >"$1/Makefile" || die "the sources of the modules cannot be edited"
    make -s -C "/lib/modules/$kernel/build" M="$1" modules >"$1/make.log" 2>&1 ||
        die "gpio-sim cannot be built: $(tail -n 3 "$1/make.log")"
}

# A Debian with systemd and the named packages.
make_root() { # FOLDER PACKAGES
    mmdebstrap -q --variant=minbase --architectures="$architecture" --include="$2" \
        --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/doc/*' \
        --dpkgopt='path-exclude=/usr/share/locale/*' "$(debian_release)" "$1" "$(debian_mirror)" >"$1.log" 2>&1 ||
        die "the root file system cannot be made: $(tail -n 3 "$1.log")"
    rm -f "$1.log"
}

# Sets $kernel (its version), $kernel_folder, $modules_folder (empty where the kernel has all it needs), $root_folder.
make_base() { # PACKAGE-FILE...
    local packages root_job recipe
    recipe=$(fingerprint "$(cat "$machine/vm/base.sh" "$machine/vm/init")")
    kernel=$(kernel_version)
    [ -n "$kernel" ] || die "apt knows no package linux-image-$flavour for $architecture: run apt-get update"
    packages=systemd,systemd-sysv,udev,kmod,dbus,procps,setserial,gpiod,$(dependencies_of "$@")
    local root_name
    root_name=vm-root-$architecture.$(fingerprint "$(debian_release)" "$packages" "$recipe")
    cached "$root_name" make_root "$packages" >/dev/null & # beside the kernel: the two take a processor each
    root_job=$!
    kernel_folder=$(cached "vm-kernel-$architecture.$kernel.$recipe" make_kernel)
    modules_folder=
    if [ "$architecture" = amd64 ]; then
        install_missing make gcc "linux-headers-$kernel"
        modules_folder=$(cached "vm-modules-$architecture.$kernel.$recipe" make_modules)
    fi
    wait "$root_job" || die "there is no root file system for the machine"
    root_folder=$machine_cache/$root_name
}
