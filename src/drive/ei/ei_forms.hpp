// SPDX-License-Identifier: Apache-2.0
/// Values of an EI-ASCII line as 16 bits, and what the drives have shown of tags whose form no table gives:
/// '>' makes such a tag a WORD, and a number has the scale of the row, if the row has one.
#pragma once

#include "dpslave/drive/backend.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace dpslave::drive {

class EiForms {
public:
    /// The meaning of a value of a drive.
    struct Taken {
        AccessError error = AccessError::none;
        std::uint16_t word = 0; ///< 0 unless none
        std::string trouble;    ///< what is wrong and what to do, in words for the log; empty with none
    };
    /// `text`: of an answer to a read of `tag`.
    Taken take(UnitAddress unit, const Tag& tag, std::string_view text);

    /// The drive's answer decides how the tag is written, and has not been seen: read it first.
    bool must_be_read(UnitAddress unit, const Tag& tag) const;
    /// The tag is written as a WORD, whatever its row says: so it has answered.
    bool is_word(UnitAddress unit, const Tag& tag) const;

    void forget(UnitAddress unit); ///< it may be another drive
    void forget_all() { seen_.clear(); }

private:
    enum class Form : std::uint8_t { word, number };
    using Key = std::pair<std::uint16_t, std::uint16_t>; ///< unit and number of the tag
    static Key key(UnitAddress unit, const Tag& tag);
    Taken take_open(UnitAddress unit, const Tag& tag, std::string_view text);

    std::map<Key, Form> seen_; ///< of tags whose row does not say their form
};

} // namespace dpslave::drive
