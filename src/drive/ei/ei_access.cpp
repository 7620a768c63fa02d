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

bool is_spare(Mnemonic mnemonic)
{
    return mnemonic == kLastError || mnemonic[0] == kIdentity[0] || mnemonic[0] == kVersion[0];
}

bool is_denial(AccessError error)
{
    return error == AccessError::invalid_tag || error == AccessError::unsupported_type;
}

} // namespace

Access::End Access::poll(UnitAddress unit, Mnemonic mnemonic)
{
    const End end = exchange_.poll(unit, mnemonic);
    if (end != End::not_asked) ++asked_;
    if (end == End::value && !is_spare(mnemonic)) gave_.insert_or_assign(number_of(unit), mnemonic);
    if (end == End::value || end == End::older)
        ++values_;
    else
        known_ee_.may_differ(unit);
    trouble_ = exchange_.trouble();
    return end;
}

Access::End Access::select(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
{
    const End end = exchange_.select(unit, mnemonic, text);
    ++asked_;
    if (end != End::ack || mnemonic == kLastError) known_ee_.may_differ(unit);
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

/// The first value after a question without an answer may be the answer to it, and is newer than all that was
/// read before. After that one nothing more is known of the next, until the debt has ended.
AccessError Access::ended_read(Parameter parameter, End end)
{
    value_.may_be_older = end == End::older;
    if (end == End::value) older_.erase(parameter);
    if (end != End::older || older_.insert(parameter).second) return ended(end);
    trouble_ = "an answer that may be older than the question";
    return AccessError::deferred;
}

/// A lone EOT or NAK counts as an answer, also where its reason stays unknown, only if a value of the drive
/// came with it.
AccessError Access::proven(UnitAddress unit, const Before& before, AccessError error) const
{
    const bool is_open = error != AccessError::none && error != AccessError::no_answer;
    const bool is_silent = asked_ != before.asked && counts(unit).valid_at == before.valid_at;
    return is_open && is_silent ? AccessError::no_answer : error;
}

AccessError Access::read(UnitAddress unit, Mnemonic mnemonic)
{
    const Before begun = before(unit);
    return proven(unit, begun, read_value(unit, mnemonic));
}

AccessError Access::write(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once)
{
    const Before begun = before(unit);
    has_written_ = false;
    const AccessError error = write_value(unit, mnemonic, text, once);
    return error == AccessError::deferred ? error : proven(unit, begun, error); // doubtful() has judged it
}

AccessError Access::read_value(UnitAddress unit, Mnemonic mnemonic)
{
    if (exchange_.owes(unit, mnemonic)) {
        const AccessError error = clear(unit);
        if (error == AccessError::no_answer) return error;
    }
    const End end = poll(unit, mnemonic);
    if (end == End::refused) return read_denied(unit, mnemonic);
    const AccessError error = ended_read({number_of(unit), mnemonic}, end);
    if (error != AccessError::none) return error;
    value_.text = exchange_.answer();
    denied_.erase({number_of(unit), mnemonic});
    return error;
}

/// Returns a mnemonic that no station reads and no drive of the line owes, and for which this drive gives a
/// value as far as is known. It is none that the drive itself owes: each answer would leave one owed again,
/// and the debt would never end.
std::optional<Mnemonic> Access::spare(UnitAddress unit)
{
    const auto is_free = [&](Mnemonic one) {
        return exchange_.may_poll(unit, one) && !exchange_.is_owed(one);
    };
    for (const Mnemonic one : {kIdentity, kVersion})
        if (is_free(one) && without_.count({number_of(unit), one}) == 0) return one;
    for (const Mnemonic one : {kLastError, kIdentity, kVersion})
        if (is_free(one)) return one;
    if (!asks_anything_) return std::nullopt;
    for (const char first : {kVersion[0], kIdentity[0]})
        for (char second = '1'; second <= '9'; ++second)
            if (const Mnemonic any{first, second}; is_free(any)) return any;
    return std::nullopt;
}

/// Ends what the drive owes by a value of another mnemonic.
AccessError Access::clear(UnitAddress unit)
{
    exchange_.listen(); // owed answers may have come, or may have expired
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
    if (*mnemonic == kLastError) return AccessError::not_understood;
    const AccessError why = ask_ee(unit);
    // EE could be the answer to another question: a tag that the drive has given shows that it is there.
    const auto known = gave_.find(number_of(unit));
    if (why != AccessError::deferred || known == gave_.end() || exchange_.is_owed(known->second)) return why;
    const End given = poll(unit, known->second);
    return given == End::refused ? AccessError::deferred : ended(given);
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
    if (high(ee_) == 0) known_ee_.was_0(unit);
    return AccessError::none;
}

/// Only refusals from now on change EE. The answer to the write proves nothing: EE is read.
AccessError Access::set_ee_to_0(UnitAddress unit)
{
    if (known_ee_.is_0(unit)) return AccessError::none;
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
            if (written) return ended(end);
            value_.text = exchange_.answer();
            return ended_read({number_of(unit), mnemonic}, end);
        }
        const AccessError asked = ask_ee(unit);
        if (asked != AccessError::none) return asked;
        if (high(ee_) != reason) return AccessError::not_understood;
    }
    return error_of_ee(ee_, written.has_value());
}

/// Reads the reason after a lone EOT on a poll, which may be noise or the answer to another question.
AccessError Access::read_denied(UnitAddress unit, Mnemonic mnemonic)
{
    const AccessError asked = ask_ee(unit);
    if (asked != AccessError::none) {
        trouble_ = asked == AccessError::not_understood ? "an EOT, and the drive has no EE that says why"
                                                        : "an EOT, but no answer for EE after it: noise";
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

/// A value that was refused once is not written again; the drive is asked for the reason.
AccessError Access::write_value(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once)
{
    read_back_.reset();
    if (once && known_ee_.is_refused(unit, mnemonic, text)) {
        has_written_ = true;
        if (exchange_.owes(unit, kLastError)) clear(unit);
        if (known_ee_.is_refused(unit, mnemonic, text))
            return write_refused(unit, mnemonic, text, once, true);
        has_written_ = false; // something else was refused meanwhile
    }
    if (once) {
        const AccessError cleared = set_ee_to_0(unit);
        if (cleared == AccessError::no_answer || cleared == AccessError::deferred) return cleared;
    }
    const bool was_0 = known_ee_.is_0(unit);
    const End end = select(unit, mnemonic, text);
    has_written_ = exchange_.has_sent();
    if (end == End::doubtful) return doubtful(unit, mnemonic);
    if (end != End::refused) return ended(end);
    return write_refused(unit, mnemonic, text, once, was_0);
}

/// `was_0`: EE was 0 before it.
AccessError Access::write_refused(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once,
                                  bool was_0)
{
    const AccessError asked = ask_ee(unit);
    if (asked != AccessError::none) {
        trouble_ = asked == AccessError::not_understood ? "NAK, and the drive has no EE that says why"
                                                        : "NAK, and EE could not be read";
        if (once && was_0) known_ee_.refused(unit, mnemonic, text);
        return asked;
    }
    known_ee_.reason_is_known(unit);
    note_ee("NAK");
    if (high(ee_) == kChecksumError) exchange_.note_not_accepted(unit);
    // 0: the drive has nothing against it, its frame was spoilt.
    AccessError error = high(ee_) == 0 ? AccessError::not_understood : error_of_ee(ee_, true);
    if (once && !was_0) error = AccessError::not_understood; // EE may be of another refusal
    if (error == AccessError::not_understood) return error;
    const int times = once ? 0 : error == AccessError::invalid_tag ? kTimesInvalid : was_0 ? 0 : 1;
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

/// Another write of the line is owed: first the drive is asked for something that it does not owe, then for
/// the word that it holds.
AccessError Access::doubtful(UnitAddress unit, Mnemonic mnemonic)
{
    const Before begun = before(unit);
    const auto ask = [&] {
        const AccessError cleared = clear(unit);
        if (cleared != AccessError::none)
            return cleared == AccessError::no_answer ? cleared : AccessError::deferred;
        const End end = poll(unit, mnemonic);
        if (end == End::value) read_back_ = exchange_.answer();
        if (end == End::refused) ask_ee(unit); // a tag that can only be written
        trouble_ = "an ACK that may belong to another write";
        return end == End::silence || end == End::damaged ? AccessError::no_answer : AccessError::deferred;
    };
    return proven(unit, begun, ask());
}

AccessError Access::probe(UnitAddress unit)
{
    values_ = 0;
    const unsigned asked = asked_;
    asks_anything_ = true; // nothing of the answer is used but that it came
    clear(unit);
    asks_anything_ = false;
    if (values_ != 0) return AccessError::none;
    return asked_ == asked ? AccessError::deferred : AccessError::no_answer;
}

Sight Access::look(UnitAddress unit, Mnemonic mnemonic)
{
    switch (poll(unit, mnemonic)) {
        case End::value:
        case End::older: return {Sight::Kind::value, exchange_.answer()};
        case End::refused: return {Sight::Kind::denied};
        case End::damaged: return {Sight::Kind::damaged};
        case End::before:
        case End::ack:
        case End::doubtful:
        case End::silence:
        case End::not_asked: break;
    }
    return {};
}

} // namespace dpslave::drive::ei
