// SPDX-License-Identifier: Apache-2.0
/// A master that talks to one station: start-up and Data_Exchange, as any master does them.
#pragma once

#include "port.hpp"
#include "responder.hpp"
#include "wire.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dpslave::bench {

/// Sends what a request needs: the address and the frame count bit.
class Talk {
public:
    explicit Talk(Port& port, std::uint8_t address = kSlave);

    /// Slave_Diag, Set_Prm, Chk_Cfg, and Slave_Diag until the station is ready. Throws if it does not become
    /// so, or if `daemon` ends.
    void start_up(Child& daemon, Words words = Words::all_read);

    /// One Data_Exchange. Gives the time to the end of the answer; with the slot time of each request that
    /// had to be repeated. Throws if the answer is wrong, or there is none at all.
    std::chrono::nanoseconds exchange();
    /// The same with `value` in every output word.
    std::chrono::nanoseconds exchange(std::uint16_t value);

    /// Requests that had to be sent again.
    std::size_t retries() const { return retries_; }

private:
    struct Reply {
        Port::Answer answer;
        std::size_t retries = 0;
    };

    std::uint8_t next_fc();
    std::optional<Reply> ask(const Octets& request);
    std::chrono::nanoseconds exchange(const Octets& request);
    std::array<std::uint8_t, 2> station_status(Child& daemon);
    void expect_sc(const Octets& request, const char* what);

    Port& port_;
    std::uint8_t address_;
    Words words_ = Words::all_read;
    std::uint8_t fc_ = 0x6D; ///< of the next request: this one begins a sequence
    std::size_t retries_ = 0;
    Octets first_, even_, odd_; ///< Data_Exchange by FC
};

/// Between two telegrams of a master that keeps to the pace of a bus: 50 us. The shortest pause of a master
/// at 1.5 Mbit/s (T_ID1) is 25 us.
void pause();

} // namespace dpslave::bench
