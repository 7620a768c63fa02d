// SPDX-License-Identifier: Apache-2.0
#include "ei_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace dpslave::drive_line {
namespace {

constexpr std::uint8_t kStx = 0x02, kEtx = 0x03, kEot = 0x04, kEnq = 0x05, kAck = 0x06, kNak = 0x15;

Octets one(std::uint8_t octet)
{
    return Octets(1, octet);
}

std::uint8_t block_check(const std::string& covered)
{
    unsigned sum = 0;
    for (const char c : covered) sum ^= static_cast<unsigned char>(c);
    return static_cast<std::uint8_t>(sum);
}

std::string shown(std::span<const std::uint8_t> octets)
{
    std::string text;
    for (const std::uint8_t octet : octets) {
        switch (octet) {
            case kStx: text += "<STX>"; break;
            case kEtx: text += "<ETX>"; break;
            case kEot: text += "<EOT>"; break;
            case kEnq: text += "<ENQ>"; break;
            case kAck: text += "<ACK>"; break;
            case kNak: text += "<NAK>"; break;
            default:
                if (octet >= 0x20 && octet < 0x7F)
                    text += static_cast<char>(octet);
                else
                    text += fmt::format("<{:02X}>", octet);
        }
    }
    return text;
}

Octets frame(const std::string& mnemonic, const std::string& text)
{
    const std::string covered = mnemonic + text + static_cast<char>(kEtx);
    const std::string whole = static_cast<char>(kStx) + covered + static_cast<char>(block_check(covered));
    return {whole.begin(), whole.end()};
}

/// A signed number with its point, trailing zeros left out.
std::string text_of(const SimulatedTag& tag)
{
    const std::uint16_t word = tag.now().word;
    if (tag.is_word) return fmt::format(">{:04X}", word);
    const int counts = static_cast<std::int16_t>(word);
    int scale = 1;
    for (unsigned i = 0; i < tag.decimals; ++i) scale *= 10;
    const int magnitude = std::abs(counts);
    std::string text = fmt::format("{}{}.", counts < 0 ? "-" : "", magnitude / scale);
    if (tag.decimals > 0) text += fmt::format("{:0{}}", magnitude % scale, tag.decimals);
    while (text.back() == '0') text.pop_back();
    return text;
}

/// The word of a text in a write; nothing if it has another form.
std::optional<std::uint16_t> word_of(const SimulatedTag& tag, const std::string& text)
{
    if (tag.is_word) {
        if (text.size() < 2 || text[0] != '>') return std::nullopt;
        return static_cast<std::uint16_t>(std::strtoul(text.c_str() + 1, nullptr, 16));
    }
    const std::size_t point = text.find('.');
    if (point == std::string::npos) return std::nullopt;
    std::string digits = text.substr(0, point) + text.substr(point + 1);
    const std::size_t behind = text.size() - point - 1;
    if (behind > tag.decimals) return std::nullopt;
    digits.append(tag.decimals - behind, '0');
    return static_cast<std::uint16_t>(std::strtol(digits.c_str(), nullptr, 10));
}

/// Would a reader take it for a whole answer with its checksum?
bool is_valid(const Octets& octets)
{
    for (std::size_t at = 0; at + 5 <= octets.size(); ++at) {
        if (octets[at] != kStx) continue;
        unsigned sum = 0;
        for (std::size_t i = at + 1; i + 1 < octets.size(); ++i) {
            sum ^= octets[i];
            if (octets[i] == kEtx && octets[i + 1] == sum) return true;
        }
    }
    return false;
}

} // namespace

bool EiLine::write(Bytes octets)
{
    pass_until(time);
    const Instant ends = time + rules().character * static_cast<std::int64_t>(octets.size());
    if (traces())
        trace(fmt::format("{:.1f} ms: -> {}", double(time.time_since_epoch().count()) / 1e6, shown(octets)));
    question_on_the_wire(ends);
    if (rules().echo) {
        Instant at = time;
        for (const std::uint8_t octet : octets)
            arrived_.push_back({octet, (at += rules().character) + rules().port_holds});
        wire_is_busy_until(ends);
    }
    // EOT GID GID UID UID ...; here every group is 0
    if (octets.size() < 7 || octets[0] != kEot || octets[1] != '0' || octets[2] != '0' ||
        octets[3] != octets[4])
        return true;
    for (std::size_t i = 0; i < drives.size(); ++i)
        if (drives[i].unit + '0' == octets[3]) ask(i, Octets(octets.begin(), octets.end()), ends);
    return true;
}

std::size_t EiLine::read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout)
{
    const Instant until = time + std::max(timeout, Time{0});
    for (;;) {
        const Instant event = next_event();
        const Instant octet = arrived_.empty() ? kNever : arrived_.front().at;
        if (std::min(event, octet) > until) break;
        if (event <= octet) {
            happen(event);
            continue;
        }
        time = std::max(time, octet);
        std::size_t got = 0;
        while (got < into.size() && !arrived_.empty() && arrived_.front().at <= time) {
            into[got++] = arrived_.front().octet;
            arrived_.pop_front();
        }
        return got;
    }
    time = until;
    return 0;
}

void EiLine::discard()
{
    pass_until(time);
    while (!arrived_.empty() && arrived_.front().at <= time) arrived_.pop_front();
}

/// A value with a mnemonic that no other drive of the line has.
bool EiLine::names_its_drive(const Speech& speech) const
{
    if (speech.octets.front() != kStx) return false;
    const std::string mnemonic(speech.octets.begin() + 1, speech.octets.begin() + 3);
    if (mnemonic == "EE" || mnemonic == "V0" || mnemonic == "II") return drives.size() == 1;
    return std::ranges::count_if(drives, [&](const SimulatedDrive& drive) {
               return std::ranges::any_of(drive.tags,
                                          [&](const auto& tag) { return tag.mnemonic == mnemonic; });
           }) == 1;
}

void EiLine::heard(const Speech& speech, Instant begins)
{
    if (traces())
        trace(fmt::format("{:.1f} ms: <- {}{}", double(begins.time_since_epoch().count()) / 1e6,
                          speech.drive < 0 ? "noise " : fmt::format("drive {} ", speech.drive),
                          shown(speech.octets) + (speech.is_twice    ? " twice"
                                                  : speech.is_repeat ? " again"
                                                                     : "")));
    const auto length = static_cast<std::int64_t>(speech.octets.size());
    for (std::int64_t i = 0; i < (speech.is_twice ? 2 : 1) * length; ++i) {
        const std::int64_t place =
            speech.is_twice ? 2 * length : i + 1; // of both together, at the end of the second
        arrived_.push_back({speech.octets[static_cast<std::size_t>(i % length)],
                            begins + rules().character * place + rules().port_holds});
    }
}

std::optional<Octets> EiLine::carry_out(std::size_t index, const SimulatedDrive::Question& question)
{
    const std::string text(question.octets.begin() + 5, question.octets.end());
    if (text[0] != static_cast<char>(kStx)) {
        if (question.is_spoilt)
            return std::nullopt; // it has no checksum: parity shows it, and there is no answer
        if (text.size() != 3 || text[2] != static_cast<char>(kEnq)) return std::nullopt;
        return polled(index, text.substr(0, 2));
    }
    if (text.size() < 5) return std::nullopt;
    const std::string covered = text.substr(1, text.size() - 2);
    SimulatedDrive& drive = drives[index];
    if (question.is_spoilt || block_check(covered) != static_cast<std::uint8_t>(text.back())) {
        drive.ee = drive.remembers_spoilt ? 0x02C2 : 0x00C0;
        return one(kNak);
    }
    const bool taken =
        selected(index, covered.substr(0, 2), covered.substr(2, covered.size() - 3), question.carried_out);
    return one(taken ? kAck : kNak);
}

Octets EiLine::polled(std::size_t index, const std::string& mnemonic)
{
    SimulatedDrive& drive = drives[index];
    if (mnemonic == "EE") return frame(mnemonic, fmt::format(">{:04X}", drive.ee));
    if (mnemonic == "V0") return frame(mnemonic, ">0100");
    if (mnemonic == "II" && drive.knows_identity) return frame(mnemonic, ">0690");
    const SimulatedTag* const tag = drive.find_mnemonic(mnemonic);
    if (tag != nullptr && !tag->now().denied) return frame(mnemonic, text_of(*tag));
    drive.ee = 0x01C7;
    return one(kEot);
}

bool EiLine::selected(std::size_t index, const std::string& mnemonic, const std::string& text, Instant at)
{
    SimulatedDrive& drive = drives[index];
    const auto refuse = [&](std::uint16_t why) {
        drive.ee = why;
        return false;
    };
    if (mnemonic == "EE") {
        drive.ee = 0x00C0; // whatever is written
        return true;
    }
    SimulatedTag* const tag = drive.find_mnemonic(mnemonic);
    if (tag == nullptr || tag->now().denied) return refuse(0x01C7);
    if (tag->read_only) return refuse(0x05C8);
    const auto word = word_of(*tag, text);
    if (!word) return refuse(0x07C8);
    if (tag->refuses) return refuse(0x08C8);
    written(index, *tag, *word, at);
    return true;
}

Octets EiLine::spoilt(Octets answer)
{
    if (answer.size() == 1) return one(0x00); // parity shows it
    Octets broken = answer;
    switch (chance().below(3)) {
        case 0: broken[chance().below(broken.size())] = 0x00; break;
        case 1:
            broken.erase(broken.begin() + static_cast<std::ptrdiff_t>(chance().below(broken.size())));
            break;
        default: broken.resize(1 + chance().below(broken.size() - 1)); break;
    }
    return is_valid(broken) ? one(0x00) : broken;
}

Octets EiLine::noise()
{
    switch (chance().below(6)) {
        case 0: return one(kEot);
        case 1: return one(kNak);
        case 2: return one(kAck);
        case 3: return one(0x7F);
        case 4: return Octets(2, 0x00);
        default: return one(static_cast<std::uint8_t>(0x30 + chance().below(60)));
    }
}

} // namespace dpslave::drive_line
