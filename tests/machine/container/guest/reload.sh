# SPDX-License-Identifier: Apache-2.0
# systemctl reload: judged whole, applied without silence for the others, or refused.
# shellcheck shell=bash disable=SC2034,SC2154 # what the files of the guest share

# What became of the telegrams since the start, as two numbers that stay what they are while every request to a station
# is answered: requests without reply (broadcasts and what came too late left out), and telegrams that were taken for
# another station's. A telegram that a busy machine has torn counts in neither. The smallest of some, because a request may
# just be under way.
lost() {
    for _ in 1 2 3 4 5; do
        dpctl counters | awk '
            /^[^ ]/ { group = $1 }
            group == "bus" { bus[$3] = $1 }
            group == "unwinder" && $3 == "global_control" { broadcasts = $1 }
            END {
                print bus["requests"] - bus["replies"] - bus["late"] - bus["overtaken"] - broadcasts,
                    bus["telegrams"] - bus["requests"]
            }'
    done | sort -n | head -n 1
}
has_lost_no_more_than() { [ "$(lost)" = "$1" ]; }
lost_exchanges() { # as the master counts them
    master 1 stats | grep -o -E '[0-9]+ times out of data exchange'
}
# answers ADDRESS: to a request of the master for its FDL status (SD1, FC 49).
answers() {
    local reply
    reply=$(master 1 "try send $(printf '10 %02X 02 49 %02X 16' "$1" $((($1 + 0x02 + 0x49) & 0xFF)))")
    grep -q "reply $1 to 2" <<<"$reply"
}
is_silent() { ! answers "$1"; }
shows() { grep -q -E -e "$1" <<<"$(dpctl status)"; }

# untouched COMMAND...: all the while unwinder exchanges data, in the same process, and no request goes unanswered.
untouched() {
    local pid left before exchanges
    pid=$(main_pid)
    left=$(counter unwinder left_data_exchange)
    before=$(lost)
    exchanges=$(lost_exchanges)
    "$@"
    goes_on_exchanging
    eventually has_lost_no_more_than "$before"
    expect_equal "what the master counts" "$(lost_exchanges)" "$exchanges"
    expect_equal "times that Data_Exch was left" "$(counter unwinder left_data_exchange)" "$left"
    expect_equal "process" "$(main_pid)" "$pid"
}

adds_a_station() {
    two_stations >"$config"
    is_silent 7
    { two_stations && station third 7 02; } >"$config"
    untouched expect_status 0 systemctl reload dpslaved
    eventually shows '^third +7 '
    eventually answers 7
    answers 5
    two_stations >"$config"
    untouched expect_status 0 systemctl reload dpslaved
    eventually is_silent 7
    answers 6
}
prove "given Data_Exchange, when a station is added and taken away by reload, then the other one goes on and no request is lost" \
    adds_a_station

refuses_faulty_file() {
    two_stations >"$config"
    mark
    { two_stations && station third 700 02; } >"$config"
    untouched expect_status 1 systemctl reload dpslaved
    eventually has_said "$config:$(grep -n 'address = 700' "$config" | cut -d: -f1):"
    expect_equal "state" "$(property dpslaved ActiveState)" active
    is_silent 7
    answers 6
    two_stations >"$config"
    expect_status 0 systemctl reload dpslaved
}
prove "given a faulty file, when it is reloaded, then that fails with file and line, and the old configuration goes on" \
    refuses_faulty_file

refuses_change_of_bus() {
    two_stations >"$config"
    mark
    two_stations | sed 's,/dev/ttyPB1,/dev/ttyPB2,' >"$config"
    untouched expect_status 1 systemctl reload dpslaved
    eventually has_said "[bus] port cannot change while the bus is served"
    two_stations >"$config"
    expect_status 0 systemctl reload dpslaved
}
prove "given another bus port, which would silence every station, when it is reloaded, then that is refused with the way out" \
    refuses_change_of_bus

keeps_address_pending() {
    two_stations >"$config"
    sed -i 's/address = 6/address = 8/' "$config"
    mark
    untouched expect_status 0 systemctl reload dpslaved
    answers 6
    is_silent 8
    eventually has_said "systemctl restart dpslaved"
    expect_text "$(dpctl show rewinder)" "8 pending"
    expect_status 0 systemctl restart dpslaved
    eventually exchanging
    shows '^rewinder +8 '
    answers 8
    is_silent 6
    two_stations >"$config"
    systemctl restart dpslaved
    eventually exchanging
}
prove "given an option board, when reload changes its address, then it keeps the old one until the service is restarted" \
    keeps_address_pending
