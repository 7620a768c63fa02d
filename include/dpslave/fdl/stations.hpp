// SPDX-License-Identifier: Apache-2.0
/// The station addresses of one bus that are served here: from a request to its reply. Makes no system call,
/// starts no thread, allocates nothing. Source: wire reference 1.5, 2.6, 3.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/sap_user.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

namespace dpslave::fdl {

/// One value of max T_SDR per rate, in the order of kBauds.
using MaxTsdr = std::array<Tbit, kBauds.size()>;

class Stations {
public:
    /// A reply and the window for its first bit, counted from the end of the request.
    struct Reply {
        Bytes octets;             ///< valid until the next request to the same address
        const Telegram* telegram; ///< what they say; valid as long
        Tbit not_before;
        Tbit not_after;        ///< later there is no reply: it would collide with the retry
        bool repeated = false; ///< the request was a retry, and this is the stored reply
    };

    /// Attaches and detaches as Layer2::attach() and detach() say. Call on_time() after both.
    bool attach(std::uint8_t address, SapUser& user, const MaxTsdr& max_tsdr);
    void detach(std::uint8_t address);
    bool has(std::uint8_t address) const
    {
        return address < kAddresses && stations_[address].user != nullptr;
    }

    /// The reply to a valid request with an answer, read at `at`. Precondition: has(request.da).
    Reply on_request(const Telegram& request, Instant at, Baud baud);
    /// SDN, to one address or to all. Precondition: has(telegram.da), or it is kBroadcast.
    void on_sdn(const Telegram& telegram, Instant at);
    /// The rate is another: no request repeats one from before.
    void forget_requests();

    /// Time passes. Returns true if users were called.
    bool on_time(Instant now);
    /// A lower bound of what the users ask for, so that no telegram has to ask all of them.
    Instant next_deadline() const { return users_due_; }

    bool any_owned() const { return owned_ != 0; }           ///< by a master that has parameterised it
    bool any_supervised() const { return supervised_ != 0; } ///< and has its watchdog on
    /// Returns which users were called since the last take. Bit n = address n.
    std::bitset<128> take_touched();

private:
    static constexpr std::size_t kAddresses = 127; // 0..126

    /// A reply, and what it says.
    struct Encoded {
        Frame octets;
        Telegram telegram;
    };
    /// One station address: its user, and its frame count memory (wire reference 2.6).
    struct Station {
        SapUser* user = nullptr;
        MaxTsdr max_tsdr{};
        Supervision supervision = Supervision::unowned;
        bool stored = false; // whether what follows is valid
        bool fcb = false;    // FCBM
        std::uint8_t sa = 0; // SAM
        Function function{}; // of the stored request
        std::optional<std::uint8_t> dsap;
        Encoded reply;
    };

    void answer(Station& station, const Telegram& request, Instant at, Encoded& reply);
    static bool is_retry(const Station& station, const Telegram& request);
    void called(std::uint8_t address);
    void sample(Station& station);
    void count_supervision(Station& station, Supervision now);

    std::array<Station, kAddresses> stations_{};
    std::array<std::uint8_t, kAddresses> attached_{}; // the addresses in use, for what concerns all of them
    std::size_t attached_count_ = 0;
    std::size_t owned_ = 0;      // how many users a master has parameterised
    std::size_t supervised_ = 0; // how many of them with the watchdog on
    Instant users_due_ = kNever; // no user wants on_time() before this
    std::bitset<128> touched_;
    Encoded unstored_; // a reply that belongs to no frame count sequence
    ReplyData scratch_;
};

} // namespace dpslave::fdl
