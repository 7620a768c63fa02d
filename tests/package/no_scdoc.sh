#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# no_scdoc.sh ROOT: on a machine without scdoc only the man pages are left out. With it they are built with the programs.
set -eu
root=$1
command -v ninja >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
targets() { # CMAKE-ARGUMENT...: all that would be built
    rm -rf "$work/build"
    cmake -S "$root" -B "$work/build" -G Ninja -DBUILD_TESTING=OFF "$@" >"$work/said" 2>&1 || { cat "$work/said" && exit 1; }
    ninja -C "$work/build" -t targets all | grep -E '^bin/[a-z]+:|^docs/man/[a-z.]+[0-9]: CUSTOM_COMMAND' | sort
}

targets -DSCDOC=/bin/cat >"$work/with"
targets -DSCDOC= >"$work/without"
grep -F 'the man pages are left out' "$work/said"
[ "$(grep -c '^docs/man/' "$work/with")" -eq 4 ] || { cat "$work/with" && exit 1; }
! grep '^docs/man/' "$work/without" || { echo "is still to be made" && exit 1; }
grep '^bin/' "$work/with" | diff - "$work/without"
[ -s "$work/without" ]
# With it, a build of only the programs, as in tools/demo, can be installed: the pages are made, too.
targets -DSCDOC=/bin/cat >"$work/with"
for program in dpslaved dpctl dpsim; do
    ninja -C "$work/build" -n "$program" | grep -q "Generating dpslaved.toml.5" ||
        { echo "building $program does not make the man pages, without which cmake --install fails" && exit 1; }
done
