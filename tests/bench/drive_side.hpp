// SPDX-License-Identifier: Apache-2.0
/// Poller and client as the drive thread calls them, on a line where only frames and the drive take time.
#pragma once

#include "drive/fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/poller.hpp"

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::bench {

inline constexpr std::size_t kParameters = 12;             ///< in Data_Exch: tags 1 to 12
inline constexpr std::uint16_t kDemandTag = 13;            ///< of Demand Data
inline constexpr std::chrono::milliseconds kTurnaround{4}; ///< of the drive
inline constexpr std::uint16_t kWord = 1234;               ///< of every tag, with two decimals
inline constexpr std::string_view kText = "12.34";         ///< the same as EI-ASCII writes it

/// Of a tag of these tables.
std::string mnemonic_of(std::uint16_t tag);
/// Every second parameter is written.
constexpr bool is_written(std::size_t parameter)
{
    return parameter % 2 != 0;
}

/// A drive on an EI-ASCII line, and the client that asks it.
struct EiAsciiDrive {
    explicit EiAsciiDrive(std::uint32_t baud);

    drive::test::FakeDrive drive{'0', '1'};
    drive::test::SimulatedLine line;
    drive::EiAsciiClient client;
};

/// The poller of one drive behind a back-end whose clock is `clock`.
class DriveSide {
public:
    /// `compares`: DriveSettings::compare_outputs.
    DriveSide(drive::Backend& backend, Instant& clock, bool compares);

    drive::Poller& poller() { return poller_; }
    /// One transaction, or the wait for the next one until `limit` at most. What the transaction took.
    std::chrono::nanoseconds step(Instant limit);
    /// The last whole round; 0: there was none yet.
    std::chrono::nanoseconds cycle() const { return poller_.snapshot(0).cycle; }

private:
    std::vector<drive::DriveSettings> settings(bool compares) const;
    AccessError carry_out(const drive::Transaction& transaction);

    const drive::TagTable table_;
    drive::Backend& backend_;
    Instant& clock_;
    drive::Poller poller_;
    std::vector<std::uint16_t> words_;
};

} // namespace dpslave::bench
