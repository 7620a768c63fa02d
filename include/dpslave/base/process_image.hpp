// SPDX-License-Identifier: Apache-2.0
/// These plain values are exchanged by DP and the drive side, and may cross between threads.
/// DP fills a Layout and outputs, the poller fills inputs and answers.
///
/// Layout generation: on these devices the master picks the tags at run time, so the meaning of input word 3
/// changes. Each accepted Chk_Cfg that changes the layout counts a generation up; a value counts only under
/// the generation it was read for, so no reply carries values of tags that were asked for before.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <cstdint>

namespace dpslave {

/// Process parameters that one station can have at most (HA026290 ch. 5: 117 words in and out).
inline constexpr std::size_t kMaxParameters = 117;

using Generation = std::uint32_t; ///< 0 = there is no layout

/// One process parameter as the master chose it.
struct LayoutEntry {
    std::uint16_t tag = 0;
    bool reads = false;  ///< from the drive to the master (an input word)
    bool writes = false; ///< from the master to the drive (an output word)
    friend bool operator==(const LayoutEntry&, const LayoutEntry&) = default;
};

/// The parameters of a station, in the order of the identifiers (Demand Data not counted).
struct Layout {
    Generation generation = 0;
    std::uint8_t count = 0;
    std::array<LayoutEntry, kMaxParameters> parameters{};
};

/// This image goes from DP to the drive side and says what the master wants written now. words[i] belongs to
/// layout.parameters[i]; it has a meaning only where that parameter writes.
struct OutputImage {
    Layout layout{};
    /// True from the first outputs of this layout that are in force (by Data_Exchange, Sync, Unsync or
    /// Clear_Data) until the layout ends. Nothing is written before that.
    bool may_write = false;
    std::array<std::uint16_t, kMaxParameters> words{};
};

/// The state of a parameter on the drive side.
enum class WordState : std::uint8_t {
    untried,      ///< not read yet in this layout
    good,         ///< read and converted
    stale,        ///< held: the last refresh brought no valid answer
    invalid_tag,  ///< the drive (or the tag table) has no such tag: the input reads 0, the output is dropped
    read_only,    ///< the write was refused: read only
    out_of_range, ///< the write was refused, or the value does not fit in 16 bit
    /// The drive answers with a number whose scale is not known, or that contradicts the tag table: the input
    /// reads 0, the output is not written.
    unscaled,
    /// The drive refused for another reason (not stopped, not in configuration mode, type), or does not
    /// understand the request.
    refused,
};

/// Why a start is held at Stat_Diag. Never by silence.
enum class StartHold : std::uint8_t {
    none,
    unscaled, ///< a parameter of the layout has answered with a number of unknown scale
    denied,   ///< the drive denies a parameter of the layout
};

/// This image goes from the drive side to DP. words[i] belongs to parameter i of the layout with the same
/// generation.
struct InputImage {
    Generation generation = 0;
    /// Each input, and each output that has to be asked, was tried once, with whatever result.
    bool every_input_tried = false;
    /// The drive answers, or was not found silent yet: no time ends the wait for what was not tried.
    bool drive_answers = false;
    StartHold hold = StartHold::none; ///< the exchange must not begin; one that runs goes on
    /// The drive is gone, and the master is to be told (X-51, when_drive_lost = "diagnosis").
    bool drive_gone = false;
    std::array<std::uint16_t, kMaxParameters> words{};
};

/// Why an access to one tag failed on the drive side.
enum class AccessError : std::uint8_t {
    none,
    no_answer, ///< the drive is silent; no code of Demand Data stands for it
    /// It was not asked, or the answer proves nothing, because the line still owes an answer. It is asked
    /// again in a later round; neither silence nor refusal. It does not leave the drive side.
    deferred,
    not_understood, ///< the drive answers but cannot take the request: noise, wrong format; no code either
    invalid_tag,
    read_only,
    out_of_range,
    not_stopped,       ///< only while the drive is stopped
    not_config_mode,   ///< only in configuration mode
    unsupported_type,  ///< for example a STRING
    value_not_encoded, ///< the drive could not read the value (EE 07C8)
    no_scale,          ///< the drive answers with a number, and nothing says how many decimals it has (X-49)
    contradicted,      ///< the drive has answered with more decimals than the tag table gives
    does_not_fit,      ///< of a read: the drive has a value beyond 16 bits, or one that is no number (NaN,
                       ///< infinite)
    not_kept,          ///< of a write: the drive has taken it each time and then held another word
    not_known,         ///< of a write that is never made twice: sent, and no answer says what became of it
};

/// One order of Demand Data for the drive side.
struct DemandOrder {
    enum class Kind : std::uint8_t {
        cancel, ///< nothing is asked any more: a standing read ends
        read,   ///< read again and again until the next order
        write,  ///< write once
    };
    Kind kind = Kind::cancel;
    std::uint16_t tag = 0;
    std::uint16_t value = 0;   ///< of a write
    std::uint32_t number = 0;  ///< counts the orders of a station; an answer names the order it belongs to
    Generation generation = 0; ///< the layout in which the master gave it
};

/// The result of an order; a standing read gives one after each refresh.
struct DemandAnswer {
    std::uint32_t number = 0;
    AccessError error = AccessError::none;
    std::uint16_t value = 0; ///< the value read, or the value of a write that was accepted
};

/// DP tells the drive side, once and in order, that data exchange was left: the outputs of that layout go to
/// the safe state.
struct LeftDataExchange {
    Generation generation = 0;
};

} // namespace dpslave
