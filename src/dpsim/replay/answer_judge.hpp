// SPDX-License-Identifier: Apache-2.0
/// Judges whether an answer is the one of the capture. Values that depend on the drive side are compared as
/// far as the drive side is the same: it never answers at exactly the same moment again. It is pure.
#pragma once

#include "replay_script.hpp"

#include <map>
#include <set>
#include <utility>

namespace dpslave::sim {

/// Says who answers the gateway's requests to its drives.
enum class DriveSide : std::uint8_t {
    unknown, ///< anybody, or nobody: what comes from a drive is not compared
    capture, ///< the frames of the capture: an input word must be one that the capture has
};

class AnswerJudge {
public:
    AnswerJudge(const ReplayScript& script, DriveSide drive);

    struct Verdict {
        bool is_same = false;
        bool is_masked = false; ///< the same only because something was not compared octet by octet
        std::string why{};      ///< in a few words, if it is another one
    };
    /// `step` is the number of the step, and it has an answer in the capture.
    Verdict judge(std::size_t step, const Octets& heard) const;

private:
    /// Inputs of one slave under one configuration: the words that it gave, by their place.
    using Words = std::map<std::size_t, std::set<std::uint16_t>>;

    std::string odd_input(std::size_t step, const Octets& data) const;

    const ReplayScript& script_;
    DriveSide drive_;
    std::vector<std::size_t> layout_; ///< of each step: index into words_
    std::vector<Words> words_;
};

} // namespace dpslave::sim
