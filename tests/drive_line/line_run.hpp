// SPDX-License-Identifier: Apache-2.0
/// Poller and client on a simulated line, called as the drive thread calls them, with masters and an operator
/// that want something new all the time, and drives that die, return, deny tags and refuse writes.
#pragma once

#include "judge.hpp"
#include "loss_judge.hpp"

#include "dpslave/drive/poller.hpp"

#include <memory>
#include <optional>
#include <string>

namespace dpslave::drive_line {

struct RunRules {
    bool compare_outputs = false; ///< Modbus
    bool masters_act = true;      ///< false: the test itself says what the masters do
    Time output_refresh = 1s;
    std::vector<drive::ZeroAfter> zero_after; ///< of each drive
    std::vector<std::uint16_t> watched;
    int retries = 2;
    drive::LossRule loss; ///< not hold: drives fall silent and answer sparingly more often
};

class LineRun {
public:
    LineRun(SimulatedLine& line, drive::Backend& backend, const std::vector<drive::TagTable>& tables,
            const RunRules& rules);

    /// Until so many transactions were made, or something was wrong.
    void live(std::uint64_t transactions);
    void live_for(Time duration);
    /// Ends all faults and waits until every drive holds what its master wants and every input is what its
    /// drive holds; says what is still wrong after `limit`.
    void settle(Time limit);

    const std::optional<std::string>& violation() const { return violation_; }
    std::uint64_t transactions() const { return transactions_; }
    drive::Poller& poller() { return poller_; }
    Judge& judge() { return judge_; }
    const LossJudge& loss_judge() const { return loss_judge_; }

    // What the master of a drive does.
    void enter(std::size_t drive, const std::vector<LayoutEntry>& parameters);
    void change(std::size_t drive);
    void leave(std::size_t drive);
    const OutputImage& image(std::size_t drive) const { return masters_[drive].image; }
    const drive::DriveSnapshot& seen(std::size_t drive) const { return poller_.snapshot(drive); }

    /// How often a drive was made silent or sparing of answers.
    std::uint64_t silences() const { return silences_; }

    /// Called after each transaction.
    std::function<void(const drive::Transaction&, AccessError, Instant began)> on_transaction;

private:
    static constexpr std::uint32_t kFirstSurvey = 1'000'000; ///< orders of the operator stay below

    struct Master {
        OutputImage image;
        std::uint32_t orders = 0;
        Instant returns_at = kNever; ///< its drive
    };

    void step(Instant until);
    void carry_out(const drive::Transaction& transaction);
    void publish();
    void act();
    void choose_layout(std::size_t drive);
    void order(std::size_t drive);
    void operate(std::size_t drive);
    void disturb(std::size_t drive);
    void disturb_presence(std::size_t drive);
    void note_presence();
    void report_violation(const std::string& text);

    SimulatedLine& line_;
    drive::Backend& backend_;
    RunRules rules_;
    std::vector<drive::DriveSettings> settings_;
    drive::Poller poller_;
    Judge judge_;
    LossJudge loss_judge_;
    std::vector<Master> masters_;
    std::vector<std::uint16_t> words_;
    Generation generation_ = 0;
    std::uint32_t operates_ = 0;
    Instant act_at_{};
    std::uint64_t transactions_ = 0;
    std::uint64_t silences_ = 0;
    std::uint32_t surveys_ = kFirstSurvey;
    unsigned without_time_ = 0; ///< transactions in a row that took none
    std::optional<std::string> violation_;
};

} // namespace dpslave::drive_line
