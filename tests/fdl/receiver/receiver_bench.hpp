// SPDX-License-Identifier: Apache-2.0
/// The tests of the receiver use this: octets in, telegrams and flaws out.
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

/// A telegram with a silence in it.
class SilenceInATelegram : public Receiver {
protected:
    /// So long, T_SYN if not said otherwise, and the time of so many octets.
    void falls_silent_before(std::size_t octets, std::uint32_t bits = 33)
    {
        now += dpslave::duration_of(dpslave::Tbit{static_cast<std::uint32_t>(bits + 11 * octets)},
                                    dpslave::Baud::k187_5);
    }
    void reads_behind_silence(const Octets& octets)
    {
        falls_silent_before(octets.size());
        reads(octets);
    }
    /// Without a pause on the line.
    void goes_on(const Octets& octets)
    {
        now += dpslave::duration_of(dpslave::Tbit{static_cast<std::uint32_t>(11 * octets.size())},
                                    dpslave::Baud::k187_5);
        reads(octets);
    }
    bool stays_silent(std::uint32_t bits)
    {
        now += dpslave::duration_of(dpslave::Tbit{bits}, dpslave::Baud::k187_5);
        return receiver.on_time(now);
    }

    const Octets behind = octets("10 09 02 49 54 16"); ///< FDL_Status to 9
    /// Eight octets say that they are a request to 5; with `behind` they are 14 with a right checksum:
    /// 05 + 02 + 5D + 8C = F0, and 10 more are 00.
    const Octets stump = octets("68 08 08 68 05 02 5D 8C");
    /// A request to 5 whose last octets begin like a telegram of six: 05 + 02 + 5D + 01 + 10 + 09 = 7E.
    const Octets begun = octets("68 06 06 68 05 02 5D 01");
    const Octets rest = octets("10 09 7E 16");
};

} // namespace test
