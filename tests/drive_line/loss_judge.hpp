// SPDX-License-Identifier: Apache-2.0
/// Says whether a station leaves if, and only if, its drive is gone, and whether what it shows after
/// that is fresh. It knows what of each drive came over the wire, and nothing of how the program decides.
#pragma once

#include "simulated_line.hpp"

#include "dpslave/drive/poller.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dpslave::drive_line {

class LossJudge {
public:
    LossJudge(SimulatedLine& line, const drive::LossRule& rule, int retries);

    /// The drive has answered a question in time.
    void answered(std::size_t drive);
    /// Its master chooses a layout; or leaves, with these outputs.
    void entered(std::size_t drive);
    void left(std::size_t drive, const OutputImage& image, bool goes_to_zero);

    // What the drive side shows.
    void shown(std::size_t drive, const drive::DriveSnapshot& snapshot);
    void shown(std::size_t drive, const Layout& layout, const InputImage& image);

    std::uint64_t departures() const { return departures_; }
    const std::optional<std::string>& violation() const { return violation_; }

private:
    struct Record {
        bool is_away = true; ///< until it has answered
        bool has_answered = false;
        Instant answered_at{};
        Instant entered_at{};
        Instant left_at{};
        std::vector<std::uint16_t> to_zero; ///< outputs of the layout that ended with its drive
    };

    void report_violation(std::size_t drive, const std::string& text);
    void judge_leaving(std::size_t drive);
    void judge_staying(std::size_t drive);
    void judge_appearing(std::size_t drive, const drive::DriveSnapshot& snapshot);
    Time question() const;

    SimulatedLine& line_;
    drive::LossRule rule_;
    int retries_;
    std::vector<Record> records_;
    std::uint64_t departures_ = 0;
    std::optional<std::string> violation_;
};

} // namespace dpslave::drive_line
