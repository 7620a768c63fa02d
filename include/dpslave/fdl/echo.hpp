// SPDX-License-Identifier: Apache-2.0
/// A transceiver that hears what it sends: our own octets, to be taken away before layer 2 sees them. Octets
/// in, octets out; no clock of its own, no allocation. Source: wire reference 11.7.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/echo_mode.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace dpslave::fdl {

/// Compares what comes with what was sent last. This costs no telegram where there is no echo: no request can
/// be the beginning of a reply of ours, because the direction of their addresses differs. So the octets are
/// given back as soon as they differ, whatever was concluded before.
class Echo {
public:
    /// The received octets that are not our echo. `withheld` came with earlier calls, looked like an echo
    /// until now, and belongs in front of `octets`.
    struct Foreign {
        Bytes withheld;
        Bytes octets;
    };

    explicit Echo(EchoMode mode) : mode_(mode) {}

    /// `telegram` goes out now. Until `quiet_until` (its last stop bit and T_SYN) no other station may send,
    /// so octets that differ from it are a broken echo; by `until` its echo, if there is one, has been read.
    void sent(Bytes telegram, Instant quiet_until, Instant until) noexcept;
    /// Octets that were read at `at`. Octets that differ from what was sent (collision, short circuit) are
    /// given back with all that was withheld: layer 2 hunts through them. Valid until the next call.
    Foreign remove(Bytes octets, Instant at) noexcept;
    /// A bad character came at `at`, in the middle of an echo or not. Returns what was withheld: layer 2 gets
    /// it before the bad character.
    Bytes on_character_error(Instant at) noexcept;

    /// True if there is an echo, by configuration or because one was detected.
    bool is_heard() const noexcept;
    /// automatic: not found out yet.
    bool is_open() const noexcept;
    std::uint64_t removed() const noexcept { return removed_; } ///< telegrams whose complete echo was removed
    std::uint64_t broken() const noexcept { return broken_; }   ///< echoes that were not what was sent
    std::uint64_t missing() const noexcept { return missing_; } ///< echoes that were due and did not come

private:
    enum class Outcome : std::uint8_t { whole, broken, missing };
    enum class Finding : std::uint8_t { open, heard, unheard };

    bool is_expected(Instant at) noexcept;
    void conclude(Outcome outcome) noexcept;

    EchoMode mode_;
    Finding finding_ = Finding::open;
    std::array<std::uint8_t, kMaxTelegram> expected_{};
    std::size_t length_ = 0; ///< 0 = no echo is expected
    std::size_t matched_ = 0;
    Instant quiet_until_{};
    Instant until_{};
    std::uint8_t heard_in_row_ = 0;
    std::uint8_t unheard_in_row_ = 0;
    std::uint64_t removed_ = 0;
    std::uint64_t broken_ = 0;
    std::uint64_t missing_ = 0;
};

} // namespace dpslave::fdl
