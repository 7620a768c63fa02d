// SPDX-License-Identifier: Apache-2.0
#include "dpsim/drive.hpp"

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

/// Identity words of this simulator; no source tells those of the real drives.
constexpr std::string_view kSoftwareVersion = ">0100";
std::string_view identity(Model model)
{
    switch (model) {
        case Model::dc590: return ">0590";
        case Model::ac584s: return ">0584";
        case Model::dc620: break;
    }
    return ">0620";
}

bool is_printable(std::uint8_t octet)
{
    return octet >= 0x20 && octet < 0x7F;
}

} // namespace

SimValue Parameter::at(Instant now) const
{
    if (!motion) return value;
    const double ratio =
        static_cast<double>((now - motion->began).count()) / static_cast<double>(motion->takes.count());
    double part = std::clamp(ratio, 0.0, 1.0);
    if (motion->back_and_forth && ratio > 0) {
        const double turn = ratio - 2.0 * static_cast<double>(static_cast<std::int64_t>(ratio / 2.0));
        part = turn <= 1.0 ? turn : 2.0 - turn;
    }
    const double counts = motion->from + (motion->to - motion->from) * part;
    return {static_cast<std::int32_t>(counts < 0 ? counts - 0.5 : counts + 0.5), {}};
}

Parameter* DriveUnit::find(std::uint16_t tag)
{
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const Parameter& p) { return p.tag.number == tag; });
    return found == parameters.end() ? nullptr : &*found;
}

Parameter* DriveUnit::find_mnemonic(std::string_view mnemonic)
{
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const Parameter& p) { return p.mnemonic == mnemonic; });
    return found == parameters.end() || mnemonic.empty() ? nullptr : &*found;
}

bool DriveLine::add_unit(std::string_view address, const std::vector<SimTag>& tags)
{
    constexpr std::string_view kUnits = "0123456789ABCDEF";
    if (address.size() != 2 || address[0] < '0' || address[0] > '7' ||
        kUnits.find(address[1]) == std::string_view::npos)
        return false;
    if (std::any_of(units_.begin(), units_.end(), [&](const DriveUnit& u) { return u.address == address; }))
        return false;
    DriveUnit unit{.address = std::string{address}};
    for (const SimTag& tag : tags)
        unit.parameters.push_back(
            {tag, tag.mnemonic.empty() ? mnemonic_of(tag.number) : tag.mnemonic, tag.start, std::nullopt});
    units_.push_back(std::move(unit));
    return true;
}

std::optional<Octets> DriveLine::take_reply(Instant now)
{
    if (!reply_ || now < reply_->due) return std::nullopt;
    return std::exchange(reply_, std::nullopt)->octets;
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
        reply_.reset();
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

/// A message without form gets no answer; only EE tells (EI-ASCII reference, section 1).
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
        const std::string& address = units_[i].address;
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
    const Parameter* const parameter = unit.find_mnemonic(mnemonic);
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
        return reply({kEot}, now);
    } else {
        data = drive_text(model_, parameter->tag, parameter->at(now));
    }
    ++unit.reads;
    polled_ = mnemonic;
    phase_ = Phase::connected;
    reply(reply_frame(polled_, data), now);
}

/// ACK after a reply: the next parameter that can be read, by tag number; EOT behind the last.
void DriveLine::poll_next(Instant now)
{
    DriveUnit& unit = units_[current_];
    const Parameter* const last = unit.find_mnemonic(polled_);
    for (const Parameter& next : unit.parameters) {
        const bool beyond = last == nullptr || next.tag.number > last->tag.number;
        if (beyond && next.tag.access != TagAccess::write_only && !next.mnemonic.empty())
            return poll(next.mnemonic, now);
    }
    phase_ = Phase::idle;
    reply({kEot}, now);
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
    else if (unit.faults.nak)
        error = *unit.faults.nak;
    else
        error = write(std::string_view{text_}.substr(0, 2), std::string_view{text_}.substr(2));

    if (error != Ee::none) {
        unit.error = error;
        ++unit.refusals;
        log(fmt::format("write '{}' refused, EE >{:04X}", text_, static_cast<unsigned>(error)));
    }
    reply({error == Ee::none ? kAck : kNak}, now);
}

Ee DriveLine::write(std::string_view mnemonic, std::string_view data)
{
    DriveUnit& unit = units_[current_];
    if (mnemonic == "EE") {
        unit.error = Ee::none; // whatever is written
        return Ee::none;
    }
    if (mnemonic == "II" || mnemonic == "V0") return Ee::read_only;
    Parameter* const parameter = unit.find_mnemonic(mnemonic);
    if (parameter == nullptr) return Ee::invalid_mnemonic;
    if (parameter->tag.access == TagAccess::read_only) return Ee::read_only;
    auto value = drive_value(model_, parameter->tag, data);
    if (!value) return value.error();
    parameter->value = std::move(*value);
    parameter->motion.reset();
    ++unit.writes;
    log(fmt::format("tag {} written {}", parameter->tag.number, displayed(parameter->tag, parameter->value)));
    return Ee::none;
}

void DriveLine::reply(Octets octets, Instant now)
{
    const DriveFaults& faults = units_[current_].faults;
    if (faults.bad_bcc && octets.size() > 1) octets.back() = static_cast<std::uint8_t>(octets.back() ^ 0x01);
    if (faults.garbage)
        for (std::uint8_t& octet : octets) octet = static_cast<std::uint8_t>(random_() & 0x7F);
    reply_ = Reply{std::move(octets), now + turnaround_ + faults.slow};
}

void DriveLine::log(std::string_view words)
{
    if (!logging_) return;
    const std::string who = units_.size() > 1 ? "unit " + units_[current_].address + ": " : std::string{};
    log_.push_back(who + std::string{words});
}

} // namespace dpslave::sim
