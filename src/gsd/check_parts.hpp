// SPDX-License-Identifier: Apache-2.0
/// The parts of check(), one subject each. They add to `remarks` in any order.
#pragma once

#include "dpslave/gsd/document.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace dpslave::gsd {

/// This is found in public files of many makers, and masters accept it (wire reference 9.4): it is never in
/// files of ours.
inline constexpr Weight kLivesInTheField = Weight::warning;

/// Holds what is judged and takes the verdict.
class Judge {
public:
    Judge(const Document& judged, Remarks& verdict)
        : document(judged),
          revision(judged.number("GSD_Revision").value_or(0)),
          dpv1(judged.number("DPV1_Slave").value_or(0) == 1),
          remarks_(verdict)
    {}

    const Document& document;
    const std::uint32_t revision; ///< 1 to 5; 0 = the file names none
    const bool dpv1;

    void say(unsigned line, Weight weight, std::string what)
    {
        remarks_.push_back({line, weight, std::move(what)});
    }
    /// Adds a warning: the line counts as a slip, and is not evaluated.
    void slip(unsigned line, std::string what)
    {
        remarks_.push_back({line, Weight::warning, std::move(what), true});
    }
    bool on(std::string_view keyword) const { return document.number(keyword).value_or(0) == 1; }
    unsigned line_of(std::string_view keyword) const
    {
        const Entry* entry = document.find(keyword);
        return entry == nullptr ? 0 : entry->line;
    }

private:
    Remarks& remarks_;
};

/// check_keywords.cpp: each keyword of the device and of its modules by itself, and keywords that stand
/// twice.
void check_keywords(Judge& judge);
/// check_device.cpp: what must be there, rates, lengths, user parameters in the old style.
void check_device(Judge& judge);
void check_file_name(Judge& judge, std::string_view file_name);
/// check_modules.cpp: names, references, identifiers and what they add up to.
void check_modules(Judge& judge);
/// check_parameters.cpp: ExtUserPrmData, PrmText and the new style of user parameters.
void check_parameters(Judge& judge);

} // namespace dpslave::gsd
