#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# service_asks.sh DPSLAVED ROOT QUESTION: what the unit asks the program, and what it must answer.
set -eu
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
file=$work/my.toml

# expect STATUS ARGUMENT...: the exit status; what was said is in $work/said.
expect() {
    wanted=$1
    shift
    status=0
    "$program" --config "$file" --profiles "$root/config/profiles" "$@" >"$work/said" 2>&1 || status=$?
    [ "$status" = "$wanted" ] || { cat "$work/said" && echo "dpslaved $*: $status instead of $wanted" && exit 1; }
}
says() { grep -F -e "$1" "$work/said" || { cat "$work/said" && echo "does not say: $1" && exit 1; }; }
silent() { [ ! -s "$work/said" ] || { cat "$work/said" && exit 1; }; }
root=$2

configure() {
    cat >"$file" <<END
[bus]
port = "$work/none"
baud = 187500
direction = "$1"
$2
[[line]]
name = "p3"
port = "$work/none-either"
protocol = "ei-ascii"
[[station]]
name = "unwinder"
address = 5
profile = "590"
line = "p3"
unit = "00"
END
}

case $3 in
    shipped) # skipped, and the log says what to edit
        cp "$root/config/dpslaved.toml" "$file"
        expect 1 --is-configured
        says "$file configures neither bus nor line nor station"
        expect 0 --release
        silent
        ;;
    faulty) # not "unconfigured": the start itself fails, and is not tried again
        echo 'bus = [' >"$file"
        expect 0 --is-configured
        silent
        expect 1
        says "$file:1"
        expect 0 --release
        ;;
    missing)
        expect 0 --is-configured
        expect 1
        says "$file"
        expect 0 --release
        ;;
    configured)
        for table in '[bus]' '[[line]]' '[[station]]'; do
            echo "$table" >"$file"
            expect 0 --is-configured
        done
        configure none ''
        expect 0 --is-configured
        silent
        expect 0 --check
        ;;
    release) # whatever is wrong, the unit's last step is no failure
        configure none ''
        expect 0 --release
        silent
        configure gpio 'gpio_chip = "/dev/no-such-chip"
gpio_line = 3'
        expect 0 --release
        says /dev/no-such-chip
        ;;
    usage)
        expect 2 --is-configured --check
        expect 2 --release --check
        expect 2 --release --is-configured
        expect 2 --no-such-option
        ;;
    *) echo "unknown question $3" && exit 2 ;;
esac
