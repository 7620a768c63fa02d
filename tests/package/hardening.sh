#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# hardening.sh PROGRAM OPTIMISED: fails if the program lacks one of the protections that every build has; the calls that
# check their bounds only where OPTIMISED is not 0.
set -eu
for tool in readelf objdump; do
    command -v "$tool" >/dev/null || { echo "$tool is not installed" && exit 77; }
done
missing=0
# has WHAT PATTERN OPTION...: what readelf says matches.
has() {
    what=$1 pattern=$2
    shift 2
    readelf -W "$@" "$program" | grep -Eq -- "$pattern" || { echo "$program: no $what" && missing=1; }
}
program=$1
has "position independent program" 'Type: +DYN \(Position-Independent' --file-header
has "read-only relocations" 'GNU_RELRO' --program-headers
has "binding at the start" 'BIND_NOW|FLAGS_1.*NOW' --dynamic
has "stack that is not executable" 'GNU_STACK.* RW ' --program-headers
has "guards of the stack" '__stack_chk_fail' --dyn-syms
[ "$2" = 0 ] || has "calls that check their bounds" '__[a-z]+_chk@' --dyn-syms
# The note that says so for the whole program is lost at the link with the C library's start code, which has none.
case $(uname -m) in
    x86_64) pad=endbr64 ;;
    aarch64) pad='bti|paciasp' ;;
    *) pad= ;;
esac
[ -z "$pad" ] || objdump --disassemble=main "$program" | grep -Eq "$pad" ||
    { echo "$program: no landing pads for indirect calls" && missing=1; }
exit $missing
