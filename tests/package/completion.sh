#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# completion.sh ROOT: fails if the bash completion of dpctl does not offer the stations and tags that the daemon names, with
# the socket and the station of the line, or if it says anything when no daemon answers.
set -euo pipefail
# shellcheck source=/dev/null
source "$1/config/completion/dpctl.bash"
compopt() { :; } # exists only during interactive completion
asked=$(mktemp)
trap 'rm -f "$asked"' EXIT

# In the place of the program: what a daemon of two stations says.
dpctl() {
    echo "$*" >"$asked"
    case "$*" in
        *"--json status") printf '{\n  "stations": [\n    {"name": "unwinder"},\n    {"name": "rewinder"}\n  ]\n}\n' ;;
        *"--json read --names"*) printf '{\n  "station": "unwinder",\n  "tags": [\n    {\n      "name": "SPEED FEEDBACK",\n      "tag": 7\n    },\n    {"name": "TORQUE", "tag": 9}\n  ]\n}\n' ;;
        *) return 3 ;;
    esac
}
expect() {
    local meant=$1
    shift
    COMP_WORDS=(dpctl "$@")
    COMP_CWORD=$#
    COMPREPLY=()
    _dpctl
    local is
    is=$(printf '%s|' "${COMPREPLY[@]}")
    [ "$is" = "$meant|" ] || { echo "after 'dpctl $*' it offers $is instead of $meant|" && exit 1; }
}

expect 'SPEED\ FEEDBACK|TORQUE' read ''
expect 'SPEED\ FEEDBACK' read SP
expect TORQUE read 7 TO
expect 'SPEED\ FEEDBACK|TORQUE' read --every 1s --station rewinder --socket /run/s ''
grep -qx -e '--socket /run/s --timeout 1 --json read --names --station rewinder' "$asked" || { echo "asked: $(cat "$asked")" && exit 1; }
expect 'unwinder|rewinder' read --station ''
expect rewinder events re
expect 'unwinder|rewinder' top --every 1s ''
expect 'debug|info' log-level ''

# Without a daemon: nothing, and no message in the middle of the line.
dpctl() {
    echo "dpctl: nothing answers" >&2
    return 3
}
said=$(expect '' read '' 2>&1) || { echo "$said" && exit 1; }
[ -z "$said" ] || { echo "without a daemon it says: $said" && exit 1; }
