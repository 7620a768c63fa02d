// SPDX-License-Identifier: Apache-2.0
/// Records of a trace, as a daemon that is not ours might send them, or as they stand in the file of an
/// incident. Judged: a record is read as it was written; a damaged or cut file is refused; nothing is shown
/// that was not recorded; a telegram is one by its own arithmetic; and what is printed is printable.
#include "dpctl/decode_bench.hpp"
#include "dpctl/trace/incident.hpp"
#include "dpctl/trace/trace_decode.hpp"
#include "input.hpp"

#include "dpslave/trace/incident_file.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <numeric>

namespace {

using namespace dpslave;
using fuzz::demand;
using Octets = std::vector<std::uint8_t>;

constexpr dpctl::UnixOffset kOffset{std::chrono::seconds{1'700'000'000}};

std::uint8_t sum_of(Bytes octets)
{
    return static_cast<std::uint8_t>(std::accumulate(octets.begin(), octets.end(), 0U));
}

/// A frame of variable length around these octets.
Octets framed(Bytes body)
{
    const auto length = static_cast<std::uint8_t>(body.size());
    Octets frame{0x68, length, length, 0x68};
    frame.insert(frame.end(), body.begin(), body.end());
    frame.push_back(sum_of(body));
    frame.push_back(0x16);
    return frame;
}

bool is_telegram(Bytes octets)
{
    const std::size_t size = octets.size();
    if (size == 1) return octets[0] == 0xE5;
    if (size == 3) return octets[0] == 0xDC;
    const auto ends = [&](std::size_t from) {
        return octets[size - 1] == 0x16 && octets[size - 2] == sum_of(octets.subspan(from, size - from - 2));
    };
    if (size == 6 && octets[0] == 0x10) return ends(1);
    if (size == 14 && octets[0] == 0xA2) return ends(1);
    return size >= 9 && octets[0] == 0x68 && octets[3] == 0x68 && octets[1] == octets[2] &&
           octets[1] + 6U == size && ends(4);
}

bool is_one_line(std::string_view text)
{
    return std::ranges::all_of(text,
                               [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7F; });
}

trace::Record record_of(fuzz::Input& input, std::uint64_t number, Instant& at)
{
    trace::Record record{.number = number};
    const std::uint8_t form = input.octet();
    record.head.kind = static_cast<trace::Kind>((form & 0x0F) % trace::kKinds);
    record.head.more_follows = (form & 0x10) != 0;
    record.head.detail = input.octet();
    record.head.rate = static_cast<std::uint8_t>(input.octet() % kBauds.size());
    record.head.address = input.octet();
    record.head.begun = at;
    at += std::chrono::microseconds{input.word()};
    record.head.at = at;
    Octets octets;
    for (const std::uint8_t octet : input.octets(input.octet())) octets.push_back(octet);
    if ((form & 0x20) != 0 && octets.size() >= 3 && octets.size() <= 249) octets = framed(octets);
    record.octets.assign(octets);
    return record;
}

/// Written and read, it is the same.
void judge_wire_form(const trace::Record& record)
{
    Octets wire;
    append(record, wire);
    Bytes rest = wire;
    const auto read = trace::take_record(rest);
    demand(read && rest.empty(), "a record is read whole");
    Octets again;
    append(*read, again);
    demand(again == wire, "a record is read as it was written");
}

void judge_line(const dpctl::LineEntry& entry)
{
    const std::string words = dpctl::words_of(entry);
    demand(is_one_line(line_of(entry, words, kOffset, std::nullopt)), "a frame is one line");
    json_of(entry, words, kOffset).dump();
    const auto packet = packet_of(entry, kOffset);
    demand(packet && packet->octets == entry.octets, "a frame is a packet with its octets");
}

/// Entries of the bus: what they hold, and what is printed of them.
class Judge {
public:
    Judge()
    {
        decoder_.set_device(5, dpctl::technology_box());
        decoder_.set_device(6, dpctl::controller());
    }

    void judge(const trace::Entry& entry)
    {
        if (entry.what == trace::Entry::What::telegram)
            demand(is_telegram(entry.octets), "a telegram has its form and its checksum");
        const auto words = dpctl::words_of(entry);
        demand(!words.service.empty(), "an entry has a name");
        demand(is_one_line(line_of(entry, words, kOffset, std::nullopt)), "an entry is one line");
        json_of(entry, words, kOffset).dump();
        if (const auto packet = packet_of(entry, words, kOffset))
            demand(packet->octets == entry.octets, "a packet has the octets of its entry");
        if (const auto decoded = decoder_.decode(entry)) {
            const std::string details = render_details(*decoded, 4, false);
            demand(std::ranges::all_of(details,
                                       [](char c) {
                                           return c == '\n' || is_one_line({&c, 1});
                                       }),
                   "what it says is printable");
            decoded_json(*decoded).dump();
        }
        shown += entry.octets.size();
        lost += entry.count;
    }

    std::size_t shown = 0;  ///< octets
    std::uint64_t lost = 0; ///< records

private:
    dpctl::TraceDecoder decoder_;
};

std::vector<trace::Entry> judge_records(const std::vector<trace::Record>& records)
{
    trace::Telegrams telegrams;
    Judge judge;
    std::vector<trace::Entry> entries;
    std::size_t recorded = 0;
    for (const trace::Record& record : records) {
        judge_wire_form(record);
        const auto frame = dpctl::line_entry_of(record, "p3");
        const bool is_frame =
            record.head.kind >= trace::Kind::asked && record.head.kind <= trace::Kind::no_answer;
        demand(!frame || is_frame, "a frame of a drive line is recorded as one");
        if (frame) judge_line(*frame);
        recorded += record.octets.size() + (record.head.kind == trace::Kind::bad_character ? 1 : 0);
        telegrams.add(record);
    }
    if (!records.empty()) telegrams.pass_time(records.back().head.at + std::chrono::seconds{1});
    while (auto entry = telegrams.take()) {
        judge.judge(*entry);
        entries.push_back(*std::move(entry));
    }
    demand(judge.shown <= recorded, "no octet is shown that was not recorded");
    demand(judge.lost == 0, "nothing is lost that was there");
    return entries;
}

/// CRC-32 bit by bit.
std::uint32_t crc_of(Bytes octets)
{
    std::uint32_t crc = 0xFFFF'FFFF;
    for (const std::uint8_t octet : octets) {
        crc ^= octet;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB8'8320 : 0);
    }
    return ~crc;
}

void judge_head(std::string_view text, const std::vector<trace::Entry>& entries)
{
    const report::Json json = report::Json::parse(text, nullptr, false);
    if (!json.is_object()) return;
    const auto head = report::read<report::IncidentHead>(json);
    const std::string printed = dpctl::render_incident(head);
    demand(std::ranges::all_of(printed,
                               [](char c) {
                                   return c == '\n' || is_one_line({&c, 1});
                               }),
           "a head is printable");
    for (const trace::Entry& entry : dpctl::start_up(head.stations, entries))
        demand(is_telegram(entry.octets), "a start-up is of telegrams");
}

/// `head`: one line. `where`: of the octet that is damaged.
void judge_file(std::string_view head, const std::vector<trace::Record>& records, std::size_t where)
{
    const std::string begin = trace::incident_begin(head);
    Octets file{begin.begin(), begin.end()};
    for (const trace::Record& record : records) append(record, file);
    const std::uint32_t crc = crc_of(file);
    for (int i = 0; i < 4; ++i) file.push_back(static_cast<std::uint8_t>(crc >> 8 * i));

    const auto read = trace::read_incident(file);
    demand(read && read->head == head, "a file is read with its head");
    Bytes rest = read->records;
    for (const trace::Record& record : records) {
        const auto one = trace::take_record(rest);
        demand(one && one->number == record.number, "a file is read with its records");
    }
    demand(rest.empty(), "a file is read to its end");

    where %= file.size();
    demand(!trace::read_incident(Bytes{file}.first(where)), "a file that is cut is refused");
    file[where] ^= 0x10;
    demand(!trace::read_incident(file), "a file that is damaged is refused");
}

} // namespace

/// Begins with the head of an incident, as a line; then the place of the damage, and records.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzz::text_of(data, size);
    const std::string_view head = text.substr(0, text.find('\n'));
    fuzz::Input input{data + std::min(size, head.size() + 1), size - std::min(size, head.size() + 1)};
    const std::size_t where = input.word();
    std::vector<trace::Record> records;
    Instant at{std::chrono::seconds{1}};
    while (!input.at_end()) records.push_back(record_of(input, records.size(), at));
    const auto entries = judge_records(records);
    judge_head(head, entries);
    judge_file(head, records, where);
    return 0;
}
