// SPDX-License-Identifier: Apache-2.0
/// The calls of one method whose orders a drive line carries out: what is known of each, of type T. Main
/// thread only.
#pragma once

#include "app/state/station.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/control/server.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dpslave::app {

template <class T>
class WaitingCalls {
public:
    /// `station`: its number. The call ends at `due`, whatever the line does.
    struct Call {
        control::ReplyTo to{};
        std::uint32_t station = 0;
        Instant due{};
        T what{};
    };

    bool empty() const { return calls_.empty(); }
    std::size_t size() const { return calls_.size(); }
    /// The number of the order whose call is added next.
    std::uint32_t next_number() const { return next_; }
    void add(Call call) { calls_.emplace(next_++, std::move(call)); }
    /// The call whose order has been answered, which waits no longer. Nothing: it has ended before.
    std::optional<Call> take(std::uint32_t number)
    {
        auto found = calls_.extract(number);
        return found ? std::optional{std::move(found.mapped())} : std::nullopt;
    }
    /// Calls `use(number, call)` for each, in the order of their numbers.
    template <class Use>
    void each(Use use)
    {
        for (auto& [number, call] : calls_) use(number, call);
    }
    template <class Has>
    std::size_t count(Has has) const
    {
        return static_cast<std::size_t>(
            std::count_if(calls_.begin(), calls_.end(), [&](const auto& one) { return has(one.second); }));
    }
    /// Those that are due wait no longer. `end(number, call)` sends their last replies; false: it waits on,
    /// for the line has just answered it.
    template <class End>
    void end_late(Instant now, End end)
    {
        end_if([now](const Call& call) { return call.due <= now; }, end);
    }
    /// The same for the calls of stations that left by a reload.
    template <class End>
    void end_of(const std::vector<Station>& left, End end)
    {
        const auto has_left = [&left](const Call& call) {
            return std::any_of(left.begin(), left.end(),
                               [&call](const Station& station) { return station.number == call.station; });
        };
        end_if(has_left, end);
    }

    /// The same for those of which `is(call)`.
    template <class Is, class End>
    void end_where(Is is, End end)
    {
        end_if(is, end);
    }

private:
    template <class Is, class End>
    void end_if(Is is, End end)
    {
        for (auto one = calls_.begin(); one != calls_.end();) {
            const bool ends = is(one->second) && end(one->first, one->second);
            one = ends ? calls_.erase(one) : std::next(one);
        }
    }

    std::uint32_t next_ = 1;
    std::map<std::uint32_t, Call> calls_; ///< by the number of the order
};

} // namespace dpslave::app
