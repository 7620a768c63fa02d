// SPDX-License-Identifier: Apache-2.0
/// Keeps what is known of the last error (EE) of each drive of a line, without asking for it.
#pragma once

#include "ei_exchange.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dpslave::drive::ei {

class KnownEe {
public:
    /// EE was read 0, and since then each question was answered well: what it says next is new.
    bool is_0(UnitAddress unit) const { return is_0_.count(number_of(unit)) != 0; }
    void was_0(UnitAddress unit) { is_0_.insert(number_of(unit)); }
    /// Something else may have been refused since.
    void may_differ(UnitAddress unit)
    {
        is_0_.erase(number_of(unit));
        refused_.erase(number_of(unit));
    }
    /// A write had a NAK, with EE at 0 before it, and EE could not be read after it: the reason is still to
    /// be asked.
    void refused(UnitAddress unit, Mnemonic mnemonic, std::string_view text)
    {
        refused_.insert_or_assign(number_of(unit), std::pair{mnemonic, std::string{text}});
    }
    bool is_refused(UnitAddress unit, Mnemonic mnemonic, std::string_view text) const
    {
        const auto at = refused_.find(number_of(unit));
        return at != refused_.end() && at->second.first == mnemonic && at->second.second == text;
    }
    void reason_is_known(UnitAddress unit) { refused_.erase(number_of(unit)); }

private:
    std::set<DriveNumber> is_0_;
    std::map<DriveNumber, std::pair<Mnemonic, std::string>> refused_;
};

} // namespace dpslave::drive::ei
