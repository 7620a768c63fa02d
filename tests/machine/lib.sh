# SPDX-License-Identifier: Apache-2.0
# Shared by the machine tests, on the side of the host: where images are cached, how progress is printed, what is kept on
# failure. The side of the guest is guest.sh.
#
# tests/machine/STEP/run sources this file. tests/machine/run starts it as `run NAME` (NAME is the step as the user
# called it) with
#   DEBS          the packages under test, paths separated by blanks, of every architecture that was built, newest first
#   MACHINE_LOGS  an empty folder for what should be kept; it is removed when the step has passed
# and takes exit status 0 as passed. Run by hand, only DEBS is needed.
# shellcheck shell=bash
# shellcheck source=../../tools/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/lib.sh"

# shellcheck disable=SC2034 # for those who source this
machine=$project/tests/machine
machine_step=${1:-$(basename "$(dirname "$0")")}
machine_cache=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/dpslaved-machine
machine_logs=${MACHINE_LOGS:-$project/build/machine/$machine_step}
machine_began=$(date +%s%N)
[ -n "${MACHINE_LOGS:-}" ] || rm -rf "$machine_logs" # by hand: what the last run left
mkdir -p "$machine_cache" "$machine_logs"

# Seconds since a time of date +%s%N, with one decimal.
seconds_since() { awk -v a="$1" -v b="$(date +%s%N)" 'BEGIN { printf "%.1f", (b - a) / 1e9 }'; }

# One line of progress, with the seconds since the step began.
step() { printf '[%6.1f s] %s: %s\n' "$(seconds_since "$machine_began")" "$machine_step" "$*"; }

need_root() {
    [ "$(id -u)" -eq 0 ] || die "the step $machine_step $1, which only root may do: run it as root"
}

# The mirror of Debian that this host uses; DPSLAVED_MIRROR stands in where it has none.
debian_mirror() {
    local sites
    [ -z "${DPSLAVED_MIRROR:-}" ] || { echo "$DPSLAVED_MIRROR" && return; }
    # shellcheck disable=SC2016 # apt's own variable
    sites=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep '/debian/*$') ||
        die "apt names no mirror of Debian: give one in DPSLAVED_MIRROR, for example http://deb.debian.org/debian"
    head -n 1 <<<"$sites"
}

# bookworm, trixie: packages built on this host run on the same release.
debian_release() { sed -n 's/^VERSION_CODENAME=//p' /etc/os-release; }

# The path of the package NAME [ARCHITECTURE] among DEBS.
deb_of() {
    local name=$1 architecture=${2:-$(dpkg --print-architecture)} deb
    for deb in ${DEBS:-}; do
        case $(basename "$deb") in "${name}"_*_"$architecture".deb | "${name}"_*_all.deb) echo "$deb" && return ;; esac
    done
    die "DEBS names no package $name for $architecture: tools/package builds it, tests/machine/run hands it over"
}

# What these packages need beside each other, as names separated by commas: the first of each alternative.
dependencies_of() {
    local deb own=" "
    for deb in "$@"; do own+="$(dpkg-deb -f "$deb" Package) "; done
    for deb in "$@"; do dpkg-deb -f "$deb" Pre-Depends Depends | sed 's/^[A-Za-z-]*: //'; done |
        tr ',' '\n' | sed -E 's/[|(:].*//; s/[[:space:]]//g; /^$/d' | sort -u |
        while read -r name; do [[ $own == *" $name "* ]] || echo "$name"; done | paste -s -d ,
}

# A folder of the cache, made once: cached NAME MAKER ARGUMENTS... runs `MAKER FOLDER ARGUMENTS...` when there is no
# NAME yet, and prints the path. Two runs at the same time make it once; what was broken off is made again. Folders of
# the same kind (the part of NAME before its first dot) that were not used for two weeks are removed.
cached() {
    local name=$1 maker=$2 path=$machine_cache/$1
    shift 2
    (
        flock 9
        if [ ! -d "$path" ]; then
            step "making $path (once)" >&2
            rm -rf "$path.part"
            mkdir -p "$path.part"
            "$maker" "$path.part" "$@" >&2 || exit 1 # bash ignores set -e here: a maker looks at each of its commands
            mv "$path.part" "$path" || exit 1
        fi
        touch "$path"
        find "$machine_cache" -mindepth 1 -maxdepth 1 -type d -name "${name%%.*}.*" -mtime +14 -exec rm -rf {} +
    ) 9>"$machine_cache/${name%%.*}.lock" || die "$path could not be made"
    echo "$path"
}

# A short name for whatever the arguments say: the part of a cache's name that changes with its recipe.
fingerprint() { printf '%s\n' "$@" | sha256sum | cut -c 1-12; }

# Shows the lines of FILE as they come, until the process PID has ended.
follow() {
    touch "$1"
    tail -n +1 -s 0.2 -f --pid "$2" "$1" | sed -u 's/^/    /'
}

# Puts files into the log folder; those that are not there are left out.
keep() {
    local file
    for file in "$@"; do
        [ ! -e "$file" ] || cp -r "$file" "$machine_logs/"
    done
}
