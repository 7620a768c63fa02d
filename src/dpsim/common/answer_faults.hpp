// SPDX-License-Identifier: Apache-2.0
/// Changes the replies of a device on their way: they are late, lost, preceded by a spoilt frame, or
/// replaced. It is the same for both protocols.
#pragma once

#include "telegram.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace dpslave::sim {

/// A request as far as a fault may choose it: the tags that it concerns; none: something else (EE, function
/// 8).
struct Concerned {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
};

/// A reply that is sent this much later than a prompt one.
struct Departure {
    Octets octets;
    std::chrono::nanoseconds later{0};
    bool is_late = false; ///< it comes even if the master has asked something else by then
};

class AnswerFaults {
public:
    /// Adds a fault. `words` as typed: late MS[-MS], lose, spoil, instead OCTETS, noise OCTETS; then which
    /// replies: 1/N (one in N), every TIME, tag TAG, once. It returns what was wrong with the words; empty:
    /// it works from now on.
    std::string add(const std::vector<std::string>& words);
    static bool knows(const std::string& name);
    static std::vector<std::string> help();
    void clear() { faults_.clear(); }

    /// Returns what is sent in place of `reply`, in this order.
    std::vector<Departure> apply(Octets reply, Concerned concerned, Instant now);

private:
    enum class Kind : std::uint8_t {
        late,
        lose,
        spoil,   ///< a frame with a wrong checksum comes before the reply
        instead, ///< other octets in place of the reply
        noise    ///< octets right before the reply
    };
    struct Fault {
        Kind kind = Kind::late;
        std::chrono::nanoseconds least{0}, most{0};
        Octets octets;
        std::int64_t one_in = 1;
        std::optional<std::chrono::nanoseconds> every;
        std::optional<std::uint16_t> tag;
        bool once = false;
        std::int64_t count = 0; ///< replies that it could have met
        Instant due{};          ///< with `every`
        bool is_over = false;
    };
    static std::string choose(Fault& fault, const std::vector<std::string>& words, std::size_t at);
    bool meets(Fault& fault, Concerned concerned, Instant now);

    std::vector<Fault> faults_;
    std::minstd_rand random_{1};
};

} // namespace dpslave::sim
