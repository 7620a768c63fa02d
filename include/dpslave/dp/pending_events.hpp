// SPDX-License-Identifier: Apache-2.0
/// Keeps what happened to a slave, in order, until the program has logged it.
#pragma once

#include "dpslave/base/queue.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/slave_diag.hpp"
#include "dpslave/dp/state.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::dp {

struct Event {
    enum class Kind : std::uint8_t {
        state,           ///< `state` was entered from another; `reason` says why that one was left
        refused,         ///< `refusal`: a Set_Prm or Chk_Cfg of `master`
        foreign_set_prm, ///< `master` tried to parameterise a slave that another one owns
        sync,
        unsync,
        freeze,
        unfreeze,
        clear_data, ///< the first Clear_Data after an exchange without; a master in CLEAR repeats it for ever
        watchdog_of_master, ///< parameterised with the watchdog off: outputs hold for ever if the master
                            ///< vanishes
        overflow,           ///< events were lost here because they were not fetched in time
    };
    Kind kind = Kind::state;
    State state = State::power_on;
    LeaveReason reason = LeaveReason::none;
    std::uint8_t master = kNoMaster; ///< the owner, on leaving the one until then; else whom it concerns
    RefusalDetail refusal{};
    friend bool operator==(const Event&, const Event&) = default;
};

/// Keeps up to 16 events until they are fetched. Events that come while it is full are lost, and one
/// `overflow` takes their place. It is for one thread and allocates nothing.
class PendingEvents {
public:
    void add(const Event& event);
    /// It is not added again when it was the last event: a master that sends the same wrong Set_Prm for ever
    /// fills no log (the counters go on).
    void add_once(const Event& event);
    /// The oldest event; none left = nothing. `state` and `master` are those of now, for an overflow.
    std::optional<Event> take(State state, std::uint8_t master);

private:
    Queue<Event, 16> events_;
    Event last_{.kind = Event::Kind::overflow};
    bool lost_ = false;
};

} // namespace dpslave::dp
