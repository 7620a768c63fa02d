// SPDX-License-Identifier: Apache-2.0
/// One access to a drive in as many exchanges as it takes to be sure: what a lone EOT, NAK or ACK leaves open
/// is asked for. The first exchange without an answer ends it.
#pragma once

#include "ei_exchange.hpp"
#include "known_ee.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dpslave::drive::ei {

class Access {
public:
    Access(SerialLine& line, EiTiming timing) : exchange_(line, timing) {}

    /// none: value() has it. deferred: not asked, or the value may be older than the last write.
    AccessError read(UnitAddress unit, Mnemonic mnemonic);

    /// deferred: not proven that the drive has taken it; what it holds now may be in read_back().
    /// `once`: EE is 0 before, so that one NAK is believed, and nothing is written a second time to be sure.
    AccessError write(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once = false);

    /// none: a value of this drive has come; nothing else proves that it is there. deferred: nothing was
    /// asked.
    AccessError probe(UnitAddress unit);

    /// One poll and nothing else.
    Sight look(UnitAddress unit, Mnemonic mnemonic);

    /// As it was read last.
    struct Value {
        std::string text;
        bool may_be_older = false; ///< than the question
    };
    const Value& value() const { return value_; }
    const std::optional<std::string>& read_back() const { return read_back_; }
    bool has_written() const { return has_written_; }       ///< the last write() got as far as its own text
    std::uint16_t ee() const { return ee_; }                ///< after a refusal
    const std::string& trouble() const { return trouble_; } ///< in words for the log; empty = none
    unsigned asked() const { return asked_; }               ///< exchanges since the start
    AnswerCounts counts(UnitAddress unit) const { return exchange_.counts(unit); }
    void listen() { exchange_.listen(); }

private:
    using End = Exchange::End;
    using Parameter = std::pair<DriveNumber, Mnemonic>;

    /// The counts of a drive before an access: what was heard of it and what was asked.
    struct Before {
        Instant valid_at{};
        unsigned asked = 0;
    };

    Before before(UnitAddress unit) const { return {counts(unit).valid_at, asked_}; }
    AccessError proven(UnitAddress unit, const Before& before, AccessError error) const;
    AccessError read_value(UnitAddress unit, Mnemonic mnemonic);
    AccessError write_value(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once);
    End poll(UnitAddress unit, Mnemonic mnemonic);
    End select(UnitAddress unit, Mnemonic mnemonic, std::string_view text);
    AccessError ended(End end);
    AccessError ended_read(Parameter parameter, End end);
    AccessError ask_ee(UnitAddress unit);
    AccessError set_ee_to_0(UnitAddress unit);
    AccessError clear(UnitAddress unit);
    std::optional<Mnemonic> spare(UnitAddress unit);
    AccessError read_denied(UnitAddress unit, Mnemonic mnemonic);
    AccessError write_refused(UnitAddress unit, Mnemonic mnemonic, std::string_view text, bool once,
                              bool was_0);
    AccessError doubtful(UnitAddress unit, Mnemonic mnemonic);
    AccessError prove(UnitAddress unit, Mnemonic mnemonic, std::optional<std::string_view> written,
                      int times);
    void note_ee(std::string_view what);

    Exchange exchange_;
    bool has_written_ = false;
    unsigned values_ = 0;        ///< of whatever drive was asked
    unsigned asked_ = 0;         ///< exchanges with whatever drive
    bool asks_anything_ = false; ///< any mnemonic will do
    std::uint16_t ee_ = 0;       ///< as ask_ee() read it last
    Value value_;
    std::optional<std::string> read_back_;
    std::string trouble_;
    KnownEe known_ee_;
    std::map<Parameter, AccessError> denied_; ///< proven, and no value since
    /// These were read last with an answer that was owed from before, and one still is: the next such value
    /// is older yet.
    std::set<Parameter> older_;
    std::map<DriveNumber, Mnemonic> gave_; ///< the last tag of which it gave a value
    std::set<Parameter> without_;          ///< spare mnemonics that a drive did not have
};

} // namespace dpslave::drive::ei
