#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# in_step.sh ROOT PROGRAM: fails if PROGRAM's --help has a command or an option that its man page, or its completion for
# bash or zsh, does not have, and if page or bash completion have one that PROGRAM does not.
set -euo pipefail
cd "$1"
program=$2
name=$(basename "$program")
page=$(echo "docs/man/$name".[18].scd)
# shellcheck source=/dev/null
source "config/completion/$name.bash"
compopt() { :; } # exists only during interactive completion
faults=0
fault() {
    echo "$*"
    faults=$((faults + 1))
}

# What the bash completion offers behind these words and the beginning of the next.
offered() {
    COMP_WORDS=("$name" "$@")
    COMP_CWORD=$#
    COMPREPLY=()
    "_$name"
    printf '%s\n' "${COMPREPLY[@]}" | sort -u
}
options_of() { "$program" "$@" --help | grep -oE '^  (-[a-z], )?--[a-z][a-z0-9-]*' | grep -oE -e '--[a-z0-9-]+' | sort -u; }
commands_of() { "$program" "$@" --help | awk '/^(Commands|Look|Watch|Operate|Offline|Version):/ { on = 1; next } /^[^ ]|^$/ { on = 0 } on && /^  [a-z]/ { print $1 }'; }

# compare MEANT IS WORDS...: two lists, one a line.
compare() {
    local meant=$1 is=$2 odd
    shift 2
    odd=$(comm -23 <(printf '%s\n' "$meant") <(printf '%s\n' "$is") | grep . || true)
    [ -z "$odd" ] || fault "bash completion of '$name $*' lacks: ${odd//$'\n'/ }"
    odd=$(comm -13 <(printf '%s\n' "$meant") <(printf '%s\n' "$is") | grep . || true)
    [ -z "$odd" ] || fault "bash completion of '$name $*' offers, but --help does not know: ${odd//$'\n'/ }"
}

known=$(mktemp)
trap 'rm -f "$known"' EXIT
walk() {
    local option command commands
    for option in $(options_of "$@"); do
        echo "$option" >>"$known"
        grep -qE -e "\*$option\*" "$page" || fault "$page does not have $option of '$name $*'"
        grep -qE -e "[')}*]${option}[[']|,$option}" "config/completion/_$name" || fault "zsh completion does not have $option of '$name $*'"
    done
    compare "$(options_of "$@")" "$(offered "$@" --)" "$@"
    commands=$(commands_of "$@" | sort -u)
    [ -n "$commands" ] || return 0
    # A word that is no command may be a station, of which there are none here.
    compare "$commands" "$(offered "$@" '' | grep -v '^-')" "$@"
    for command in $commands; do
        grep -qE -e "^\*(dpsim )?${*:+$* }$command[* ]" "$page" || fault "$page does not have '$name $* $command'"
        grep -qE -e "(^|[('\" |])$command([\\\\:)[]| \||$)" "config/completion/_$name" || fault "zsh completion does not have '$name $* $command'"
        walk "$@" "$command"
    done
}
walk

[ "$(sort -u "$known" | wc -l)" -ge 5 ] || fault "found next to no options in --help"
while read -r option; do
    grep -qxF -e "$option" "$known" || fault "$page has $option, but no --help does"
done < <(grep -oE -e '\*--[a-z][a-z0-9-]*\*' "$page" | tr -d '*' | sort -u)
while read -r option; do
    grep -qxF -e "$option" "$known" || fault "zsh completion has $option, but no --help does"
done < <(grep -oE -e '--[a-z][a-z0-9-]*\[' "config/completion/_$name" | tr -d '[' | sort -u)
[ "$faults" -eq 0 ]
