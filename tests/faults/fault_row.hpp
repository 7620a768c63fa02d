// SPDX-License-Identifier: Apache-2.0
/// What the rows of the fault matrix on the real programs stand on: an installation whose replies are timed
/// from outside of the daemon, values that show their order, and ways to look at what master, drive and
/// operator have.
#pragma once

#include "gateway.hpp"
#include "support/reply_watch/watch.hpp"
#include "support/row.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::test {

using Moment = std::chrono::steady_clock::time_point;
inline Moment now()
{
    return std::chrono::steady_clock::now();
}

/// One drive of this protocol ("ei-ascii", "modbus-rtu"). Words travel as they are: tag 55 is read, 56 and 57
/// are written. No master has 58: an operator may write it.
Wiring wiring_of(const std::string& protocol);
/// Of a master that exchanges these tags with it: in 1 is tag 55, out 1 is tag 56, out 2 is tag 57.
Arguments master_of(const std::string& protocol, Arguments more = {});

/// Given the row, when its test ends, then no reply was written after its window, by the daemon's own count
/// and by what was seen from outside of it; and each request that it heard and did not answer is in one of
/// its counters.
class FaultRow : public ::testing::Test {
protected:
    FaultRow();
    void TearDown() override;

    /// The installation, and a master in Data_Exch whose drive has taken `out 1 = 1` and shown `in 1 = 1`.
    void begins(Wiring wiring, const Arguments& master);
    void begins(const std::string& protocol = "ei-ascii")
    {
        begins(wiring_of(protocol), master_of(protocol));
    }
    /// Only the installation, timed.
    void installs(Wiring wiring);
    /// The rest of begins().
    void exchanges(const Arguments& settings);

    /// The master says nothing more and frees the line: two of them on one pty would take each other's
    /// answers.
    void master_leaves_the_bus();

    // --- What the three of them have.

    void drive_shows(int value); ///< in tag 55
    ::testing::AssertionResult master_sees(int value)
    {
        return master->does("wait 30s for in 1 = " + std::to_string(value));
    }
    ::testing::AssertionResult master_still_sees(int value)
    {
        return master->does("expect in 1 = " + std::to_string(value));
    }
    ::testing::AssertionResult master_stays_in_data_exchange();
    ::testing::AssertionResult master_wants(int value)
    {
        return master->does("out 1 = " + std::to_string(value));
    }
    ::testing::AssertionResult drive_takes(int value);
    /// That dpctl doctor names this rule soon; after the fault, that it names it no more.
    ::testing::AssertionResult doctor_names(const std::string& rule, bool named = true) const;
    ::testing::AssertionResult status_says(const std::string& words) const;

    /// X-51 "silent" or "diagnosis", when the drive is back: the master starts its station, or is told.
    ::testing::AssertionResult exchange_is_back(bool is_silent)
    {
        if (!is_silent) return master->does("wait 30s for diag not stat-diag");
        return master->does("start 30s");
    }

    // --- The order of values. A row sends rising ones, so an older one is a smaller one.

    /// What tag 56 was written to, in this order; from place `from` on.
    std::vector<int> taken(std::size_t from = 0) const;
    /// What the master has seen in input 1 since "follow on".
    std::vector<int> seen() const;
    static ::testing::AssertionResult never_an_older_one(const std::vector<int>& values);

    // --- The end of a fault.

    void fault_ends() { ended_ = now(); }
    void recovered() { recovered_in(now() - ended_); } ///< time since fault_ends()

    const Folder folder;
    reply_watch::Watch replies{folder / "replies"};
    std::optional<Gateway> gateway;
    std::optional<Master> master;
    bool restarts = false; ///< true: another daemon than the first one runs at the end, and counts from 0

    const Arguments& settings() const { return settings_; } ///< of the master of begins()

private:
    ::testing::AssertionResult counts_what_it_missed() const;

    Moment ended_{};
    Arguments settings_;
};

/// Once for each protocol of a drive line.
class RowOfADrive : public FaultRow, public ::testing::WithParamInterface<const char*> {
protected:
    bool is_modbus() const { return std::string{GetParam()} == "modbus-rtu"; }
};

} // namespace dpslave::test
