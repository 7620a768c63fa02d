// SPDX-License-Identifier: Apache-2.0
/// The interface to a drive, the same for each protocol. A call is one exchange, or as many as it takes to be
/// sure of its answer (docs/internals/drive-answers.md): after a refusal the drive is asked for the reason,
/// and where an older answer is owed it is cleared first. Each exchange may block for one response timeout
/// and the time that its characters take, whatever comes on the line; the first one without a good answer
/// ends the call. deferred: nothing was asked, or nothing is proven. The poller repeats, so that one dead
/// drive does not stop the others.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/drive/owed_answers.hpp"
#include "dpslave/drive/tag.hpp"

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dpslave::drive {

/// The address of a drive on its line: EI-ASCII group and unit id ("00"), or a Modbus slave address.
struct UnitAddress {
    std::uint8_t group = 0; ///< EI-ASCII GID 0..15; 0 with Modbus
    std::uint8_t unit = 0;  ///< EI-ASCII UID 0..15; Modbus 1..247
    friend bool operator==(UnitAddress, UnitAddress) = default;
};

/// Says how many tags one read may take, how many unasked tags may lie between two of them, and how many
/// adjoining tags one write may take, if reads prove the result (DriveSettings::compare_outputs). A tag with
/// a register of its own is never part of a block.
struct BlockRule {
    std::uint16_t max_tags = 1;
    std::uint16_t max_gap = 0;
    std::uint16_t max_written = 1;
};

/// One question of a search: the mnemonic, or the register of Modbus.
struct Look {
    std::array<char, 2> mnemonic{};
    std::uint16_t reg = 0;
    friend auto operator<=>(const Look&, const Look&) = default;
};

/// The result of a look.
struct Sight {
    enum class Kind : std::uint8_t {
        silence,
        damaged, ///< octets that are no answer
        denied,  ///< a lone EOT or NAK, or an exception
        value,
    };
    Kind kind = Kind::silence;
    std::string text{}; ///< of a value, ">2650"; of Modbus in the same form. Of an exception "exception 2"
};

class Backend {
public:
    virtual ~Backend() = default;

    virtual BlockRule block_rule() const = 0;

    /// Reads `count` tags from `first` on (count 1 unless block_rule() allows more) into `words`.
    /// For a single tag `tag` is its row; for a block only the numbers matter.
    virtual AccessError read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words) = 0;

    /// Writes `words` to the tags from `tag` on; one word unless block_rule() allows more. A block is
    /// accepted as a whole or refused as a whole as far as its answer says; the drive may have dropped words
    /// in silence.
    virtual AccessError write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words) = 0;

    /// Writes one word that is ordered once: a drive that refuses it receives it once.
    virtual AccessError write_once(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t, 1> word)
    {
        return write(unit, tag, word);
    }

    /// The last write has handed its words to the line: whatever its error, the drive may have them.
    virtual bool has_sent() const { return true; }

    /// The value of the last read may answer an earlier question for the same tag: it is newer than all that
    /// was read before, and may be older than the call.
    virtual bool may_be_older() const { return false; }

    /// Returns how many questions the last call has asked: more than one if something invalid looked like an
    /// answer.
    virtual unsigned questions() const { return 1; }

    /// none: the drive answers. Over EI-ASCII only a value counts, over Modbus a valid frame of this drive.
    /// Else no_answer, or deferred: nothing could be asked.
    virtual AccessError probe(UnitAddress unit) = 0;

    /// Asks once and never writes, not even EE. If the back-end was asked nothing before, a value or an
    /// exception is from that drive.
    virtual Sight look(UnitAddress unit, const Look& what)
    {
        (void)unit;
        (void)what;
        return {};
    }

    /// The failure of the last call, in words for the log ("EE >05C8"); empty: it did not fail.
    virtual std::string last_trouble() const = 0;

    /// Reads and judges octets between two calls, so that the delay of a late answer is measured when it
    /// comes. Takes as long as octets come, two of the longest answers at most.
    virtual void listen() {}

    /// Returns the counts of everything that came from this drive except answers in time.
    virtual AnswerCounts counts(UnitAddress unit) const
    {
        (void)unit;
        return {};
    }

    /// Returns the answer of the drive to the last read: the text of the value, even if it was refused
    /// (EI-ASCII), or how the drive denied the tag ("EE >01C7", "exception 2"); empty if there was no answer.
    /// Valid until the next call.
    virtual std::string_view last_answer() const { return {}; }
};

} // namespace dpslave::drive
