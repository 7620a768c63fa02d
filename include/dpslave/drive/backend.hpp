// SPDX-License-Identifier: Apache-2.0
/// The interface to a drive, the same for each protocol. A call is one exchange, or as many as it
/// takes to be sure of its answer (docs/internals/drive-answers.md): after a refusal the drive is asked for
/// the reason, and where an older answer is owed it is cleared first. Each exchange may block for one
/// response time-out and the time that its characters take, whatever comes on the line; the first one without
/// a good answer ends the call. deferred: nothing was asked, or nothing is proven. The poller
/// repeats, so that one dead drive does not stop the others.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/drive/owed_answers.hpp"
#include "dpslave/drive/tag.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dpslave::drive {

/// Where a drive is found on its line: EI-ASCII group and unit id ("00"), or a Modbus slave address.
struct UnitAddress {
    std::uint8_t group = 0; ///< EI-ASCII GID 0..15; 0 with Modbus
    std::uint8_t unit = 0;  ///< EI-ASCII UID 0..15; Modbus 1..247
    friend bool operator==(UnitAddress, UnitAddress) = default;
};

/// How many tags one read may take, how many unasked tags may lie between two of them, and how many adjoining
/// tags one write may take, where reads prove what became of them (UnitSettings::compare_outputs). A tag with
/// a register of its own is never part of a block.
struct BlockRule {
    std::uint16_t max_tags = 1;
    std::uint16_t max_gap = 0;
    std::uint16_t max_written = 1;
};

class Backend {
public:
    virtual ~Backend() = default;

    virtual BlockRule block_rule() const = 0;

    /// Reads `count` tags from `first` on (count 1 unless block_rule() allows more) into `words`.
    /// For a single tag `tag` is its row; of a block only the numbers matter.
    virtual AccessError read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words) = 0;

    /// Writes `words` to the tags from `tag` on; one word unless block_rule() allows more. A block is
    /// accepted as a whole or refused as a whole as far as its answer says; the drive may have dropped words
    /// in silence.
    virtual AccessError write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words) = 0;

    /// True: the drive answers. Over EI-ASCII only a value counts, over Modbus a valid frame of this
    /// drive.
    virtual bool probe(UnitAddress unit) = 0;

    /// The failure of the last call, in words for the log ("EE >05C8"); empty: it did not fail.
    virtual std::string last_trouble() const = 0;

    /// Reads and judges octets between two calls, so that the delay of a late answer is measured when it
    /// comes. Takes as long as octets come, two of the longest answers at most.
    virtual void listen() {}

    /// Counts of all that came of this drive beside answers in time.
    virtual AnswerCounts counts(UnitAddress unit) const
    {
        (void)unit;
        return {};
    }

    /// The text of the value of the last read, even where it was refused (EI-ASCII); empty: there was none.
    /// Valid until the next call.
    virtual std::string_view last_answer() const { return {}; }
};

} // namespace dpslave::drive
