// SPDX-License-Identifier: Apache-2.0
/// Looks for drives on a line of which nothing is known: what is asked, in which order and how long that
/// takes at most; who answers, who he is, and under which rule which tags answer. It is pure: it gives a
/// question, takes the result, and gives the next question. Nothing is ever written to a drive. It serves
/// `dpctl identify` and the daemon's `dpctl doctor --probe`.
#pragma once

#include "dpslave/drive/line_setting.hpp"
#include "dpslave/drive/rule_trial.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::drive {

/// One setting of the port and the units that are asked with it.
struct SearchTry {
    LineSetting setting;
    std::vector<UnitAddress> units;
    std::vector<UnitAddress> rest; ///< asked as well, once one of `units` has answered
};

/// These limits narrow a search; an empty one means the usual values.
struct SearchScope {
    std::vector<LineProtocol> protocols;
    std::vector<std::uint32_t> bauds;
    std::vector<LineFormat> formats;
    std::map<LineProtocol, std::vector<UnitAddress>>
        units; ///< of the protocols that are not in it: usual ones
};

/// Returns the plan for a line of which nothing is known: first the first unit ids at every setting, then
/// every usual unit at the formats of the manuals. A protocol that has none of the formats is left out.
std::vector<SearchTry> search_plan(const SearchScope& scope);

/// Returns the plan for a line that should work: its own setting with every usual unit first, since a wrong
/// unit is the most frequent fault; then every other rate and format with this unit and the first one.
/// `others`: units that are never asked.
std::vector<SearchTry> search_near(const LineSetting& own, UnitAddress unit,
                                   const std::vector<UnitAddress>& others);

struct SearchQuestion {
    LineSetting setting;
    UnitAddress unit{};
    Look look;
};

/// A unit that has answered two separate questions.
struct FoundUnit {
    LineSetting setting;
    UnitAddress unit{};
    std::optional<std::string> identity, version; ///< as answered, ">2650"; nothing: denied or silent
    bool tags_asked = false;                      ///< false: only the first few units are asked for tags
    std::vector<RuleTally> rules{};
};

/// The default limits of a search.
struct SearchLimits {
    std::uint32_t units = 16; ///< that answer: then it is over
    std::uint32_t trials = 2; ///< of these, how many are asked for tags
};

class LineSearch {
public:
    LineSearch(std::vector<SearchTry> plan, RuleTrial trial, std::chrono::milliseconds timeout,
               SearchLimits limits = {});

    /// Asked by a back-end that was made for this question. nullopt means that the search is over.
    std::optional<SearchQuestion> next() const;
    /// Takes the answer to the question of next().
    void take(const Sight& sight);

    std::uint32_t asked() const { return asked_; }
    std::uint32_t most() const { return most_; } ///< questions, whatever answers
    std::chrono::seconds longest() const
    {
        return longest_;
    } ///< of all of them, unless the line never stops sending

    /// All so far. The last one may not be finished.
    std::vector<FoundUnit> found() const;
    std::uint32_t unsure() const { return unsure_; }   ///< units that answered once, or only with EOT
    std::uint32_t damaged() const { return damaged_; } ///< questions after which came what is no answer
    bool is_full() const { return is_full_; }          ///< it ended because SearchLimits::units answered

private:
    /// The question to the unit at this point.
    enum class Step : std::uint8_t { first, again, identity, version, tags };
    struct Unit {
        FoundUnit unit;
        std::map<Look, Sight::Kind> sights;
    };

    void measure();
    bool is_modbus() const;
    const SearchTry& now() const { return plan_[at_]; }
    Look look() const;
    void take_first(const Sight& sight);
    void take_again(const Sight& sight);
    void take_identity(const Sight& sight);
    void take_version(const Sight& sight);
    void begin_tags();
    void next_unit();
    void give_up();

    std::vector<SearchTry> plan_;
    RuleTrial trial_;
    std::chrono::milliseconds timeout_;
    SearchLimits limits_;
    std::size_t at_ = 0, unit_ = 0; ///< try and unit of it
    Step step_ = Step::first;
    std::size_t choice_ = 0; ///< which of the questions of this step
    std::vector<Look> tag_questions_;
    std::vector<Unit> found_;
    bool found_here_ = false; ///< at this setting
    std::uint32_t followed_ = 0, asked_ = 0, most_ = 0, unsure_ = 0, damaged_ = 0;
    std::chrono::seconds longest_{};
    bool is_full_ = false;
};

/// Returns the device that the manuals give for an identity; empty if they do not say. Source: EI-ASCII and
/// Modbus reference, sections 4 and 5.
std::string identity_words(const std::string& identity);

} // namespace dpslave::drive
