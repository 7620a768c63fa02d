// SPDX-License-Identifier: Apache-2.0
/// What the drives of a line refused: logged once, published for `dpctl diag` until the access works. The
/// drive thread's own.
#pragma once

#include "app/limited_log.hpp"
#include "app/links.hpp"

#include "dpslave/drive/poller.hpp"

#include <string>
#include <vector>

namespace dpslave::app {

class TroubleLog {
public:
    /// Both outlive the object.
    TroubleLog(LimitedLog& log, Mailbox<TroubleList>& published) : log_(log), published_(published) {}

    /// `text`: why `access` was refused. One that is known already is not logged again.
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

    LimitedLog& log_;
    Mailbox<TroubleList>& published_;
    TroubleList list_;
};

} // namespace dpslave::app
