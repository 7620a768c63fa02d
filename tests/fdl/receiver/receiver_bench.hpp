// SPDX-License-Identifier: Apache-2.0
/// What the tests of the receiver share: octets in, telegrams and flaws out.
#pragma once

#include "fdl/bench.hpp"

#include "dpslave/fdl/receiver.hpp"

namespace test {

class Receiver : public testing::Test {
protected:
    void reads(const Octets& octets, bool more_follows = false)
    {
        receiver.begin_read(octets.size(), now);
        kept = octets;
        receiver.on_bytes(kept, more_follows);
    }
    void hears_a_bad_character()
    {
        receiver.begin_read(1, now);
        receiver.on_character_error();
    }
    /// "7D" for a telegram with this FC, "!" for one behind which nothing was heard, else the flaw.
    std::string next()
    {
        const auto* heard = receiver.next();
        if (heard == nullptr) return "-";
        if (!heard->telegram) return std::string{text(heard->telegram.error())};
        return show({heard->telegram->fc}) + (heard->newest ? "!" : "");
    }
    /// "17..23 7D": where the next one lies among all characters heard; of a flaw only where it begins.
    std::string next_with_its_place()
    {
        const auto* heard = receiver.next();
        if (heard == nullptr) return "-";
        const std::string begin = std::to_string(heard->begin);
        if (!heard->telegram) return begin + " " + std::string{text(heard->telegram.error())};
        return begin + ".." + std::to_string(heard->end) + " " + show({heard->telegram->fc});
    }

    dpslave::Instant now{std::chrono::seconds{3}};
    Octets kept;
    dpslave::fdl::Receiver receiver{dpslave::Baud::k187_5};
    const Octets first = sd2(kUs, kMaster, kSrdFcb0, {1, 2});
    const Octets second = sd1(kOther, kMaster, kFdlStatus);
};

} // namespace test
