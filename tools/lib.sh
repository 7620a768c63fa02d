# SPDX-License-Identifier: Apache-2.0
# Shared by the scripts of this folder: where the project lies, how it says things, how it installs what it needs.
# shellcheck shell=bash

set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$project"

say() { printf '\n\033[1m==> %s\033[0m\n' "$*"; }
die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}

# What a bare Debian needs to build the programs.
build_packages=(
    g++ cmake ninja-build pkg-config
    libspdlog-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libsystemd-dev libmodbus-dev
    libgpiod-dev scdoc
)
# What the tests need beside that. prometheus has promtool, which judges the figures. tshark judges captures.
test_packages=(libgtest-dev libgmock-dev prometheus tshark systemd udev binutils python3 python3-pymodbus python3-serial python3-serial-asyncio)
# What compiles the core for a machine without an operating system (tests/purity). Without it that test is skipped. It takes 2.4 GB.
core_packages=(gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib)

# What the page of the GSD configurator needs beside that.
page_packages=(clang lld wasi-libc libc++-dev-wasm32 libclang-rt-dev-wasm32 esbuild python3)
# What drives the page in Chromium (tests/page/browser.py).
chromium_packages=(chromium chromium-driver)

# Installs those of the named packages that are missing; asks nothing, and touches apt only when it must.
install_missing() {
    local missing=() name
    for name in "$@"; do
        dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || missing+=("$name")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    say "Installing ${missing[*]}"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "these packages are missing and there is no sudo to install them: ${missing[*]}"
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q >/dev/null || die "apt-get update failed: is there a package mirror in reach?"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}" >/dev/null ||
        die "apt-get could not install ${missing[*]}"
}

# The tests that needed their second try, by name: from what a ctest with --repeat until-pass printed (stdin). The
# first try stands there as "3/9 Test #5: NAME", a further one as "Test #5: NAME".
second_tries() {
    sed -nE 's/^ +Test +#[0-9]+: ([^ ]+) \.+ +Passed +.*$/\1/p'
}

# Says which tests needed their second try (in the file $1, one a line); fails with more than two of them, for a race
# that is tried away is still one.
judge_second_tries() {
    local most=2 count
    count=$(wc -l <"$1")
    [ "$count" -eq 0 ] && return 0
    say "Needed a second try: $count"
    sed 's/^/    /' "$1"
    [ "$count" -le $most ] || die "more than $most tests needed a second try: look for the race in each"
}

# A daemon that lost its line opens /dev/pts/N again, which may be the terminal of another program by then. So the script runs again with
# terminals and processes that nobody else has: own_terminals SCRIPT WORDS. Where the user may not do that, nothing else may run.
own_terminals() {
    [ -z "${DPSLAVE_OWN_TERMINALS:-}" ] || return 0
    export DPSLAVE_OWN_TERMINALS=yes
    # shellcheck disable=SC2016 # the inner shell expands it
    local own=(unshare --mount --propagation private --pid --fork --kill-child --mount-proc bash -c
        'mount -t devpts -o newinstance,mode=600,ptmxmode=0666 devpts /dev/pts && mount --bind /dev/pts/ptmx /dev/ptmx && exec "$@"' _)
    "${own[@]}" true 2>/dev/null && exec "${own[@]}" "$@"
    ! pgrep -x 'dpslaved|dpsim' >/dev/null || die "a dpslaved or dpsim runs here: end it, for its terminals can become those of the tests"
}

report=${TMPDIR:-/tmp}/dpslaved-failed.$$ # what failed, for the end
steps=()
failed_steps=0
# step NAME COMMAND...: runs it, and goes on behind a failure.
step() {
    local name=$1 began=$SECONDS status
    shift
    set +e
    (set -e && "$@")
    status=$?
    set -e
    [ $status -eq 0 ] || failed_steps=$((failed_steps + 1))
    steps+=("$(printf '%-12s %-6s %5d s' "$name" "$([ $status -eq 0 ] && echo ok || echo FAILED)" $((SECONDS - began)))")
}
# Prints the steps, and behind them what failed. The exit status says whether all went well.
table_of_steps() {
    say "Steps, $SECONDS s together"
    printf '%s\n' "${steps[@]}"
    [ ! -e "$report" ] || cat "$report"
    rm -f "$report"
    [ "$failed_steps" -eq 0 ] || die "$failed_steps steps failed: see the table"
    say "All checks passed"
}

# Configures and builds one preset; further words are targets.
build() {
    local preset=$1
    shift
    if command -v ccache >/dev/null; then # clones of the project share what was compiled before
        local -x CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$project CCACHE_NOHASHDIR=1
    fi
    say "Building ($preset)"
    cmake --preset "$preset" >/dev/null || cmake --preset "$preset"
    cmake --build --preset "$preset" ${*:+--target "$@"}
}

# Builds the page of the GSD configurator in a folder of its own: build/release stays without it. Further words are targets.
build_page() {
    local folder=$1
    shift
    say "Building the page ($folder)"
    cmake -S . -B "$folder" -G Ninja -DDPSLAVE_CONFIGURATOR=ON -DBUILD_TESTING=OFF >/dev/null
    cmake --build "$folder" --target configurator "$@"
}
