// SPDX-License-Identifier: Apache-2.0
/// Slave_Diag: six standard octets and blocks of extended diagnosis. Source: wire reference 5.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/dp/personality.hpp"

#include <cstddef>
#include <cstdint>

namespace dpslave::dp {

inline constexpr std::size_t kStandardDiagnosis = 6;
inline constexpr std::size_t kLongestBlock = 63; ///< device-related, header included (six bits of length)
inline constexpr std::uint8_t kNoMaster = 0xFF;  ///< Master_Add of a slave that no master has parameterised

/// Octets of the block of extended diagnosis that begins here, its header included; 0 = the header announces
/// more than is there (wire reference 5.3). Precondition: not empty.
std::size_t block_length(Bytes rest);

/// The six standard octets, by name.
struct StandardDiagnosis {
    bool station_not_ready = true;
    bool cfg_fault = false;
    bool ext_diag = false;
    bool not_supported = false;
    bool prm_fault = false;
    bool prm_req = true;
    bool stat_diag = false;
    bool watchdog_on = false;
    bool freeze = false;
    bool sync = false;
    bool overflow = false;
    std::uint8_t master = kNoMaster;
    std::uint16_t ident = 0;
};
void encode(const StandardDiagnosis& diagnosis, ByteBuffer<244>& into);

/// The extended part: blocks back to back as they go on the wire, no more complete blocks than fit.
class ExtendedDiagnosis {
public:
    /// Begins with the device's own block as zeros, if it has one. `personality` outlives it.
    explicit ExtendedDiagnosis(const Personality& personality) : personality_(personality) { set({}, false); }

    /// The result of setting the blocks.
    struct Outcome {
        bool changed = false; ///< a master would read another diagnosis now: to be reported to the owner
        bool well_formed =
            false; ///< false: a header announces more than is there; the blocks from there on are ignored
    };
    /// None: the device's own block as zeros. `fault`: a block reports a fault, not only a status.
    Outcome set(Bytes blocks, bool fault);

    Bytes blocks() const { return blocks_; }
    bool fault() const { return fault_ && !blocks_.empty(); }
    bool overflow() const { return overflow_; }

private:
    const Personality& personality_;
    ByteBuffer<244 - kStandardDiagnosis> blocks_;
    bool fault_ = false;
    bool overflow_ = false;
};

} // namespace dpslave::dp
