// SPDX-License-Identifier: Apache-2.0
#include "bus_trace.hpp"

namespace dpslave::app {

namespace {

std::uint8_t number_of(Baud baud)
{
    return static_cast<std::uint8_t>(index_of(baud));
}

} // namespace

void BusTrace::heard(Bytes octets, Instant read_at, bool more_follows, Baud baud)
{
    note({.kind = trace::Kind::heard, .rate = number_of(baud), .more_follows = more_follows, .at = read_at},
         octets);
}

void BusTrace::bad_character(Instant read_at, Baud baud)
{
    note({.kind = trace::Kind::bad_character, .rate = number_of(baud), .at = read_at}, {});
}

void BusTrace::sent(Bytes octets, Instant begun, Instant written, Baud baud)
{
    note({.kind = trace::Kind::sent, .rate = number_of(baud), .at = written, .begun = begun}, octets);
}

void BusTrace::unanswered(const fdl::Unanswered& request, Baud baud)
{
    note({.kind = trace::Kind::unanswered,
          .detail = static_cast<std::uint8_t>(request.why),
          .rate = number_of(baud),
          .address = request.address,
          .at = request.at},
         {});
}

void BusTrace::silence(Instant at, Baud baud)
{
    note({.kind = trace::Kind::silence, .rate = number_of(baud), .at = at}, {});
}

void BusTrace::rate(Instant now, Baud baud)
{
    note({.kind = trace::Kind::rate, .rate = number_of(baud), .at = now}, {});
}

void BusTrace::note(const trace::Head& head, Bytes octets)
{
    if (!ring_.is_on()) return;
    if (count_ == noted_.size()) commit();
    noted_[count_++] = {head, octets};
}

void BusTrace::commit()
{
    for (std::size_t i = 0; i < count_; ++i) ring_.put(noted_[i].head, noted_[i].octets);
    count_ = 0;
}

} // namespace dpslave::app
