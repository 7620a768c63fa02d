// SPDX-License-Identifier: Apache-2.0
/// The one interface between layer 2 and its user. Layer 2 calls the user and gets the answer in the same
/// call; the user never calls layer 2. No call may block. Source: wire reference 2 and 3.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::fdl {

/// A valid request to a station address, as layer 2 hands it on.
struct Indication {
    std::uint8_t sa = 0;              ///< of the requester, 0..126
    std::optional<std::uint8_t> dsap; ///< service asked for; none = default SAP (Data_Exchange)
    std::optional<std::uint8_t> ssap; ///< the caller's SAP
    Bytes data;                       ///< user data without SAP octets; valid during the call
    Instant at{};                     ///< when its last octet was read: time for watchdogs
};

/// Says how layer 2 answers an SRD (FC codes of wire reference 2.4).
enum class Answer : std::uint8_t {
    sc,            ///< short acknowledge: accepted, nothing to return
    low,           ///< DL: response data
    high,          ///< DH: response data, diagnosis pending
    user_error,    ///< UE
    no_resource,   ///< RR
    not_activated, ///< RS: this service, or this requester at this SAP, is not active
};

/// User data of a reply: what fits into SD2 beside two SAP octets.
using ReplyData = ByteBuffer<244>;

/// Says whether a master owns and supervises this user: Baud_Control and DP_Control depend on it (wire
/// reference 7.1).
enum class Supervision : std::uint8_t {
    unowned,    ///< no master has parameterised it
    owned,      ///< parameterised, watchdog off
    supervised, ///< parameterised, watchdog on
};

/// The user of a station address: a DP slave.
class SapUser {
public:
    /// An SRD to this address that is to be executed. Fills `reply` (empty at the call) for Answer::low and
    /// high.
    virtual Answer srd(const Indication& request, ReplyData& reply) = 0;

    /// An SDN to this address or to all; never answered.
    virtual void sdn(const Indication& request) = 0;

    /// A valid request of `sa` that layer 2 answered alone (retry, FDL status). It retriggers the
    /// watchdog.
    virtual void heard(std::uint8_t sa, Instant at) = 0;

    /// The pause to keep before a reply; asked before srd(), so that Set_Prm takes effect after its own SC.
    virtual Tbit min_tsdr() const = 0;

    /// Asked after every call of this user, like next_deadline().
    virtual Supervision supervision() const = 0;

    /// Time passes; called at next_deadline() or later.
    virtual void on_time(Instant now) = 0;
    /// kNever = none. It may become earlier only inside a call of the station, which asks for it right after
    /// that call.
    virtual Instant next_deadline() const = 0;

protected:
    ~SapUser() = default;
};

} // namespace dpslave::fdl
