// SPDX-License-Identifier: Apache-2.0
#include "replay_script.hpp"

#include <algorithm>

namespace dpslave::sim {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kLongestPause = std::chrono::hours{1}, kLongestCapture = std::chrono::hours{24 * 365};

bool is_drive(std::uint16_t link_type)
{
    return link_type == kEiAsciiLink || link_type == kModbusLink;
}

/// Returns whether the octets are complete telegrams back to back.
bool are_telegrams(Bytes octets)
{
    while (!octets.empty()) {
        const auto length = frame_length(octets);
        if (!length || *length == 0 || *length > octets.size() || !decode(octets.first(*length)))
            return false;
        octets = octets.subspan(*length);
    }
    return true;
}

/// `dpctl trace` marks a telegram of which it has only a part.
bool is_cut(const pcapng::Packet& packet)
{
    return std::any_of(packet.comments.begin(), packet.comments.end(),
                       [](const std::string& comment) { return comment.starts_with("cut: "); });
}

/// `dpctl trace` calls the interface of the line p3 "drive p3".
bool is_called(const pcapng::Interface& interface, const std::string& line)
{
    return interface.name == line || interface.name == "drive " + line;
}

/// Times of the packets since the first one, in their order. A file may have any times.
class Clock {
public:
    nanoseconds at(std::int64_t unix_ns)
    {
        if (!before_) before_ = unix_ns;
        if (unix_ns > *before_) {
            const std::uint64_t passed =
                static_cast<std::uint64_t>(unix_ns) - static_cast<std::uint64_t>(*before_);
            const auto most = static_cast<std::uint64_t>(kLongestPause.count());
            at_ += nanoseconds{static_cast<std::int64_t>(std::min(passed, most))};
            at_ = std::min(at_, kLongestCapture);
        }
        before_ = unix_ns;
        return at_;
    }

private:
    std::optional<std::int64_t> before_;
    nanoseconds at_{};
};

class Builder {
public:
    void bus(const pcapng::Packet& packet, std::size_t number, nanoseconds at)
    {
        const nanoseconds pause = bus_at_ ? at - *bus_at_ : nanoseconds{0};
        bus_at_ = at;
        if (packet.direction == pcapng::Direction::outbound) return answer(packet, number);
        // A capture may begin in the middle of a telegram: nobody answers the rest of it.
        is_telegram_ = are_telegrams(packet.octets);
        if (is_telegram_ || (!script.steps.empty() && !is_cut(packet)))
            script.steps.push_back({.octets = packet.octets, .packet = number, .at = at, .pause = pause});
    }

    void drive(const pcapng::Packet& packet, const pcapng::Interface& interface, nanoseconds at,
               const std::string& line)
    {
        auto& lines = script.drive_lines;
        if (std::find(lines.begin(), lines.end(), interface.name) == lines.end())
            lines.push_back(interface.name);
        if (line.empty() ? interface.name != lines.front() : !is_called(interface, line)) return;
        const std::uint16_t link_type = interface.link_type;
        script.is_modbus = link_type == kModbusLink;
        script.drive.push_back(
            {.octets = packet.octets, .to_drive = packet.direction == pcapng::Direction::outbound, .at = at});
    }

    ReplayScript script;
    bool has_direction = false;

private:
    /// A capture may begin after a request or in it, or lack a part of it: then there is none that this
    /// answers.
    void answer(const pcapng::Packet& packet, std::size_t number)
    {
        has_direction = true;
        if (!is_telegram_ || script.steps.empty() || script.steps.back().answer) return;
        script.steps.back().answer = packet.octets;
        script.steps.back().answer_packet = number;
    }

    std::optional<nanoseconds> bus_at_;
    bool is_telegram_ = false; ///< what was heard last
};

std::string no_bus(const pcapng::Capture& capture)
{
    std::string text = "it has no packets of PROFIBUS (link type 257 or 147)";
    const auto other = [](const pcapng::Interface& one) { return !pcapng::is_profibus(one.link_type); };
    const auto found = std::find_if(capture.interfaces.begin(), capture.interfaces.end(), other);
    return found == capture.interfaces.end()
               ? text
               : text + ", but of link type " + std::to_string(found->link_type);
}

} // namespace

Result<ReplayScript, std::string> script_of(const pcapng::Capture& capture, const std::string& line)
{
    Builder builder;
    Clock clock;
    std::optional<std::uint32_t> bus;
    for (std::size_t i = 0; i < capture.packets.size(); ++i) {
        const pcapng::Packet& packet = capture.packets[i];
        if (packet.is_part)
            return Failure{"packet " + std::to_string(i + 1) +
                           " was recorded only in part: record whole packets, without a snap length"};
        const pcapng::Interface& interface = capture.interfaces.at(packet.interface);
        const nanoseconds at = clock.at(packet.unix_ns);
        if (packet.octets.empty()) continue; // only a comment
        if (is_drive(interface.link_type)) builder.drive(packet, interface, at, line);
        if (!pcapng::is_profibus(interface.link_type)) continue;
        if (bus && *bus != packet.interface)
            return Failure{std::string{"it has two buses: keep the packets of one of them"}};
        bus = packet.interface;
        builder.bus(packet, i + 1, at);
    }
    if (!bus) return Failure{no_bus(capture)};
    if (!builder.has_direction)
        return Failure{std::string{
            "no packet of the bus is marked as sent: nothing says which telegrams are answers of the gateway"}};
    if (builder.script.steps.empty())
        return Failure{std::string{"it has no telegram that the gateway heard"}};
    return std::move(builder.script);
}

} // namespace dpslave::sim
