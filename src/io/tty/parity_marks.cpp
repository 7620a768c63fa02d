// SPDX-License-Identifier: Apache-2.0
#include "parity_marks.hpp"

namespace dpslave::io {

ParityMarks::Step ParityMarks::undo(Bytes raw, std::span<std::uint8_t> out) noexcept
{
    constexpr std::uint8_t kMark = 0xFF;
    Step step;
    for (; step.used < raw.size() && step.octets < out.size(); ++step.used) {
        const std::uint8_t octet = raw[step.used];
        switch (seen_) {
            case Seen::nothing:
                if (octet == kMark)
                    seen_ = Seen::ff;
                else
                    out[step.octets++] = octet;
                break;
            case Seen::ff:
                if (octet == 0x00) {
                    seen_ = Seen::ff_00;
                    break;
                }
                seen_ = Seen::nothing;
                if (octet == kMark) {
                    out[step.octets++] = octet;
                    break;
                }
                // FF alone is never sent by the line discipline: octets were lost here. The one at hand is
                // whole and stays.
                step.bad_character = true;
                return step;
            case Seen::ff_00:
                seen_ = Seen::nothing;
                step.bad_character = true;
                ++step.used;
                return step;
        }
    }
    return step;
}

} // namespace dpslave::io
