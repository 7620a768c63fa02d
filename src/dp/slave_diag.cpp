// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/slave_diag.hpp"

#include <algorithm>

namespace dpslave::dp {
namespace {

constexpr unsigned flag(bool set, unsigned mask)
{
    return set ? mask : 0u;
}

} // namespace

std::size_t block_length(Bytes rest)
{
    std::size_t length = rest[0] & 0x3FU; // device- or identifier-related
    if (rest[0] >> 6 == 2) length = 3;    // channel-related
    if (rest[0] >> 6 == 3)
        length = 1; // revision number
    else if (length < 2)
        length = 0;
    return length <= rest.size() ? length : 0;
}

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

ExtendedDiagnosis::Outcome ExtendedDiagnosis::set(Bytes blocks, bool fault)
{
    std::array<std::uint8_t, kLongestBlock> zeros{};
    if (blocks.empty() && personality_.diag_octets != 0) {
        const std::size_t length = std::min<std::size_t>(personality_.diag_octets + 1u, zeros.size());
        zeros[0] = static_cast<std::uint8_t>(length); // bits 7 and 6 clear: device-related
        blocks = Bytes{zeros}.first(length);
    }
    ByteBuffer<244 - kStandardDiagnosis> kept;
    const std::size_t longest = std::max(personality_.max_diag_length, kStandardDiagnosis);
    const std::size_t room = std::min(longest - kStandardDiagnosis, kept.capacity());
    bool overflow = false;
    bool well_formed = true;
    for (Bytes rest = blocks; !rest.empty();) {
        const std::size_t length = block_length(rest);
        well_formed = length != 0;
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
