// SPDX-License-Identifier: Apache-2.0
/// There is one record for each parameter of a drive: what is wanted of it, what is known of it, and what is
/// shown of it. ReadPlan, OutputPlan and SafeState decide when it is read or written next.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dpslave::drive {

/// The knowledge about the word that the drive holds in a parameter which is written.
enum class Knowledge : std::uint8_t {
    unknown,      ///< never written, the answer was lost, or the drive was away
    acknowledged, ///< the drive has answered a write of this word alone, whatever the answer was
    assumed,      ///< the layout is new or the drive was away, and a read is to show it
    unproven,     ///< written in a block, the answer to which says nothing of a single word
    held,         ///< a read has shown the word
    differs,      ///< a read has shown another word
};

enum class KnowledgeEvent : std::uint8_t {
    layout_begins,      ///< the first word of a layout, of a parameter that reads show
    sent,               ///< a write goes out; its answer is not there yet
    acknowledged,       ///< the answer to a single write
    block_acknowledged, ///< the answer to a block
    seen,               ///< a read shows the word
    another_seen,       ///< a read shows another word
    not_given,          ///< the drive does not give the word: no read shows it any more
    back_and_read,      ///< the drive is back; reads show what it holds
    back,               ///< the drive is back, or it may be another one; no read shows what it holds
};

/// One row of the table: what is known after the event, for each knowledge before it.
struct KnowledgeRow {
    KnowledgeEvent on;
    std::array<Knowledge, 6> after;
};

constexpr KnowledgeRow knowledge_row(KnowledgeEvent on, Knowledge unknown, Knowledge acknowledged,
                                     Knowledge assumed, Knowledge unproven, Knowledge held, Knowledge differs)
{
    return {on, {unknown, acknowledged, assumed, unproven, held, differs}};
}

// clang-format off
inline constexpr std::array kKnowledgeTable = [] {
    using enum Knowledge;
    using Event = KnowledgeEvent;
    return std::to_array<KnowledgeRow>({
        // before:                                unknown       acknowledged  assumed       unproven      held          differs
        knowledge_row(Event::layout_begins,      assumed,      acknowledged, assumed,      unproven,     held,         differs),
        knowledge_row(Event::sent,               unknown,      unknown,      unknown,      unknown,      unknown,      unknown),
        knowledge_row(Event::acknowledged,       acknowledged, acknowledged, acknowledged, acknowledged, acknowledged, acknowledged),
        knowledge_row(Event::block_acknowledged, unproven,     unproven,     unproven,     unproven,     unproven,     unproven),
        knowledge_row(Event::seen,               held,         held,         held,         held,         held,         held),
        knowledge_row(Event::another_seen,       unknown,      differs,      differs,      differs,      differs,      differs),
        knowledge_row(Event::not_given,          unknown,      acknowledged, unknown,      unknown,      acknowledged, acknowledged),
        knowledge_row(Event::back_and_read,      unknown,      assumed,      assumed,      assumed,      assumed,      assumed),
        knowledge_row(Event::back,               unknown,      unknown,      unknown,      unknown,      unknown,      unknown),
    });
}();
// clang-format on

constexpr Knowledge known_after(KnowledgeEvent event, Knowledge before)
{
    return kKnowledgeTable[static_cast<std::size_t>(event)].after[static_cast<std::size_t>(before)];
}

constexpr bool rows_are_in_order()
{
    for (std::size_t i = 0; i < kKnowledgeTable.size(); ++i)
        if (kKnowledgeTable[i].on != static_cast<KnowledgeEvent>(i)) return false;
    return kKnowledgeTable.back().on == KnowledgeEvent::back;
}
static_assert(rows_are_in_order());

/// Returns the meaning of an error of an access for the parameter. It is not called for no_answer of a drive
/// that is lost.
WordState state_of(AccessError error);

/// The state of the reads or of the writes of a parameter.
struct AccessState {
    bool asked = true; ///< false: decided without the drive (STRING, write-only, ...); state says how
    WordState state = WordState::untried;
    AccessError error = AccessError::none; ///< why; with `state` stale: see DriveSnapshot::errors
    std::uint16_t word = 0;                ///< as read last, or written and taken last
    int failures = 0;                      ///< accesses in a row without a good answer
    Instant updated_at{};                  ///< last success

    void answered(AccessError answer); ///< none: it worked
    void refuse(AccessError why);      ///< it is not asked for any more
    /// Not refreshed, and `why`. A refusal stays what it is.
    void hold(AccessError why);
    void lose(); ///< the drive is lost: held without an answer
};

/// The reasons to read a parameter; several apply at once.
enum Use : std::uint8_t {
    kInput = 1,    ///< an input of the layout
    kWatched = 2,  ///< read with or without a layout
    kCompared = 4, ///< an output whose word in the drive is looked at while it is written
    kForm = 8,     ///< an output that only an answer of the drive gives a form: read until it is known (X-49)
    kAsked = 16, ///< an output of which the drive is asked once whether it has it, and again while it denies
                 ///< it (X-48)
};

/// The reasons to read an input, or an output before the exchange begins.
inline constexpr std::uint8_t kOfLayout = kInput | kForm | kAsked;

/// These are read in every round, whatever the outputs do.
inline constexpr std::uint8_t kReadAlways = kInput | kWatched;

struct Reading : AccessState {
    std::uint8_t uses = 0;     ///< of Use; 0: not read
    bool unscaled = false;     ///< a number has no scale by the row: asked first, before the others
    bool tried = false;        ///< in this layout, with whatever result
    bool of_other_row = false; ///< the state: no answer under the present row yet
    AnswerText answer{};       ///< for the errors no_scale, contradicted and invalid_tag

    bool serves(std::uint8_t use) const { return (uses & use) != 0; }
    /// A word was read in this layout: it is held whatever comes.
    bool was_read() const { return updated_at != Instant{}; }
    /// Not read in every round: the drive has no such tag, or it does not give its value.
    bool is_excluded() const;
    /// `is_result`: that there is no answer is the result of the try.
    void drive_lost(bool is_result);
};

enum class Verdict : std::uint8_t { accepted, refused };

struct Writing : AccessState {
    bool is_output = false;
    bool readable = false;     ///< compared: the cyclic read shows what the drive holds
    std::size_t parameter = 0; ///< its place in the layout
    std::uint16_t wanted = 0;
    std::uint16_t known = 0; ///< the word that `knowledge` is about
    Knowledge knowledge = Knowledge::unknown;
    Verdict verdict = Verdict::accepted; ///< of the last answered write
    Instant answered_at{};

    void on(KnowledgeEvent event) { knowledge = known_after(event, knowledge); }
    /// The drive has answered a write of the wanted word, or is assumed to hold it.
    bool is_settled() const { return knowledge != Knowledge::unknown && known == wanted; }
    bool is_refused() const { return verdict == Verdict::refused; }
    /// The drive has no such tag, or its scale is not known: tried rarely.
    bool is_dropped() const;

    void layout_begins();
    void write_answered(std::uint16_t written, AccessError error, bool in_block, Instant now);
    /// A read that began at `began` has shown the wanted word.
    void wanted_seen(Instant began);
    void port_changed(); ///< it may be another drive
    void drive_returned();
};

struct DriveParameter {
    const Tag* row = nullptr;
    Reading reading;
    Writing writing;
};

} // namespace dpslave::drive
