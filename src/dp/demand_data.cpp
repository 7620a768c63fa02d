// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/demand_data.hpp"

namespace dpslave::dp {
namespace {

// Register 1: bits 15..12 command, bit 11 reserved (not looked at, answered 0), bits 10..0 tag.
constexpr std::uint16_t kTagField = 0x07FF;
constexpr std::uint16_t kMaxExtendedTag = 16'383;

enum : std::uint8_t {
    kNoCommand = 0,
    kRead = 1, // in a reply: transferred
    kWrite = 2,
    kExtendedRead = 3,
    kExtendedWrite = 4,
    kReject = 7,
};

constexpr bool is_extended(std::uint8_t command)
{
    return command == kExtendedRead || command == kExtendedWrite;
}

constexpr std::uint16_t first_word(std::uint8_t command, std::uint16_t tag)
{
    return static_cast<std::uint16_t>((command << 12) + tag);
}

// Error codes, before the personality's base.
constexpr std::uint16_t kInvalidTag = 0;
constexpr std::uint16_t kReadOnly = 1;
constexpr std::uint16_t kOutOfRange = 2;

} // namespace

std::optional<std::uint16_t> demand_code(AccessError error) noexcept
{
    switch (error) {
        case AccessError::none:
        case AccessError::not_kept: // taken: what the drive makes of it is its own business
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_understood:
        case AccessError::not_known: break;
        case AccessError::invalid_tag:
        case AccessError::unsupported_type:
        case AccessError::no_scale: // the manuals know no better one
        case AccessError::contradicted: return kInvalidTag;
        case AccessError::read_only:
        case AccessError::not_stopped:
        case AccessError::not_config_mode: return kReadOnly;
        case AccessError::out_of_range:
        case AccessError::does_not_fit:
        case AccessError::value_not_encoded: return kOutOfRange;
    }
    return std::nullopt;
}

void DemandData::begin(Generation generation)
{
    generation_ = generation;
    wanted_ = {};
    reply_ = {};
}

void DemandData::end()
{
    // A write that is still here was ordered by a master that is gone: it is not made after the safe state of
    // the outputs. A cancel that is still here is dropped with it and given anew, under the generation that
    // it ends.
    const bool unfetched = !orders_.empty();
    orders_.clear();
    if (unfetched || standing_.kind != DemandOrder::Kind::cancel) give(DemandOrder::Kind::cancel);
    reply_ = {};
}

DemandData::Wanted DemandData::wanted_by(const DemandRegisters& registers) const
{
    Wanted wanted;
    wanted.command = static_cast<std::uint8_t>(registers[0] >> 12);
    if (wanted.command == kNoCommand) return wanted; // the tag field does not matter
    wanted.tag_field = registers[0] & kTagField;
    if (personality_->demand == DemandForm::extended && is_extended(wanted.command))
        wanted.extended_tag = registers[1];
    if (wanted.command == kWrite || wanted.command == kExtendedWrite) wanted.value = registers[3];
    return wanted;
}

void DemandData::request(const DemandRegisters& registers)
{
    const Wanted wanted = wanted_by(registers);
    if (wanted == wanted_) return; // a standing read goes on, a write was executed once
    wanted_ = wanted;
    if (wanted.command == kNoCommand) {
        withdraw();
        reply_ = {};
    } else if (wanted.command == kRead || wanted.command == kWrite) {
        give(wanted.command == kRead ? DemandOrder::Kind::read : DemandOrder::Kind::write);
    } else if (is_extended_form() && wanted.tag_field == 0 && wanted.extended_tag <= kMaxExtendedTag) {
        give(wanted.command == kExtendedRead ? DemandOrder::Kind::read : DemandOrder::Kind::write);
    } else {
        withdraw();
        reject(kInvalidTag);
    }
}

void DemandData::give(DemandOrder::Kind kind)
{
    standing_ = {.kind = kind, .number = standing_.number + 1, .generation = generation_};
    if (kind != DemandOrder::Kind::cancel) {
        standing_.tag = is_extended(wanted_.command) ? wanted_.extended_tag : wanted_.tag_field;
        standing_.value = wanted_.value;
        ++ordered_;
    }

    // The last order was not fetched yet: a read or cancel is superseded, for only the newest can still be
    // answered. A write stays: a master that does not wait for its answer still wants it executed, and in
    // order.
    if (!orders_.empty() && orders_.newest().kind != DemandOrder::Kind::write) {
        orders_.newest() = standing_;
        return;
    }
    if (orders_.full()) {
        orders_.pop();
        ++lost_;
    }
    orders_.push(standing_);
}

void DemandData::withdraw()
{
    if (standing_.kind != DemandOrder::Kind::cancel) give(DemandOrder::Kind::cancel);
}

void DemandData::answer(const DemandAnswer& answer)
{
    if (standing_.kind == DemandOrder::Kind::cancel || answer.number != standing_.number) return;
    if (answer.error == AccessError::none || answer.error == AccessError::not_kept)
        accept(answer.value);
    else if (const auto code = demand_code(answer.error))
        reject(*code);
    // else no code stands for it: the previous answer stays
}

bool DemandData::is_extended_form() const
{
    return personality_->demand == DemandForm::extended && is_extended(wanted_.command);
}

/// The standard commands are answered alike in both forms: worked example 1 is as the table.
bool DemandData::as_example() const
{
    return is_extended_form() && personality_->extended_reply == ExtendedReply::example;
}

/// Worked example 2 has the request's own 3000 come back where the table has 1000. The handbook shows no
/// write; it calls the download the inverse of the upload, so the 4000 of a write comes back in the same way.
void DemandData::accept(std::uint16_t value)
{
    reply_with(first_word(as_example() ? wanted_.command : std::uint8_t{kRead}, tag_echo()), value);
}

void DemandData::reject(std::uint16_t code)
{
    // Worked example 2 adds the whole tag to 7000, also where it runs into the command: 37000 for 8328. A tag
    // that is none would run out of the word: it is answered as in the table.
    const bool adds_tag = as_example() && wanted_.extended_tag <= kMaxExtendedTag;
    const DemandRegisters before = reply_;
    reply_with(first_word(kReject, adds_tag ? wanted_.extended_tag : tag_echo()),
               static_cast<std::uint16_t>(code + personality_->demand_error_base));
    if (reply_ != before) ++rejected_; // a standing read that is refused at each refresh counts once
}

std::uint16_t DemandData::tag_echo() const
{
    return is_extended_form() ? std::uint16_t{0} : wanted_.tag_field;
}

void DemandData::reply_with(std::uint16_t first, std::uint16_t value)
{
    reply_ = {first, wanted_.extended_tag, std::uint16_t{0}, value};
}

} // namespace dpslave::dp
