// SPDX-License-Identifier: Apache-2.0
/// Asks the daemon for all that `dpctl top` shows, and can be interrupted meanwhile.
#pragma once

#include "dpctl/cli/subcommands.hpp"
#include "figures.hpp"

#include "dpslave/control/client.hpp"

#include <functional>
#include <optional>
#include <utility>

namespace dpslave::dpctl {

/// Why there is no further look. Neither: the end was wanted.
struct Stopped {
    std::optional<control::ClientError> failed{};
    std::optional<control::ReplyMessage> refused{};
};

/// Over one connection, one call at a time.
class Observer {
public:
    /// The replies as they came, by key as kTopJson (json_forms.hpp) describes them, and their moment.
    struct Replies {
        control::Json all;
        std::chrono::nanoseconds at{}; ///< steady clock, when the counters came
        double unix_seconds = 0;       ///< since 1970, likewise
    };

    Observer(control::Client client, const Options& options) : client_(std::move(client)), options_(options)
    {}
    /// Waits for the daemon. `on_wake` is called whenever `wake` is readable meanwhile; false from it: the
    /// end is wanted.
    Result<Replies, Stopped> look(int wake, const std::function<bool()>& on_wake);

private:
    Result<control::Json, Stopped> ask(const char* method, const control::Json& parameters, int wake,
                                       const std::function<bool()>& on_wake);
    control::Json event_parameters() const;

    control::Client client_;
    const Options& options_;
    std::optional<std::int64_t> newest_; ///< number of the last event; none: it was not asked yet
};

/// `replies` as structs, their texts printable().
std::pair<Sighting, report::GetEventsReply> read_replies(const Observer::Replies& replies);

} // namespace dpslave::dpctl
