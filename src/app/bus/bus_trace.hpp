// SPDX-License-Identifier: Apache-2.0
/// What the bus thread hears and sends, on its way to the ring of the trace. It is noted where it happens and
/// put into the ring by commit(), while a reply waits for its window or when it is out. Allocates nothing.
#pragma once

#include "dpslave/fdl/layer2.hpp"
#include "dpslave/trace/ring.hpp"

#include <array>
#include <cstddef>

namespace dpslave::app {

class BusTrace {
public:
    /// `ring` outlives this object; it may be off.
    explicit BusTrace(trace::Ring& ring) : ring_(ring) {}

    /// One read, without the echo of replies. `octets` stay as they are until commit().
    void heard(Bytes octets, Instant read_at, bool more_follows, Baud baud);
    /// In the place of an octet that the UART reported as bad.
    void bad_character(Instant read_at, Baud baud);
    /// A reply, written from `begun` to `written`. `octets` stay as they are until commit().
    void sent(Bytes octets, Instant begun, Instant written, Baud baud);
    /// A request of ours that gets no reply; `why` of layer 2 or of the port.
    void unanswered(const fdl::Unanswered& request, Baud baud);
    /// Layer 2 has given up what was unfinished.
    void silence(Instant at, Baud baud);
    /// The bus goes on at another rate.
    void rate(Instant now, Baud baud);

    /// Puts what was noted into the ring, in its order.
    void commit();

private:
    struct Noted {
        trace::Head head;
        Bytes octets;
    };
    void note(const trace::Head& head, Bytes octets);

    trace::Ring& ring_;
    std::array<Noted, 8> noted_{};
    std::size_t count_ = 0;
};

} // namespace dpslave::app
