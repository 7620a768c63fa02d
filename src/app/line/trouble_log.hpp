// SPDX-License-Identifier: Apache-2.0
/// What the drives of a line refused: told once, published for `dpctl diag` until the access works. The
/// drive thread's own.
#pragma once

#include "app/links/links.hpp"

#include "dpslave/drive/poller.hpp"

#include <compare>
#include <set>
#include <string>
#include <vector>

namespace dpslave::app {

class TroubleLog {
public:
    /// Both outlive the object.
    TroubleLog(LineHappenings& happenings, Mailbox<TroubleList>& published)
        : happenings_(happenings), published_(published)
    {}

    /// `text`: why `access` was refused. One that is known already is not told again.
    void add(const DriveUnit& unit, const drive::Transaction& access, AccessError cause,
             const std::string& text);
    /// The access has worked.
    void remove(const DriveUnit& unit, const drive::Transaction& access);
    /// The drives of the line are `units` from now on.
    void keep_only(const std::vector<DriveUnit>& units);
    /// The unit has the rows of `next` from now on: what was refused of one row says nothing about another.
    void remove_changed_rows(const DriveUnit& unit, const config::StationConfig& next);

private:
    template <class Condition>
    void remove_if(Condition condition);

    /// What was told of a tag and is not mended: there may be more of them than are published.
    struct Told {
        std::uint32_t station = 0;
        std::uint16_t tag = 0;
        bool is_write = false;
        AccessError error = AccessError::none;
        auto operator<=>(const Told&) const = default;
    };

    LineHappenings& happenings_;
    Mailbox<TroubleList>& published_;
    TroubleList list_;
    std::set<Told> told_;
};

} // namespace dpslave::app
