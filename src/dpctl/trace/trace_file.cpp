// SPDX-License-Identifier: Apache-2.0
#include "trace_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dpslave::dpctl {
namespace {

std::string refusal(const std::string& path, const char* what)
{
    return path + " cannot be " + what + ": " + std::generic_category().message(errno);
}

} // namespace

Result<TraceFile, std::string> TraceFile::create(const std::string& path, pcapng::LinkType bus_link_type,
                                                 Order order)
{
    std::ofstream file{path, std::ios::binary | std::ios::trunc};
    if (!file) return Failure{refusal(path, "created")};
    TraceFile made{path, std::move(file), bus_link_type, order};
    made.write(pcapng::file_header(
        "dpctl trace",
        "Times are those of the first character, computed from the read, the length and the rate.", {}));
    return made;
}

void TraceFile::write(const pcapng::Octets& octets)
{
    file_.write(reinterpret_cast<const char*>(octets.data()), static_cast<std::streamsize>(octets.size()));
}

/// Its number. A new one is written: it stands before its packets.
std::uint32_t TraceFile::interface(const std::string& name, pcapng::LinkType link_type,
                                   const std::string& description)
{
    const auto type = static_cast<std::uint16_t>(link_type);
    const auto known = std::find_if(interfaces_.begin(), interfaces_.end(), [&](const Counted& one) {
        return one.interface.name == name && one.interface.link_type == type;
    });
    if (known != interfaces_.end()) return static_cast<std::uint32_t>(known - interfaces_.begin());
    interfaces_.push_back({.interface = {.link_type = type, .name = name, .description = description}});
    write(pcapng::block(interfaces_.back().interface));
    return static_cast<std::uint32_t>(interfaces_.size() - 1);
}

void TraceFile::lost(std::uint32_t interface, std::uint64_t count)
{
    interfaces_[interface].dropped += count;
    interfaces_[interface].dropped_before += count;
}

void TraceFile::add(std::uint32_t interface, pcapng::Packet packet)
{
    Counted& counted = interfaces_[interface];
    packet.interface = interface;
    if (const std::uint64_t dropped = std::exchange(counted.dropped_before, 0); dropped != 0)
        packet.dropped = dropped;
    ++counted.received;
    if (order_ == Order::by_time)
        kept_.push_back(std::move(packet));
    else
        write(block(packet));
}

void TraceFile::add(const trace::Entry& entry, const TraceWords& words, UnixOffset offset,
                    std::string_view note)
{
    if (entry.what == trace::Entry::What::lost) lost(bus(), entry.count);
    auto packet = packet_of(entry, words, offset);
    if (!packet) return;
    if (!note.empty()) packet->comments.emplace_back(note);
    add(bus(), *std::move(packet));
}

/// Wireshark's dissector knows such an interface by its name.
void TraceFile::add(const LineEntry& entry, UnixOffset offset, std::string_view note)
{
    const bool is_modbus = entry.protocol == drive::LineProtocol::modbus_rtu;
    const std::uint32_t number =
        interface("drive " + entry.line, link_type_of(entry.protocol), is_modbus ? "Modbus RTU" : "EI-ASCII");
    if (entry.what == LineEntry::What::lost) lost(number, entry.count);
    auto packet = packet_of(entry, offset);
    if (!packet) return;
    if (!note.empty()) packet->comments.emplace_back(note);
    add(number, *std::move(packet));
}

std::uint64_t TraceFile::packets() const
{
    std::uint64_t all = 0;
    for (const Counted& one : interfaces_) all += one.received;
    return all;
}

std::optional<std::string> TraceFile::finish(std::int64_t unix_ns)
{
    std::stable_sort(kept_.begin(), kept_.end(),
                     [](const auto& a, const auto& b) { return a.unix_ns < b.unix_ns; });
    for (const pcapng::Packet& packet : kept_) write(block(packet));
    for (std::size_t i = 0; i < interfaces_.size(); ++i)
        write(pcapng::block(pcapng::Statistics{.interface = static_cast<std::uint32_t>(i),
                                               .unix_ns = unix_ns,
                                               .received = interfaces_[i].received,
                                               .dropped = interfaces_[i].dropped}));
    file_.flush();
    if (!file_) return refusal(path_, "written");
    return std::nullopt;
}

} // namespace dpslave::dpctl
