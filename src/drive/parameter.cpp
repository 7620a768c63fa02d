// SPDX-License-Identifier: Apache-2.0
#include "parameter.hpp"

namespace dpslave::drive {
namespace {

/// A refusal of this word, or one for the time being: that the drive holds the word ends it. A tag that is
/// read only stays so.
bool ends_when_held(AccessError error)
{
    return error != AccessError::read_only && error != AccessError::invalid_tag &&
           error != AccessError::unsupported_type && error != AccessError::contradicted;
}

} // namespace

WordState state_of(AccessError error)
{
    switch (error) {
        case AccessError::none: return WordState::good;
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_known: return WordState::stale;
        case AccessError::invalid_tag: return WordState::invalid_tag;
        case AccessError::read_only: return WordState::read_only;
        case AccessError::out_of_range:
        case AccessError::does_not_fit:
        case AccessError::value_not_encoded: return WordState::out_of_range;
        case AccessError::not_understood:
        case AccessError::not_stopped:
        case AccessError::not_config_mode:
        case AccessError::not_kept:
        case AccessError::unsupported_type: return WordState::refused;
        case AccessError::no_scale:
        case AccessError::contradicted: return WordState::unscaled;
    }
    return WordState::refused;
}

void AccessState::answered(AccessError answer)
{
    state = state_of(answer);
    error = answer;
    failures = 0;
}

void AccessState::refuse(AccessError why)
{
    asked = false;
    answered(why);
}

void AccessState::hold(AccessError why)
{
    ++failures;
    if (state != WordState::good && state != WordState::stale) return;
    state = WordState::stale;
    error = why;
}

void AccessState::lose()
{
    state = WordState::stale;
    error = AccessError::no_answer;
}

bool Reading::is_excluded() const
{
    return state == WordState::invalid_tag || state == WordState::refused || state == WordState::read_only ||
           state == WordState::unscaled;
}

/// An exclusion stands, but not that of a number whose scale the table has by now, nor that of another row.
void Reading::drive_lost(bool is_result)
{
    const bool waits_for_new_row = error == AccessError::no_scale ? !unscaled : of_other_row;
    const bool is_over = is_excluded() && !waits_for_new_row;
    tried = is_result || is_over;
    if (!is_over) lose();
}

bool Writing::is_dropped() const
{
    return state == WordState::invalid_tag || state == WordState::unscaled;
}

/// A bus that drops out again and again must not cost the memory of the drive a write each time: the first
/// word of a layout counts as held by the drive until a read shows another one.
void Writing::layout_begins()
{
    if (!readable) return;
    if (knowledge == Knowledge::unknown) known = wanted;
    on(KnowledgeEvent::layout_begins);
}

void Writing::write_answered(std::uint16_t written, AccessError answer, bool in_block, Instant now)
{
    known = written;
    on(in_block ? KnowledgeEvent::block_acknowledged : KnowledgeEvent::acknowledged);
    answered_at = now;
    answered(answer);
    verdict = answer == AccessError::none ? Verdict::accepted : Verdict::refused;
    if (is_refused()) return;
    word = written;
    updated_at = now;
}

void Writing::wanted_seen(Instant began)
{
    if (!is_settled() || knowledge == Knowledge::assumed) { // as good as an answer, which may never come
        known = word = wanted;
        answered_at = updated_at = began;
    }
    on(KnowledgeEvent::seen);
    failures = 0;
    if (is_refused() && !ends_when_held(error)) return;
    verdict = Verdict::accepted;
    answered(AccessError::none);
}

void Writing::port_changed()
{
    on(KnowledgeEvent::back);
    verdict = Verdict::accepted;
    answered(AccessError::deferred);
}

/// The drive may have been without power: every present output is written again, whatever the drive held. If
/// outputs are compared the reads show which of them.
void Writing::drive_returned()
{
    on(readable && !is_refused() ? KnowledgeEvent::back_and_read : KnowledgeEvent::back);
    verdict = Verdict::accepted;
    if (is_dropped()) lose();
}

} // namespace dpslave::drive
