// SPDX-License-Identifier: Apache-2.0
/// One access to a drive in as many exchanges as it takes to be sure: what a lone EOT, NAK or ACK leaves open
/// is asked for. The first exchange without an answer ends it.
#pragma once

#include "ei_exchange.hpp"

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

    /// none: text() is the value. deferred: not asked, or the value may be older than the last write.
    AccessError read(UnitAddress unit, Mnemonic mnemonic);

    /// deferred: not proven that the drive has taken it; what it holds now may be in read_back().
    AccessError write(UnitAddress unit, Mnemonic mnemonic, std::string_view text);

    /// A value of this drive. Nothing else proves that it is there.
    bool probe(UnitAddress unit);

    const std::string& text() const { return text_; }
    const std::optional<std::string>& read_back() const { return read_back_; }
    const std::string& trouble() const { return trouble_; } ///< in words for the log; empty = none
    AnswerCounts counts(UnitAddress unit) const { return exchange_.counts(unit); }
    void listen() { exchange_.listen(); }

private:
    using End = Exchange::End;
    using Parameter = std::pair<DriveNumber, Mnemonic>;

    End poll(UnitAddress unit, Mnemonic mnemonic);
    End select(UnitAddress unit, Mnemonic mnemonic, std::string_view text);
    AccessError ended(End end);
    AccessError ask_ee(UnitAddress unit);
    AccessError set_ee_to_0(UnitAddress unit);
    AccessError clear(UnitAddress unit);
    std::optional<Mnemonic> spare(UnitAddress unit);
    AccessError read_denied(UnitAddress unit, Mnemonic mnemonic);
    AccessError write_refused(UnitAddress unit, Mnemonic mnemonic, std::string_view text);
    AccessError doubtful(UnitAddress unit, Mnemonic mnemonic);
    AccessError prove(UnitAddress unit, Mnemonic mnemonic, std::optional<std::string_view> written,
                      int times);
    void note_ee(std::string_view what);

    Exchange exchange_;
    unsigned values_ = 0;  ///< of whatever drive was asked
    std::uint16_t ee_ = 0; ///< as ask_ee() read it last
    std::string text_;
    std::optional<std::string> read_back_;
    std::string trouble_;
    /// EE was read 0 there, and since then each question was answered well: what it says next is new.
    std::set<DriveNumber> ee_is_0_;
    std::map<Parameter, AccessError> denied_; ///< proven, and no value since
    std::set<Parameter> without_;             ///< spare mnemonics that a drive did not have
};

} // namespace dpslave::drive::ei
