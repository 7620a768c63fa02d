#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# blocking_calls.sh ROOT: holds the calls of the daemon that may block against the table of docs/internals/blocking-calls.md. Fails if
# one stands in a source that the table does not name for this kind, or if the table names a source that has none.
set -eu
cd "$1"
page=docs/internals/blocking-calls.md

# kind: what a source of the daemon looks like that makes such a call. System calls have their :: in front.
kinds='open: (^|[^A-Za-z0-9_>])::(open|openat|posix_openpt)\(
close: (^|[^A-Za-z0-9_>])::close\(
read: (^|[^A-Za-z0-9_>])::(read|pread|readv|eventfd_read)\(
write: (^|[^A-Za-z0-9_>])::(write|pwrite|writev|eventfd_write)\(
ioctl: \b(ioctl|tc[gs]etattr|tcdrain|tcflush|tcflow|tcsendbreak)\(
wait: \b(ppoll|epoll_p?wait2?|sigwait[a-z]*|waitpid)\(|(^|[^A-Za-z0-9_>])::(poll|select|pselect|wait)\(|\bepoll_?\.wait\(
lock: \b(flock|lockf)\(
look: (^|[^A-Za-z0-9_>])::(stat|fstat|lstat|access|readlink|isatty|ttyname_r)\(
folder: \b(fsync|fdatasync|fchmod|fchown)\(|(^|[^A-Za-z0-9_>])::(rename|unlink|mkdir|rmdir|chmod|chown|link|symlink|opendir|truncate|ftruncate)\(
stream: std::[io]?fstream\b|\bfopen\(
path: \b(fs|filesystem)::(weakly_canonical|canonical|exists|file_size|last_write_time|(recursive_)?directory_iterator|create_[a-z_]+|remove|remove_all|rename|copy[a-z_]*|is_[a-z_]+|status|space|read_symlink|permissions|absolute|resize_file|equivalent)\b
gpio: \bgpiod_[a-z_]+\(
names: \bget(gr|pw)(nam|gid|uid|ent)(_r)?\(|\bgetgrouplist\(|\bgetaddrinfo\(
log: \bspdlog::(trace|debug|info|warn|error|critical|log)\(|\bsyslog\(|\bstd::(cout|cerr|clog)\b|\bf?printf\(
manager: \bsd_[a-z_]+\(
socket: (^|[^A-Za-z0-9_>])::(bind|listen|accept4?|connect|send|sendto|sendmsg|recv|recvfrom|recvmsg|shutdown)\(
memory: \b(mlock|mlockall|munlock|munlockall|madvise|mmap|munmap)\(
mutex: \bstd::(mutex|lock_guard|unique_lock|scoped_lock|shared_mutex|shared_lock)\b
condition: \bstd::(condition_variable|future|promise|async|latch|barrier|counting_semaphore|binary_semaphore)\b
thread: \bstd::j?thread\b|\bthread_?\.join\(
sleep: \b(sleep_for|sleep_until|nanosleep|clock_nanosleep|usleep)\(
modbus: \bmodbus_(send|receive|read|write|connect|flush|close)[a-z_]*\(
'
# The functions of this program that make such calls. Whoever calls them chooses the thread.
own='edge: \bDriverEnable::(open|release)\(|\bGpioLine::request\(|\bdriver_\.(take|attach|detach|self_check|ready|set|drop_if_stuck)\(
port: \b(Tty|Port|SwitchedPort|RtuLine|ModbusRtu|LineBackend)::open\(|\bport_(\.|->)(open|close|lose|refuse|ready|exchange|give_up|set_baud|write)\(
tty: \btty(\(\))?\.(read|write|send|discard_[a-z]+|transmitter_empty|wait_readable|bauds)\(
lamp: \bopen_led_sink\b|\bled(\.reset|->set)\(
file: \b(load_config|gpio_target|led_sink_target|operator_group_of|port_trouble|canonical|read_regular_file|names_in|NewFile)\b|\bapp::keep\(
job: \bjob_?\.wait\(|\bfile_\.settle\(|\.await_first_try\(
'
# What is linked into dpslaved: all but the other programs, the pages, and what only those use.
others='configurator|cockpit|page|pcapng|dpctl|dpsim'
sources=$(find src include/dpslave -name '*.[ch]pp' | grep -vE "^(src|include/dpslave)/($others)/" | sort)

lists=$(mktemp -d)
trap 'rm -rf "$lists"' EXIT
# FILE<tab>LINE of the code, FILE as the table has it, without includes and what is behind //.
code() {
    awk -v OFS='\t' '/^[ \t]*#[ \t]*include/ { next }
        { file = FILENAME; sub("^(src|include/dpslave)/", "", file); sub("[.].pp$", "", file); print file, $0 }' "$@" |
        sed -E 's,([^:"])//.*,\1,'
}
code $sources >"$lists/all"
# A header declares the functions of the second list, and io has them.
code $(printf '%s\n' "$sources" | grep -vE '[.]hpp$|^src/io/') >"$lists/users"
# KIND<tab>FILE
found() {
    printf '%s' "$2" | while read -r kind pattern; do
        grep -E "$pattern" "$lists/$1" | cut -f1 | sort -u | sed "s/^/${kind%:}\t/"
    done
}
{ found all "$kinds"; found users "$own"; } | sort -u >"$lists/found"

# | `kind` | `file`, `file` | thread | what bounds it |
sed -nE 's/^\| `([a-z]+)` \| ([^|]+) \| [^|]+ \| [^|]+ \|$/\1 \2/p' "$page" | while read -r kind files; do
    printf '%s\n' "$files" | grep -oE '`[^`]+`' | sed "s/\`\(.*\)\`/$kind\t\1/"
done | sort >"$lists/rows"
sort -u "$lists/rows" >"$lists/listed"
wrong=0
# say WORDS LINES
say() { [ -z "$2" ] || { printf '%s\n%s\n' "$1" "$2" >&2; wrong=1; }; }
say "calls that may block, which $page does not name:" "$(comm -23 "$lists/found" "$lists/listed")"
say "$page names calls that are not there:" "$(comm -13 "$lists/found" "$lists/listed")"
say "$page names twice:" "$(uniq -d "$lists/rows")"
exit $wrong
