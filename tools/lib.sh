# SPDX-License-Identifier: Apache-2.0
# Shared by the scripts of this folder: where the project lies, how it says things, how it installs what it needs.
# shellcheck shell=bash

set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$project"

# What was compiled once, in whichever clone, is not compiled again (ccache).
export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$project CCACHE_NOHASHDIR=1

say() { printf '\n\033[1m==> %s\033[0m\n' "$*"; }
die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}

# What a bare Debian needs to build the programs.
build_packages=(
    ccache g++ cmake ninja-build pkg-config
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

# The steps of a run stand in the file $DPSLAVE_STEPS, which all scripts of the run share: name, verdict, seconds. Behind it stand what
# failed (.failed) and what the compiler cache had (.ccache).
steps() {
    if [ -z "${DPSLAVE_STEPS:-}" ]; then
        DPSLAVE_STEPS=$(mktemp)
        trap 'rm -f "$DPSLAVE_STEPS" "$DPSLAVE_STEPS".*' EXIT
    fi
    export DPSLAVE_STEPS CCACHE_STATSLOG=$DPSLAVE_STEPS.ccache
}
# The seconds of the step NAME so far; 0 without one.
seconds_of() { awk -v name="$1" '$1 == name { sum += $3 } END { print sum + 0 }' "$DPSLAVE_STEPS"; }
note_step() { printf '%s %s %s\n' "$1" "$2" "$3" >>"$DPSLAVE_STEPS"; }

# step NAME SECONDS COMMAND...: runs it, and goes on behind a failure. SECONDS is what it takes on a machine that builds the programs in
# 295 s. What takes three times as long hangs: it is ended and has failed. A machine that built them more slowly has so much more time.
step() {
    local name=$1 limit=$(($2 * 3)) began=$SECONDS status=0 programs running watching
    shift 2
    programs=$(seconds_of programs)
    [ "$programs" -le 295 ] || limit=$((limit * programs / 295))
    [ "$limit" -ge 60 ] || limit=60
    set -m # a process group of its own, which can be ended
    (set -e && "$@") </dev/null &
    running=$!
    (sleep "$limit" && echo "--- $name was ended: it had taken $limit s" | tee -a "$DPSLAVE_STEPS.failed" &&
        kill -TERM -- "-$running" && sleep 10 && kill -KILL -- "-$running") 2>/dev/null &
    watching=$!
    set +m
    trap 'kill -TERM -- "-$running" "-$watching" 2>/dev/null; exit 130' INT TERM
    wait "$running" || status=$?
    trap - INT TERM
    kill -TERM -- "-$watching" 2>/dev/null || true
    wait "$watching" 2>/dev/null || true
    note_step "$name" "$([ $status -eq 0 ] && echo ok || echo FAILED)" $((SECONDS - began))
}

# Prints the steps, what they took beside the build of the programs, and what failed. The exit status says whether all went well.
table_of_steps() {
    local all programs failed hits misses cold cold_all cold_programs
    say "Steps"
    awk '{ printf "%-12s %-6s %5d s\n", $1, $2, $3 }' "$DPSLAVE_STEPS"
    all=$(awk '$1 != "packages" { sum += $3 } END { print sum + 0 }' "$DPSLAVE_STEPS")
    programs=$(seconds_of programs)
    failed=$(awk '$2 == "FAILED"' "$DPSLAVE_STEPS" | wc -l)
    hits=$(grep -cE '^(direct|preprocessed)_cache_hit$' "$CCACHE_STATSLOG" 2>/dev/null || true)
    misses=$(grep -c '^cache_miss$' "$CCACHE_STATSLOG" 2>/dev/null || true)
    # What it took from nothing is kept in the compiler cache: it belongs to this machine, and to what it has compiled. The checks of
    # CMake are asked in each preset, so a few are always there.
    cold=$(ccache --get-config cache_dir)/dpslaved-seconds
    [ $((${hits:-0} * 10)) -ge $((${hits:-0} + ${misses:-0})) ] || [ "$failed" -ne 0 ] || echo "$all $programs" >"$cold"
    printf '%s s without the packages; the compiler cache had %s of %s units\n' "$all" "${hits:-0}" $((${hits:-0} + ${misses:-0}))
    if [ -e "$cold" ]; then
        read -r cold_all cold_programs <"$cold"
        printf 'From nothing: %s s, %s times the build of the programs (limit: 4)\n' "$cold_all" "$(ratio "$cold_all" "$cold_programs")"
        printf 'This run: %s of that (limit where the cache has everything: 0.5)\n' "$(ratio "$all" "$cold_all")"
    fi
    cat "$DPSLAVE_STEPS.failed" 2>/dev/null || true
    [ "$failed" -eq 0 ] || die "$failed steps failed: see the table"
    say "All checks passed"
}
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { if (b > 0) printf "%.2f", a / b; else print "?" }'; }

# Configures and builds one preset; further words are targets.
build() {
    local preset=$1
    shift
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

# What tools/check runs. Unit tests that run with the sanitizers, and not a second time without; the others run as they are shipped.
# The longest first.
sanitized=(gsd drive dp fdl modbus profile base control input io direction pcapng)
shipped=(dpctl configurator drive_line app_bus config app trace dpsim model drive_line_without_drives_apart stalls stalls_mutants report arguments tec led
    fdl_no_allocation dp_no_allocation simulated_captures)
sanitized_programs=("${sanitized[@]/#/build/asan/tests/test_}")
shipped_programs=("${shipped[@]/#/build/release/tests/test_}" 'build/release/tests/test_conformance=Simulated_*')
mapfile -t smoke_tests < <(sed -nE 's,^smoke ([a-z_]+) ([^ ]+) .*,build/release/tests/test_\1=\2,p' tests/gate.txt)
build_sanitized() { build asan "${sanitized[@]/#/test_}"; }
build_shipped() {
    local smoke
    mapfile -t smoke < <(sed -nE 's,^smoke ([a-z_]+) .*,test_\1,p' tests/gate.txt | sort -u)
    build release "${shipped[@]/#/test_}" test_conformance "${smoke[@]}" dpslave_impure
}
