// SPDX-License-Identifier: Apache-2.0
#include "capture.hpp"

#include "dpctl/cli/fields.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/dp/sap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace dpslave::dpctl {
namespace {

namespace fs = std::filesystem;
using Octets = std::vector<std::uint8_t>;
using What = trace::Entry::What;
using trace::Telegrams;

/// A busy bus at 187.5 kbit/s fills this in an hour.
constexpr std::size_t kMostOfACapture = 256U << 20;
/// Where in the data of a Set_Prm the Ident_Number is.
constexpr std::size_t kIdentInSetPrm = 4;

/// The failure is a clause.
Result<Octets, std::string> content_of(const std::string& path)
{
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
        return Failure{std::string{"there is no such file: write the path of a capture"}};
    if (error) return Failure{"it cannot be read: " + error.message()};
    if (!fs::is_regular_file(status))
        return Failure{std::string{"it is no file: write the path of a capture"}};
    std::ifstream file{path, std::ios::binary | std::ios::ate};
    if (!file) return Failure{"it cannot be read: " + std::generic_category().message(errno)};
    const std::streamoff size = file.tellg();
    if (size < 0) return Failure{std::string{"it cannot be read"}};
    if (static_cast<std::uint64_t>(size) > kMostOfACapture)
        return Failure{std::string{"it has more than 256 MiB: keep a part of it, with editcap or Wireshark"}};
    Octets octets(static_cast<std::size_t>(size));
    file.seekg(0);
    if (size > 0 && !file.read(reinterpret_cast<char*>(octets.data()), size))
        return Failure{std::string{"it cannot be read"}};
    return octets;
}

/// A file may have any time. Differences of these fit.
Instant instant_of(const pcapng::Packet& packet)
{
    constexpr std::int64_t kLatest = 4'000'000'000'000'000'000; // 2096
    return Instant{std::chrono::nanoseconds{std::clamp<std::int64_t>(packet.unix_ns, 0, kLatest)}};
}

void add(Bytes octets, Instant at, Telegrams& to)
{
    for (; !octets.empty(); octets = octets.subspan(std::min(octets.size(), trace::Record::kMostOctets))) {
        trace::Record record{.head = {.more_follows = octets.size() > trace::Record::kMostOctets, .at = at}};
        const Bytes part = octets.first(std::min(octets.size(), trace::Record::kMostOctets));
        record.octets.assign(Octets(part.begin(), part.end()));
        to.add(record);
    }
}

/// How many octets of an interface of the bus are the end of a telegram that began before the capture.
std::size_t cut_of(const pcapng::Capture& capture, std::uint32_t interface)
{
    constexpr std::size_t kEnough = 1024;
    Telegrams telegrams;
    Instant at{};
    std::size_t octets = 0;
    for (const pcapng::Packet& packet : capture.packets) {
        if (packet.interface != interface) continue;
        at += std::chrono::seconds{1};
        add(packet.octets, at, telegrams);
        octets += packet.octets.size();
        if (octets >= kEnough) break;
    }
    telegrams.pass_time(at + std::chrono::seconds{1});
    const auto first = telegrams.take();
    return first && first->what == What::cut ? first->octets.size() : 0;
}

/// Prints packets one after the other.
class PacketPrinter {
public:
    PacketPrinter(const pcapng::Capture& capture, const EntryPrinter& print)
        : capture_(capture), print_(print)
    {}

    void bus(const pcapng::Packet& packet)
    {
        lost(packet);
        if (packet.is_part) {
            cut_[packet.interface] = 0; // the next packet begins with a telegram
            return print(cut_entry(packet.octets), packet);
        }
        const auto [cut, is_first] = cut_.try_emplace(packet.interface, 0);
        if (auto entry = entry_of(packet)) {
            cut->second = 0;
            return print(*std::move(entry), packet);
        }
        if (is_first) cut->second = cut_of(capture_, packet.interface);
        print_pieces(packet, cut->second);
    }

    void drive(const pcapng::Packet& packet, const pcapng::Interface& interface)
    {
        if (packet.is_part) return; // a frame of which only the begin is there says nothing
        std::uint8_t& asked = asked_[packet.interface];
        auto entry = line_entry_of(packet, interface, asked);
        if (!entry) return;
        asked = entry->drive;
        entry->first = entry->last = instant_of(packet);
        if (packet.dropped && *packet.dropped > 0)
            print_.frame(gap_before(*entry, *packet.dropped), UnixOffset{}, {});
        print_.frame(*entry, UnixOffset{}, {});
    }

private:
    void print(trace::Entry entry, const pcapng::Packet& packet)
    {
        entry.at = entry.first = entry.last = instant_of(packet);
        entry.uncertainty = {};
        print_.telegram(entry, UnixOffset{}, note_of(packet));
    }

    static trace::Entry cut_entry(Bytes octets)
    {
        trace::Entry entry;
        entry.what = What::cut;
        entry.octets.assign(octets.begin(), octets.end());
        return entry;
    }

    void lost(const pcapng::Packet& packet)
    {
        if (!packet.dropped || *packet.dropped == 0) return;
        trace::Entry entry;
        entry.what = What::lost;
        entry.count = *packet.dropped;
        entry.at = entry.first = entry.last = instant_of(packet);
        print_.telegram(entry, UnixOffset{}, {});
    }

    /// What is no single telegram, as layer 2 would take it. `cut`: so many octets of it and of those behind
    /// it are cut.
    void print_pieces(const pcapng::Packet& packet, std::size_t& cut)
    {
        const std::size_t of_it = std::min(cut, packet.octets.size());
        cut -= of_it;
        if (of_it != 0) print(cut_entry(Bytes{packet.octets}.first(of_it)), packet);
        const Bytes rest = Bytes{packet.octets}.subspan(of_it);
        if (packet.character_error && !rest.empty()) {
            trace::Entry entry;
            entry.what = What::piece;
            entry.flaw = fdl::Flaw::character;
            entry.bad_characters = 1;
            entry.octets.assign(rest.begin(), rest.end());
            return print(std::move(entry), packet);
        }
        Telegrams telegrams{{}, Telegrams::Begin::at_telegram};
        add(rest, instant_of(packet), telegrams);
        telegrams.pass_time(instant_of(packet) + std::chrono::seconds{1});
        while (auto entry = telegrams.take()) print(*std::move(entry), packet);
    }

    const pcapng::Capture& capture_;
    const EntryPrinter& print_;
    std::map<std::uint32_t, std::size_t> cut_;    ///< by interface: octets that are still to be cut
    std::map<std::uint32_t, std::uint8_t> asked_; ///< by interface: the drive that was asked last
};

bool is_bus(const pcapng::Interface& interface)
{
    return pcapng::is_profibus(interface.link_type);
}

} // namespace

std::vector<std::string> lines_of(const pcapng::Capture& capture)
{
    std::vector<std::string> lines;
    for (const pcapng::Interface& interface : capture.interfaces)
        if (const auto line = line_called(interface);
            line && std::find(lines.begin(), lines.end(), *line) == lines.end())
            lines.push_back(*line);
    return lines;
}

std::string fault_of(const pcapng::Capture& capture, const TraceOptions& options)
{
    const auto lines = lines_of(capture);
    const std::string names = joined(lines, ", ");
    const bool has_bus = std::any_of(capture.interfaces.begin(), capture.interfaces.end(), is_bus);
    if (!options.line.empty() && std::find(lines.begin(), lines.end(), options.line) == lines.end())
        return lines.empty() ? "it has no drive line: leave out --line"
                             : fmt::format("it has no drive line '{}'; it has: {}", options.line, names);
    if (has_bus || !options.line.empty()) return {};
    if (!lines.empty())
        return options.file.empty() ? "it has no bus, only drive lines. Show one with --line: " + names
                                    : std::string{};
    if (capture.interfaces.empty()) return "it has no packets: make the capture again";
    return fmt::format(
        "it has no packets of PROFIBUS (link type 257 or 147), but of link type {}: name a capture of the bus",
        capture.interfaces.front().link_type);
}

std::map<std::uint8_t, std::uint16_t> idents_in(const pcapng::Capture& capture)
{
    std::map<std::uint8_t, std::uint16_t> idents;
    for (const pcapng::Packet& packet : capture.packets) {
        if (!is_bus(capture.interfaces.at(packet.interface)) || packet.is_part) continue;
        trace::Entry entry;
        entry.octets = packet.octets;
        const auto telegram = telegram_of(entry);
        if (telegram && telegram->is_request() && telegram->dsap == dp::sap::kSetPrm &&
            telegram->data.size() >= kIdentInSetPrm + 2)
            idents[telegram->da] = be16(telegram->data, kIdentInSetPrm);
    }
    return idents;
}

std::size_t left_out_of(const pcapng::Capture& capture)
{
    return static_cast<std::size_t>(
        std::count_if(capture.packets.begin(), capture.packets.end(), [&](const pcapng::Packet& packet) {
            const pcapng::Interface& interface = capture.interfaces.at(packet.interface);
            return !is_bus(interface) && !line_entry_of(packet, interface, 0);
        }));
}

void print_capture(const pcapng::Capture& capture, const EntryPrinter& print)
{
    PacketPrinter printer{capture, print};
    for (const pcapng::Packet& packet : capture.packets) {
        const pcapng::Interface& interface = capture.interfaces.at(packet.interface);
        if (is_bus(interface))
            printer.bus(packet);
        else
            printer.drive(packet, interface);
    }
}

Result<pcapng::Capture, int> open_capture(const TraceOptions& options, Terminal& terminal)
{
    const auto say = [&](const std::string& what) {
        terminal.err << "dpctl: " << printable(options.read) << ": " << printable(what) << '\n';
    };
    const auto octets = content_of(options.read);
    if (!octets) {
        say(octets.error());
        return Failure{int{kNo}};
    }
    std::error_code ignored; // a file that is not there is another one
    if (!options.file.empty() && fs::equivalent(options.read, options.file, ignored)) {
        say("--output names the file that is read: name another one");
        return Failure{int{kUsage}};
    }
    bool is_cut = false;
    auto capture = pcapng::read(*octets, &is_cut);
    if (!capture) {
        say(capture.error());
        return Failure{int{kNo}};
    }
    if (const std::string fault = fault_of(*capture, options); !fault.empty()) {
        say(fault);
        return Failure{options.line.empty() ? int{kNo} : int{kUsage}};
    }
    if (is_cut) say("it is cut off: the complete packets before that are shown");
    if (capture->packets.empty()) say("it has no packet");
    if (const auto parts = std::count_if(capture->packets.begin(), capture->packets.end(),
                                         [](const pcapng::Packet& one) { return one.is_part; });
        parts != 0)
        say(fmt::format(
            "packets recorded only in part: {}. Telegrams are shown as cut, frames of a drive line are left out: record whole packets",
            parts));
    if (const auto assumed = pcapng::assume_directions(*capture); assumed.packets != 0)
        say(in_words(assumed));
    if (const std::size_t left_out = left_out_of(*capture); left_out != 0)
        say(fmt::format(
            "packets left out: {}. They have another link type, or are of a drive line and do not say who sent them",
            left_out));
    return *std::move(capture);
}

} // namespace dpslave::dpctl
