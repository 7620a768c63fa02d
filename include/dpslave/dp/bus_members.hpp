// SPDX-License-Identifier: Apache-2.0
/// Lists who is on the bus, from the telegrams that are heard: masters and slaves, what they ask and answer,
/// how often and how much. It also lists the addresses that masters ask without an answer. A constant time
/// for each telegram; makes no system call and allocates nothing. Source: wire reference 2 (telegrams), 4.1
/// (SAPs), 5.1 (Slave_Diag).
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"
#include "dpslave/fdl/telegram_listener.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::dp {

/// Something that comes again and again: the times from one to the next, and the octets sent. It is about the
/// last complete window; before the first one is complete, about the present one.
class Recurrence {
public:
    /// A window ends with the first event or octet this long after its begin.
    static constexpr std::chrono::seconds kWindow{10};

    /// These figures say what the windows have shown. Times are 0 where `intervals` is 0.
    struct Figures {
        std::uint32_t intervals = 0;
        std::chrono::nanoseconds min{}, mean{}, max{};
        double octets_per_second = 0;
    };

    void event(Instant at);
    void octets(std::size_t count, Instant at);
    /// Returns the figures; all are 0 if nothing was added for two windows.
    Figures figures(Instant now) const;

private:
    struct Window {
        Instant begin{};
        std::chrono::nanoseconds sum{}, min{}, max{};
        std::uint32_t intervals = 0;
        std::uint32_t octets = 0;
    };
    void roll(Instant at);

    Window current_, complete_;
    std::chrono::nanoseconds complete_took_{};
    Instant last_event_{};
};

/// One address.
struct Member {
    /// The state in which a slave was seen. The last diagnosis or the last answer to Data_Exchange says so.
    enum class State : std::uint8_t {
        unknown,
        prm_required, ///< Prm_Req: no master has parameterised it
        prm_fault,
        cfg_fault,
        not_ready, ///< Station_Not_Ready without a fault
        ready,     ///< its diagnosis has none of these bits
        exchange,  ///< it answers Data_Exchange
    };
    bool is_master = false; ///< it was heard to ask, or to hold the token
    bool is_slave = false;  ///< it was heard to answer as a slave
    State state = State::unknown;
    std::optional<std::uint16_t> ident; ///< out of its diagnosis or of a Set_Prm to it
    std::uint8_t asked_by = 0;          ///< the master that asked it last
    std::uint32_t unanswered = 0;       ///< requests for data since its last answer
    std::uint64_t asked = 0;            ///< requests for data to it, without retries
    std::uint64_t retries = 0;          ///< requests that were repeated because no answer came
    std::uint64_t answers = 0;
    Instant last_heard{}, last_asked{}; ///< default = never
    /// A slave: its octets, and the times between two new Data_Exchange. A master: its octets, and the times
    /// between two tokens to it (rotation of the token).
    Recurrence recurrence;

    bool was_seen() const { return is_master || is_slave || asked != 0; }
};
std::string_view text(Member::State state) noexcept;

/// An address that masters ask and that does not answer.
struct UnansweredAddress {
    std::uint8_t address = 0;
    std::uint8_t master = 0;    ///< the last one that asked
    std::uint32_t requests = 0; ///< since its last answer; 0: this place of a list is empty
    Instant last{};             ///< when it was asked last
};

class BusMembers final : public fdl::TelegramListener {
public:
    static constexpr std::size_t kAddresses = 127;
    using Table = std::array<Member, kAddresses>; ///< index = address
    /// At most this number of unanswered addresses is reported: those with the most requests.
    static constexpr std::size_t kMostReported = 4;
    using UnansweredList = std::array<UnansweredAddress, kMostReported>;

    /// A valid telegram of any station, also the replies of our own. FDL_Status is not a request for data:
    /// masters ask every free address for it. An SC answers the request right before it.
    void on_telegram(const fdl::Telegram& telegram, Instant at) override;

    const Table& table() const { return members_; }
    /// Those that do not answer, the most asked first.
    UnansweredList unanswered() const;

private:
    void on_request(const fdl::Telegram& request, Instant at);
    void on_answer(Member& member, const fdl::Telegram& answer, Instant at);

    /// The request that the next telegram may answer.
    struct Asked {
        std::uint8_t address = 0;
        bool for_data_exchange = false;
    };
    Table members_{};
    std::array<std::uint8_t, kAddresses> last_fc_{}; ///< of the newest request with FCV; 0 = answered since
    std::optional<Asked> asked_;
};

} // namespace dpslave::dp
