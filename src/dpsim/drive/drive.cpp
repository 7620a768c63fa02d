// SPDX-License-Identifier: Apache-2.0
#include "drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

/// A message that stops in its middle is forgotten after this time, so that the EOT of the next one is never
/// taken for its block check.
constexpr auto kMessageGap = 500ms;
/// The connection lapses after this silence (seen at 650V drives; EI-ASCII reference, section 1).
constexpr auto kConnectionLapse = 10s;
constexpr std::size_t kLongestText = 40;

/// Identity words of this simulator; no source has those of the real drives.
constexpr std::string_view kSoftwareVersion = ">0100";
std::string_view identity(Model model)
{
    switch (model) {
        case Model::dc590: return ">0590";
        case Model::ac584s: return ">0584";
        case Model::ac: return ">0690";
        case Model::dc620: break;
    }
    return ">0620";
}

bool is_printable(std::uint8_t octet)
{
    return octet >= 0x20 && octet < 0x7F;
}

} // namespace

SimParameter* DriveUnit::find_mnemonic(std::string_view mnemonic)
{
    const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                    [&](const SimParameter& p) { return p.mnemonic == mnemonic; });
    return found == parameters_.end() || mnemonic.empty() ? nullptr : &*found;
}

bool DriveLine::add_unit(std::string_view address, const std::vector<SimTag>& tags)
{
    constexpr std::string_view kUnits = "0123456789ABCDEF";
    if (address.size() != 2 || address[0] < '0' || address[0] > '7' ||
        kUnits.find(address[1]) == std::string_view::npos)
        return false;
    if (std::any_of(units_.begin(), units_.end(), [&](const DriveUnit& u) { return u.address() == address; }))
        return false;
    std::vector<SimParameter> parameters;
    for (const SimTag& tag : tags) parameters.push_back({tag, naming_.name(tag), tag.start, std::nullopt});
    units_.emplace_back(std::string{address}, std::move(parameters));
    return true;
}

std::vector<Device*> DriveLine::devices()
{
    std::vector<Device*> all;
    for (DriveUnit& unit : units_) all.push_back(&unit);
    return all;
}

void DriveLine::on_bytes(Bytes octets, Instant now)
{
    const auto silence = now - heard_;
    if (silence > (phase_ == Phase::connected ? std::chrono::nanoseconds{kConnectionLapse} : kMessageGap))
        phase_ = Phase::idle;
    heard_ = now;
    for (const std::uint8_t octet : octets) on_octet(octet, now);
}

void DriveLine::on_octet(std::uint8_t octet, Instant now)
{
    if (phase_ == Phase::check)
        return selected(octet, now); // by state: the block check may look like EOT or NAK
    if (octet == kEot) {
        phase_ = Phase::address;
        text_.clear();
        polled_.clear();
        drop_reply();
        return;
    }
    switch (phase_) {
        case Phase::idle:
        case Phase::check: return;
        case Phase::address:
            collect(octet);
            if (text_.size() == 4) addressed();
            return;
        case Phase::body:
            if (octet == kStx && text_.empty()) {
                phase_ = Phase::select;
            } else if (octet == kEnq) {
                poll(text_, now);
            } else {
                collect(octet);
            }
            return;
        case Phase::select:
            if (octet == kEtx)
                phase_ = Phase::check;
            else
                collect(octet);
            return;
        case Phase::connected:
            if (octet == kStx) {
                phase_ = Phase::select;
                text_.clear();
                polled_.clear();
            } else if (octet == kNak && !polled_.empty()) {
                poll(std::string{polled_}, now);
            } else if (octet == kAck && !polled_.empty()) {
                poll_next(now);
            }
            return;
    }
}

void DriveLine::collect(std::uint8_t octet)
{
    if (!is_printable(octet) || text_.size() == kLongestText) return malformed();
    text_ += static_cast<char>(octet);
}

/// A malformed message gets no answer; only EE reports it (EI-ASCII reference, section 1).
void DriveLine::malformed()
{
    if (phase_ == Phase::body || phase_ == Phase::select) {
        units_[current_].error = Ee::message_format;
        ++units_[current_].bad_messages;
    }
    phase_ = Phase::idle;
}

void DriveLine::addressed()
{
    phase_ = Phase::idle;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const std::string& address = units_[i].address();
        if (text_[0] != address[0] || text_[1] != address[0] || text_[2] != address[1] ||
            text_[3] != address[1])
            continue;
        current_ = i;
        phase_ = units_[i].faults.silence ? Phase::idle : Phase::body;
    }
    text_.clear();
}

void DriveLine::poll(std::string_view mnemonic, Instant now)
{
    DriveUnit& unit = units_[current_];
    if (unit.faults.silence) return;
    if (mnemonic.size() != 2) return malformed();
    const SimParameter* const parameter = unit.find_mnemonic(mnemonic);
    std::string data;
    if (mnemonic == "EE") {
        data = fmt::format(">{:04X}", static_cast<unsigned>(unit.error));
    } else if (mnemonic == "II") {
        data = identity(model_);
    } else if (mnemonic == "V0") {
        data = kSoftwareVersion;
    } else if (parameter == nullptr || parameter->tag.access == TagAccess::write_only) {
        unit.error = parameter == nullptr ? Ee::invalid_mnemonic : Ee::write_only;
        ++unit.refusals;
        phase_ = Phase::idle;
        return answer({kEot}, parameter, now);
    } else {
        const auto text = unit.texts.find(parameter->tag.number);
        data =
            text != unit.texts.end() ? text->second : drive_text(model_, parameter->tag, parameter->at(now));
    }
    ++unit.reads;
    polled_ = mnemonic;
    phase_ = Phase::connected;
    answer(reply_frame(polled_, data), parameter, now);
}

/// After an ACK for a reply the drive sends the next parameter that can be read, by tag number; EOT after the
/// last.
void DriveLine::poll_next(Instant now)
{
    DriveUnit& unit = units_[current_];
    const SimParameter* const last = unit.find_mnemonic(polled_);
    for (const SimParameter& next : unit.parameters()) {
        const bool beyond = last == nullptr || next.tag.number > last->tag.number;
        if (beyond && next.tag.access != TagAccess::write_only && !next.mnemonic.empty())
            return poll(next.mnemonic, now);
    }
    phase_ = Phase::idle;
    answer({kEot}, nullptr, now);
}

void DriveLine::selected(std::uint8_t check, Instant now)
{
    DriveUnit& unit = units_[current_];
    phase_ = Phase::connected;
    polled_.clear();
    if (unit.faults.silence) return;
    Octets covered(text_.begin(), text_.end());
    covered.push_back(kEtx);
    Ee error = Ee::none;
    if (block_check(covered) != check)
        error = Ee::checksum;
    else if (text_.size() < 3)
        error = Ee::message_format;
    else if (unit.faults.nak && !text_.starts_with("EE")) // clearing the last error is never refused
        error = *unit.faults.nak;
    else
        error = write(std::string_view{text_}.substr(0, 2), std::string_view{text_}.substr(2));

    if (error != Ee::none) {
        unit.error = error;
        ++unit.refusals;
        log(unit, fmt::format("write '{}' refused, EE >{:04X}", text_, static_cast<unsigned>(error)));
    }
    answer({error == Ee::none ? kAck : kNak}, unit.find_mnemonic(std::string_view{text_}.substr(0, 2)), now);
}

Ee DriveLine::write(std::string_view mnemonic, std::string_view data)
{
    DriveUnit& unit = units_[current_];
    if (mnemonic == "EE") {
        unit.error = Ee::none; // whatever is written
        return Ee::none;
    }
    if (mnemonic == "II" || mnemonic == "V0") return Ee::read_only;
    SimParameter* const parameter = unit.find_mnemonic(mnemonic);
    if (parameter == nullptr) return Ee::invalid_mnemonic;
    if (parameter->tag.access == TagAccess::read_only) return Ee::read_only;
    auto value = drive_value(model_, parameter->tag, data);
    if (!value) return value.error();
    parameter->put(std::move(*value));
    ++unit.writes;
    log(unit,
        fmt::format("tag {} written {}", parameter->tag.number, displayed(parameter->tag, parameter->value)));
    return Ee::none;
}

void DriveLine::answer(Octets octets, const SimParameter* parameter, Instant now)
{
    const Concerned concerned = parameter != nullptr ? Concerned{parameter->tag.number, 1} : Concerned{};
    reply(units_[current_], units_[current_].faults, std::move(octets), concerned, now);
}

} // namespace dpslave::sim
