// SPDX-License-Identifier: Apache-2.0
#include "ei_access.hpp"

#include "drive/digits.hpp"

#include <algorithm>
#include <array>

namespace dpslave::drive::ei {
namespace {

constexpr Mnemonic kVersion{'V', '0'};
constexpr std::uint8_t kChecksumError = 0x02;  ///< high octet of EE
constexpr std::string_view kNoError = ">0000"; ///< any write of EE sets it to "no error"

/// An invalid tag is believed when the drive has said so twice: a request can be spoilt into one for a tag
/// that it does not have.
constexpr int kTimesInvalid = 2;

bool is_denial(AccessError error)
{
    return error == AccessError::invalid_tag || error == AccessError::unsupported_type;
}

} // namespace

Access::End Access::poll(UnitAddress unit, Mnemonic mnemonic)
{
    const End end = exchange_.poll(unit, mnemonic);
    if (end == End::value || end == End::older)
        ++values_;
    else
        ee_is_0_.erase(number_of(unit));
    trouble_ = exchange_.trouble();
    return end;
}

Access::End Access::select(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
{
    const End end = exchange_.select(unit, mnemonic, text);
    if (end != End::ack) ee_is_0_.erase(number_of(unit));
    trouble_ = exchange_.trouble();
    return end;
}

AccessError Access::ended(End end)
{
    switch (end) {
        case End::value:
        case End::older:
        case End::ack: return AccessError::none;
        case End::before: trouble_ = "an answer that may be older than the last write"; break;
        case End::doubtful: trouble_ = "an ACK that may belong to another write"; break;
        case End::refused: return AccessError::not_understood;
        case End::silence:
        case End::damaged: return AccessError::no_answer;
        case End::not_asked: break;
    }
    return AccessError::deferred;
}

AccessError Access::read(UnitAddress unit, Mnemonic mnemonic)
{
    if (exchange_.owes(unit, mnemonic)) {
        const AccessError error = clear(unit);
        if (error == AccessError::no_answer) return error;
    }
    const End end = poll(unit, mnemonic);
    if (end == End::refused) return read_denied(unit, mnemonic);
    const AccessError error = ended(end);
    if (error != AccessError::none) return error;
    text_ = exchange_.answer();
    denied_.erase({number_of(unit), mnemonic});
    return error;
}

/// A mnemonic that no station reads and no drive of the line owes, for which this one gives a value as far as
/// is known. None that it owes itself: each answer would leave one owed again, and nothing would ever settle.
std::optional<Mnemonic> Access::spare(UnitAddress unit)
{
    const auto is_free = [&](Mnemonic one) {
        return exchange_.may_poll(unit, one) && !exchange_.is_owed(one);
    };
    for (const Mnemonic one : {kIdentity, kVersion})
        if (is_free(one) && without_.count({number_of(unit), one}) == 0) return one;
    for (const Mnemonic one : {kLastError, kIdentity, kVersion})
        if (is_free(one)) return one;
    return std::nullopt;
}

/// Ends what the drive owes by a value of another mnemonic.
AccessError Access::clear(UnitAddress unit)
{
    exchange_.listen(); // what is owed may have come, or have settled
    const auto mnemonic = spare(unit);
    if (!mnemonic) {
        trouble_ = "too many answers are owed on this line";
        return AccessError::deferred;
    }
    const End end = poll(unit, *mnemonic);
    if (end == End::value) without_.erase({number_of(unit), *mnemonic});
    if (end == End::older) return AccessError::deferred; // it is there, and still owes
    if (end != End::refused) return ended(end);
    without_.insert({number_of(unit), *mnemonic});
    return *mnemonic == kLastError ? AccessError::not_understood : ask_ee(unit);
}

/// none: ee_ is what the drive says now; anything else: nothing is known.
AccessError Access::ask_ee(UnitAddress unit)
{
    if (exchange_.owes(unit, kLastError)) { // another one would only be owed in its place
        trouble_ = "an earlier answer for EE is still owed";
        return AccessError::deferred;
    }
    const End end = poll(unit, kLastError);
    if (end == End::older) return AccessError::not_understood; // it may have been asked for before
    const AccessError error = ended(end);
    if (error != AccessError::none) return error;
    const auto word = decode_word(exchange_.answer());
    if (!word) return AccessError::not_understood;
    ee_ = *word;
    if (high(ee_) == 0) ee_is_0_.insert(number_of(unit));
    return AccessError::none;
}

/// Afterwards only what is refused from now on changes EE. The answer to the write proves nothing: EE is
/// read.
AccessError Access::set_ee_to_0(UnitAddress unit)
{
    if (ee_is_0_.count(number_of(unit)) != 0) return AccessError::none;
    const AccessError written = ended(select(unit, kLastError, kNoError));
    if (written == AccessError::no_answer) return written;
    const AccessError read = ask_ee(unit);
    if (read != AccessError::none) return read;
    return high(ee_) == 0 ? AccessError::none : AccessError::not_understood;
}

void Access::note_ee(std::string_view what)
{
    trouble_ = std::string{what} + ", EE " + hex_text(ee_, 4) + " (" + std::string{meaning_of_ee(ee_)} + ")";
}

/// Asks again with EE at 0: does the drive itself say why? `written`: of a write, its text.
AccessError Access::prove(UnitAddress unit, Mnemonic mnemonic, std::optional<std::string_view> written,
                          int times)
{
    const std::uint8_t reason = high(ee_);
    for (int i = 0; i < times; ++i) {
        const AccessError cleared = set_ee_to_0(unit);
        if (cleared != AccessError::none) return cleared;
        const End end = written ? select(unit, mnemonic, *written) : poll(unit, mnemonic);
        if (end == End::doubtful) return doubtful(unit, mnemonic);
        if (end != End::refused) {
            if (!written) text_ = exchange_.answer();
            return ended(end);
        }
        const AccessError asked = ask_ee(unit);
        if (asked != AccessError::none) return asked;
        if (high(ee_) != reason) return AccessError::not_understood;
    }
    return error_of_ee(ee_, written.has_value());
}

/// After a lone EOT on a poll, which may be noise or the answer to another question.
AccessError Access::read_denied(UnitAddress unit, Mnemonic mnemonic)
{
    const AccessError asked = ask_ee(unit);
    if (asked != AccessError::none) {
        trouble_ = asked == AccessError::not_understood ? "an EOT, and the drive has no EE that says why"
                                                        : "an EOT, but no answer for EE behind it: noise";
        return asked;
    }
    note_ee("EOT");
    const AccessError error = error_of_ee(ee_, false);
    if (!is_denial(error)) return AccessError::not_understood;
    const Parameter parameter{number_of(unit), mnemonic};
    const auto known = denied_.find(parameter);
    if (known != denied_.end() && known->second == error) return error;
    const AccessError proven = prove(unit, mnemonic, std::nullopt, kTimesInvalid);
    if (is_denial(proven)) {
        note_ee("EOT");
        denied_[parameter] = proven;
    }
    return proven;
}

AccessError Access::write(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
{
    read_back_.reset();
    const bool was_0 = ee_is_0_.count(number_of(unit)) != 0;
    const End end = select(unit, mnemonic, text);
    if (end == End::doubtful) return doubtful(unit, mnemonic);
    if (end != End::refused) return ended(end);
    const AccessError asked = ask_ee(unit);
    if (asked != AccessError::none) {
        trouble_ = asked == AccessError::not_understood ? "NAK, and the drive has no EE that says why"
                                                        : "NAK, and EE could not be read";
        return asked;
    }
    note_ee("NAK");
    if (high(ee_) == kChecksumError) exchange_.note_not_accepted(unit);
    // 0: the drive has nothing against it, its frame was spoilt.
    AccessError error = high(ee_) == 0 ? AccessError::not_understood : error_of_ee(ee_, true);
    if (error == AccessError::not_understood) return error;
    const int times = error == AccessError::invalid_tag ? kTimesInvalid : was_0 ? 0 : 1;
    if (times > 0) error = prove(unit, mnemonic, text, times);
    if (error == AccessError::none || error == AccessError::no_answer || error == AccessError::deferred ||
        error == AccessError::not_understood)
        return error;
    note_ee("NAK");
    const std::string why = trouble_;
    set_ee_to_0(unit); // the next refusal is then believed at once
    trouble_ = why;
    return error;
}

/// Another write of the line is owed: the drive says something that it does not owe, then what it holds.
AccessError Access::doubtful(UnitAddress unit, Mnemonic mnemonic)
{
    const AccessError cleared = clear(unit);
    if (cleared != AccessError::none)
        return cleared == AccessError::no_answer ? cleared : AccessError::deferred;
    const End end = poll(unit, mnemonic);
    if (end == End::value) read_back_ = exchange_.answer();
    if (end == End::refused) ask_ee(unit); // a tag that can only be written
    trouble_ = "an ACK that may belong to another write";
    return end == End::silence || end == End::damaged ? AccessError::no_answer : AccessError::deferred;
}

bool Access::probe(UnitAddress unit)
{
    values_ = 0;
    clear(unit);
    return values_ != 0;
}

} // namespace dpslave::drive::ei
