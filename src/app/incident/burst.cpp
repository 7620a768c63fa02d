// SPDX-License-Identifier: Apache-2.0
#include "burst.hpp"

namespace dpslave::app {

bool Burst::count(std::uint64_t total, Instant now)
{
    if (!at_begin_ || now - begin_ > kWithin) {
        begin_ = at_begin_ ? looked_at_ : now;
        at_begin_ = at_begin_ ? newest_ : total;
    }
    looked_at_ = now;
    if (total != newest_) grew_at_ = now;
    newest_ = total;
    if (lasts_) {
        lasts_ = now - grew_at_ < kWithin;
        return false;
    }
    lasts_ = total - *at_begin_ >= kLeast;
    return lasts_;
}

} // namespace dpslave::app
