// SPDX-License-Identifier: Apache-2.0
/// What the daemon reports and dpctl reads: one struct for each type of org.dpslaved.Control.varlink, which
/// says what a field means. A test compares both, field by field.
#pragma once

#include "dpslave/report/fields.hpp"

namespace dpslave::report {

struct Led {
    std::string name{}, sink{};
    bool lit = false;
    std::string pattern{};
    std::optional<std::string> trouble{};
    DPSLAVE_FIELDS(name, sink, lit, pattern, trouble)
};
struct StationLeds {
    std::string name{}, meaning{};
    std::vector<Led> leds{};
    DPSLAVE_FIELDS(name, meaning, leds)
};
struct Drive {
    std::string line{}, port{}, protocol{}, unit{}, link{};
    bool port_open = true, ever_answered = false;
    std::int64_t baud = 0;
    std::string format{}, direction{};
    std::int64_t timeout_ms = 0;
    std::optional<double> cycle_ms{};
    std::int64_t reads = 0, writes = 0, silences = 0, refusals = 0, losses = 0;
    std::optional<std::string> last_trouble{};
    std::optional<std::int64_t> not_zeroed{};
    std::optional<double> stalled_ms{};         ///< the line; null: it goes round
    std::optional<std::string> stalled_in{};    ///< the call of the port that it is in
    std::optional<std::string> port_settings{}; ///< what another program has changed of them last
    DPSLAVE_FIELDS(line, port, protocol, unit, link, port_open, ever_answered, baud, format, direction,
                   timeout_ms, cycle_ms, reads, writes, silences, refusals, losses, last_trouble, not_zeroed,
                   stalled_ms, stalled_in, port_settings)
};
struct Ride {
    std::optional<double> ends_in_ms{};
    DPSLAVE_FIELDS(ends_in_ms)
};
struct Station {
    std::string name{};
    std::int64_t address = 0;
    std::string profile{}, device{}, state{};
    std::optional<std::int64_t> master{}, watchdog_ms{};
    std::int64_t min_tsdr = 0, groups = 0;
    bool sync = false, freeze = false, clear = false, held = false;
    std::optional<std::string> held_because{};
    std::optional<Ride> ride{};
    std::optional<std::string> silent_because{};
    bool stat_diag = false, diag_pending = false;
    std::int64_t parameters = 0;
    bool demand_data = false;
    std::int64_t left_count = 0;
    std::optional<std::string> left_because{}, left_code{};
    Drive drive{};
    DPSLAVE_FIELDS(name, address, profile, device, state, master, watchdog_ms, min_tsdr, groups, sync, freeze,
                   clear, held, held_because, ride, silent_because, stat_diag, diag_pending, parameters,
                   demand_data, left_count, left_because, left_code, drive)
};
struct Unanswered {
    std::int64_t address = 0, master = 0, requests = 0;
    double age_ms = 0;
    DPSLAVE_FIELDS(address, master, requests, age_ms)
};
struct Bus {
    std::string port{};
    std::int64_t baud = 0;
    std::string baud_state{};
    std::optional<std::int64_t> configured_baud{};
    bool port_open = true, driver_works = true, listens = false;
    std::vector<Unanswered> unanswered{};
    std::int64_t stations = 0, exchanging = 0;
    std::optional<double> last_telegram_age_ms{};
    std::optional<std::string> trouble{}; ///< why the port or its driver enable cannot be had, a sentence
    std::optional<std::string> port_settings{}; ///< what another program has changed of them last
    DPSLAVE_FIELDS(port, baud, baud_state, configured_baud, port_open, driver_works, listens, unanswered,
                   stations, exchanging, last_telegram_age_ms, trouble, port_settings)
};
/// Of something that comes again and again.
struct Spacing {
    double min_ms = 0, mean_ms = 0, max_ms = 0;
    DPSLAVE_FIELDS(min_ms, mean_ms, max_ms)
};
struct Member {
    std::int64_t address = 0;
    bool ours = false, master = false, slave = false;
    std::string state{};
    std::optional<std::int64_t> ident{}, asked_by{};
    std::int64_t asked = 0, answers = 0, retries = 0, unanswered = 0;
    std::optional<double> last_heard_age_ms{}, last_asked_age_ms{};
    std::optional<Spacing> cycle{};
    double load_percent = 0;
    DPSLAVE_FIELDS(address, ours, master, slave, state, ident, asked_by, asked, answers, retries, unanswered,
                   last_heard_age_ms, last_asked_age_ms, cycle, load_percent)
};
struct Info {
    std::string name{}, profile{}, device{}, order_code{}, firmware{}, manual{};
    std::int64_t ident = 0, address_active = 0;
    std::optional<std::int64_t> address_pending{};
    std::int64_t address_min = 0, address_max = 0, max_parameters = 0, max_input_octets = 0;
    std::int64_t max_output_octets = 0, max_diag_octets = 0;
    bool demand_data = false, sync = false, freeze = false;
    std::vector<std::int64_t> bauds{}, max_tsdr{};
    std::optional<std::int64_t> tags_at{};
    std::vector<std::string> identifiers{};
    std::string tag_table{};
    std::int64_t tags_in_table = 0;
    std::optional<std::string> option_software{}, comms_status{}, resolution{};
    std::optional<std::string> mnemonic_rule{}, mnemonic_source{};
    bool mnemonics_assumed = false;
    std::vector<std::string> notes{};
    DPSLAVE_FIELDS(name, profile, device, order_code, firmware, manual, ident, address_active,
                   address_pending, address_min, address_max, max_parameters, max_input_octets,
                   max_output_octets, max_diag_octets, demand_data, sync, freeze, bauds, max_tsdr, tags_at,
                   identifiers, tag_table, tags_in_table, option_software, comms_status, resolution,
                   mnemonic_rule, mnemonic_source, mnemonics_assumed, notes)
};
struct TecRow {
    std::string name{}, generic_name{};
    bool input = false;
    std::int64_t value = 0;
    std::string shown{}, range{};
    DPSLAVE_FIELDS(name, generic_name, input, value, shown, range)
};
struct Tec {
    std::string name{}, view{};
    std::vector<TecRow> rows{};
    std::optional<std::string> trip{};
    std::optional<std::int64_t> trip_tag{};
    std::optional<bool> tripped{};
    std::vector<std::string> notes{};
    DPSLAVE_FIELDS(name, view, rows, trip, trip_tag, tripped, notes)
};
struct Word {
    std::int64_t tag = 0;
    std::optional<std::string> name{};
    std::string direction{};
    std::int64_t octet = 0, raw = 0;
    std::string value{}, state{};
    std::optional<std::string> answer{};
    std::optional<double> age_ms{};
    DPSLAVE_FIELDS(tag, name, direction, octet, raw, value, state, answer, age_ms)
};
struct Demand {
    std::vector<std::int64_t> request{}, reply{};
    std::string words{};
    DPSLAVE_FIELDS(request, reply, words)
};
struct StationIo {
    std::string name{};
    std::int64_t address = 0;
    std::string state{};
    bool may_write = false, clear = false, sync = false, freeze = false;
    std::vector<Word> words{};
    std::optional<Demand> demand{};
    DPSLAVE_FIELDS(name, address, state, may_write, clear, sync, freeze, words, demand)
};
struct StationWords {
    std::string name{};
    std::vector<Word> words{};
    DPSLAVE_FIELDS(name, words)
};
struct DiagOctet {
    std::int64_t octet = 0, offset = 0, value = 0;
    std::string meaning{};
    DPSLAVE_FIELDS(octet, offset, value, meaning)
};
struct Refusal {
    std::string code{}, telegram{}, what{};
    std::optional<std::int64_t> octet{};
    std::optional<std::string> expected{}, got{};
    std::string advice{};
    DPSLAVE_FIELDS(code, telegram, what, octet, expected, got, advice)
};
struct Unscaled {
    std::int64_t tag = 0;
    std::string direction{}, answer{};
    bool contradicted = false;
    DPSLAVE_FIELDS(tag, direction, answer, contradicted)
};
struct Denied {
    std::int64_t tag = 0;
    std::string direction{}, answer{};
    DPSLAVE_FIELDS(tag, direction, answer)
};
struct RefusedTag {
    std::int64_t tag = 0;
    bool write = false;
    std::string code{}, text{};
    DPSLAVE_FIELDS(tag, write, code, text)
};
struct Diagnosis {
    std::string name{};
    std::vector<DiagOctet> octets{};
    std::string hex{};
    std::vector<std::string> bits{};
    std::optional<Refusal> refusal{};
    std::string last_prm{}, last_cfg{};
    bool held = false;
    std::optional<std::string> scale_register{};
    std::vector<Unscaled> unscaled{};
    std::vector<Denied> denied{};
    std::vector<std::string> trouble{};
    std::vector<RefusedTag> refused{};
    DPSLAVE_FIELDS(name, octets, hex, bits, refusal, last_prm, last_cfg, held, scale_register, unscaled,
                   denied, trouble, refused)
};
struct Counter {
    std::string name{};
    std::int64_t value = 0;
    std::string meaning{};
    std::int64_t minute = 0;
    std::optional<double> last_age_ms{}, since_age_ms{};
    DPSLAVE_FIELDS(name, value, meaning, minute, last_age_ms, since_age_ms)
};
struct CounterGroup {
    std::string name{};
    std::vector<Counter> counters{};
    DPSLAVE_FIELDS(name, counters)
};
struct DistributionClass {
    std::int64_t from = 0;
    std::optional<std::int64_t> to{};
    std::int64_t count = 0;
    DPSLAVE_FIELDS(from, to, count)
};
struct Distribution {
    std::string unit{};
    std::int64_t count = 0, sum = 0;
    std::optional<std::int64_t> p50{}, p99{}, p999{}, highest{};
    std::vector<DistributionClass> classes{};
    DPSLAVE_FIELDS(unit, count, sum, p50, p99, p999, highest, classes)
};
struct Refresh {
    std::string station{}, line{};
    Distribution rounds{};
    DPSLAVE_FIELDS(station, line, rounds)
};
struct TagSpan {
    std::int64_t first = 0, last = 0;
    DPSLAVE_FIELDS(first, last)
};
struct RuleAnswers {
    std::string rule{};
    std::vector<std::int64_t> answering{}, denied{}, silent{}, unasked{};
    std::int64_t nameless = 0;
    DPSLAVE_FIELDS(rule, answering, denied, silent, unasked, nameless)
};
struct Answering {
    std::string protocol{};
    std::int64_t baud = 0;
    std::string format{}, unit{};
    std::optional<std::string> identity{}, version{}, device{};
    std::vector<RuleAnswers> rules{};
    std::vector<std::string> best_rules{};
    DPSLAVE_FIELDS(protocol, baud, format, unit, identity, version, device, rules, best_rules)
};
struct Log {
    std::string level{};
    std::optional<double> ends_in_ms{};
    DPSLAVE_FIELDS(level, ends_in_ms)
};
struct Event {
    std::int64_t number = 0;
    double age_ms = 0;
    std::optional<std::string> station{};
    std::string kind{}, text{};
    std::int64_t count = 0;
    DPSLAVE_FIELDS(number, age_ms, station, kind, text, count)
};
struct Sample {
    std::int64_t number = 0, unix_ms = 0;
    std::string state{};
    std::int64_t raw = 0;
    double scaled = 0;
    std::string value{};
    DPSLAVE_FIELDS(number, unix_ms, state, raw, scaled, value)
};
struct Incident {
    std::int64_t number = 0;
    std::string kind{};
    std::optional<std::string> station{};
    std::string reason{}, text{};
    std::int64_t count = 1, first_unix_ns = 0, last_unix_ns = 0, also = 0;
    DPSLAVE_FIELDS(number, kind, station, reason, text, count, first_unix_ns, last_unix_ns, also)
};
struct NamedTag {
    std::int64_t tag = 0;
    std::string name{};
    DPSLAVE_FIELDS(tag, name)
};
struct LeavingStation {
    std::string station{}, reason{};
    DPSLAVE_FIELDS(station, reason)
};

} // namespace dpslave::report
