// SPDX-License-Identifier: Apache-2.0
/// One slave as its master sees it: which request is next, and whether a reply is what this slave must give.
/// Source: wire reference 2, 4.2 to 4.6. Shares no line with the daemon.
#pragma once

#include "support/wire.hpp"

#include <cstdint>
#include <span>

namespace dpslave::endurance {

using ::test::Octets;

inline constexpr std::uint8_t kMaster = 2;

/// How many octets the telegram that begins with `head` has; 0: not known yet.
std::size_t length_of(std::span<const std::uint8_t> head);

class SlaveTalk {
public:
    /// The drive behind the slave has 85.0 in tag 140 and 0x1C00 in tag 288, and takes tag 56.
    explicit SlaveTalk(std::uint8_t address);

    /// The request that is due: the next one, or the last one unchanged as long as it is not answered.
    const Octets& request();
    /// False: no reply that this slave may give, or a value that the drive does not have.
    bool takes(std::span<const std::uint8_t> reply);
    /// Begins anew, as a master that comes to the slave for the first time.
    void restart();

    std::uint8_t address() const { return address_; }
    bool exchanges() const { return state_ == State::data_exchange; }
    bool has_values() const
    {
        return exchanges() && has_values_;
    }                                                           ///< of the drive, in its last Data_Exchange
    const Octets& reply_with_values() const { return inputs_; } ///< with the values of the drive
    std::uint64_t start_ups() const { return start_ups_; }      ///< that ended in data exchange

private:
    enum class State : std::uint8_t { slave_diag, set_prm, chk_cfg, await_ready, data_exchange };

    Octets next_request();
    std::uint8_t next_fc();
    bool takes_diagnosis(std::span<const std::uint8_t> reply);
    bool takes_inputs(std::span<const std::uint8_t> reply);
    bool is_refusal(std::span<const std::uint8_t> reply) const;

    std::uint8_t address_;
    Octets inputs_;    ///< Data_Exchange reply with the values of the drive, low priority
    Octets no_inputs_; ///< the same before the first answer of the drive
    State state_ = State::slave_diag;
    Octets request_;          ///< that is not answered yet; empty: none
    std::uint8_t fc_ = 0;     ///< of the last request; 0: the next one begins a sequence
    bool diag_due_ = false;   ///< the last reply was one of high priority
    bool asks_diag_ = false;  ///< `request_` is a Slave_Diag
    bool has_values_ = false; ///< values have come since the start-up: they must not go any more
    std::uint16_t output_ = 0;
    std::uint64_t start_ups_ = 0;
};

} // namespace dpslave::endurance
