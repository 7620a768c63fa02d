// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/slave_diag.hpp"

#include <algorithm>

namespace dpslave::dp {
namespace {

/// Octets of the block that begins with `header`, itself included; 0 = no legal header (wire reference 5.3).
constexpr std::size_t block_length(std::uint8_t header)
{
    switch (header >> 6) {
        case 2: return 3; // channel-related
        case 3: return 1; // revision number
        default: {        // device- or identifier-related
            const std::size_t length = header & 0x3F;
            return length >= 2 ? length : 0;
        }
    }
}

constexpr unsigned flag(bool set, unsigned mask)
{
    return set ? mask : 0u;
}

} // namespace

void encode(const StandardDiagnosis& d, ByteBuffer<244>& into)
{
    // Bits that only a master sets (Station_Non_Existent, Invalid_Slave_Response, Master_Lock, Deactivated)
    // stay 0.
    into.push(static_cast<std::uint8_t>(flag(d.station_not_ready, 0x02) | flag(d.cfg_fault, 0x04) |
                                        flag(d.ext_diag, 0x08) | flag(d.not_supported, 0x10) |
                                        flag(d.prm_fault, 0x40)));
    into.push(static_cast<std::uint8_t>(flag(d.prm_req, 0x01) | flag(d.stat_diag, 0x02) | 0x04 |
                                        flag(d.watchdog_on, 0x08) | flag(d.freeze, 0x10) |
                                        flag(d.sync, 0x20)));
    into.push(static_cast<std::uint8_t>(flag(d.overflow, 0x80)));
    into.push(d.master);
    into.push16(d.ident);
}

ExtendedDiagnosis::Outcome ExtendedDiagnosis::set(Bytes blocks, bool fault, std::size_t room)
{
    ByteBuffer<244 - kStandardDiagnosis> kept;
    room = std::min(room, kept.capacity());
    bool overflow = false;
    bool well_formed = true;
    for (Bytes rest = blocks; !rest.empty();) {
        const std::size_t length = block_length(rest[0]);
        well_formed = length != 0 && length <= rest.size();
        if (!well_formed) break;
        overflow = kept.size() + length > room;
        if (overflow) break;
        kept.append(rest.first(length));
        rest = rest.subspan(length);
    }
    const bool old_fault = this->fault();
    const bool same_blocks = std::ranges::equal(kept.bytes(), blocks_.bytes());
    const bool same_overflow = overflow == overflow_;
    blocks_ = kept;
    fault_ = fault;
    overflow_ = overflow;
    return {.changed = !same_blocks || !same_overflow || old_fault != this->fault(),
            .well_formed = well_formed};
}

} // namespace dpslave::dp
