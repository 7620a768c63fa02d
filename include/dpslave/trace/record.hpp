// SPDX-License-Identifier: Apache-2.0
/// One entry of the recorder: what a thread heard, sent or decided, with its time. The bus thread records
/// octets as it read them; telegrams are made of them later (trace/telegrams.hpp), off that thread. A drive
/// thread records frames with their judgement. docs/internals/trace.md has the format.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <cstdint>

namespace dpslave::trace {

enum class Kind : std::uint8_t {
    heard,         ///< octets of the bus, as one read gave them; the echo of our replies is not among them
    bad_character, ///< the UART reported a bad character in this place; no octets
    sent,          ///< a reply of ours, as it was handed to the port
    unanswered,    ///< a request to one of our addresses that gets no reply; detail: fdl::Unanswered::Why
    rate,          ///< the bus goes on at another rate; no octets
    asked,         ///< a question to a drive, as it was handed to the port
    answered,      ///< octets of a drive line that were judged together; detail: drive::Judgement
    no_answer,     ///< the wait for the answer of a drive is over; no octets
    line,          ///< in the file of an incident: what follows is of the drive line with this name
    silence, ///< nothing more came: layer 2 gave up what was unfinished, or took a telegram in doubt; no
             ///< octets
};
inline constexpr std::uint8_t kKinds = 10;

/// A record without its octets.
struct Head {
    Kind kind = Kind::heard;
    std::uint8_t detail = 0;
    std::uint8_t rate = 0;     ///< of the bus: index into kBauds; of a drive line: drive::LineProtocol
    bool more_follows = false; ///< of `heard`: the next record belongs to the same read
    std::uint8_t address = 0;  ///< of `unanswered` and of a drive line: who was asked
    Instant at{};              ///< when the read or the write had ended, or the decision was made
    Instant begun{};           ///< of `sent`: before the write; of a drive line: as drive::TracedFrame
};

struct Record {
    /// More than any telegram, and all that one read gives.
    static constexpr std::size_t kMostOctets = 512;

    Head head{};
    std::uint64_t number = 0; ///< of this ring, from 0: a gap shows what was lost
    ByteBuffer<kMostOctets> octets{};
};

} // namespace dpslave::trace
