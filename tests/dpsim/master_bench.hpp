// SPDX-License-Identifier: Apache-2.0
/// A master on a simulated clock, and the slave is what the test writes.
#pragma once

#include "dpsim/master/master.hpp"
#include "octets.hpp"

#include <gtest/gtest.h>

namespace dpslave::sim {

/// The settings of wire reference 4.2: slave 5, master 2, ident 4711h, 2 octets in and out, watchdog 200 ms.
inline MasterSettings reference_settings()
{
    MasterSettings s;
    s.ident = 0x4711;
    s.user_prm.clear();
    s.cfg = {0x11, 0x21};
    s.watchdog = std::chrono::milliseconds{200};
    s.sync = s.freeze = false;
    return s;
}

class MasterBench : public testing::Test {
protected:
    explicit MasterBench(MasterSettings settings = reference_settings()) : master(std::move(settings)) {}

    /// The next telegram, with time going on as far as the master wants (at most 2 s).
    std::optional<Octets> next()
    {
        const Instant end = now + std::chrono::seconds{2};
        while (true) {
            master.on_time(now);
            collect();
            if (auto telegram = master.take_transmit(now)) {
                sent_at = now;
                return telegram;
            }
            const Instant deadline = master.next_deadline();
            if (deadline > end) return std::nullopt;
            if (deadline > now) now = deadline;
        }
    }
    /// The master says `request`; 1 ms later `reply` is heard (empty: nothing).
    void expect(const std::string& request, const std::string& reply)
    {
        const auto telegram = next();
        ASSERT_TRUE(telegram) << "instead of " << request;
        EXPECT_EQ(hex(*telegram), request);
        now += std::chrono::milliseconds{1};
        if (!reply.empty()) master.on_bytes(wire(reply), now);
        collect();
    }
    void idle_out()
    {
        now = std::max(now, master.next_deadline());
        master.on_time(now);
        collect();
    }
    void to_set_prm()
    {
        master.start();
        expect("10 05 02 49 50 16", "10 02 05 00 07 16");
        expect("68 05 05 68 85 82 6D 3C 3E EE 16", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
    }
    /// In data exchange, one cycle done; the next request carries frame count bit 1.
    void exchanging()
    {
        to_set_prm();
        expect("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "E5");
        expect("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "E5");
        expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16");
        expect("68 05 05 68 85 82 7D 3C 3E FE 16", "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16");
        expect("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16", "");
        expect("68 05 05 68 05 02 5D 00 00 64 16", "68 05 05 68 02 05 08 12 34 55 16");
    }

    std::string all_of(MasterEvent::Kind kind)
    {
        collect();
        std::string text;
        for (const MasterEvent& event : events)
            if (event.kind == kind) text += event.words;
        return text;
    }
    std::string violations() { return all_of(MasterEvent::Kind::violation); }
    std::string refusal() { return all_of(MasterEvent::Kind::refused); }
    std::string losses() { return all_of(MasterEvent::Kind::lost); }
    std::string answer_words() { return all_of(MasterEvent::Kind::answer); }

    void collect()
    {
        while (auto event = master.take_event()) events.push_back(*event);
    }

    Instant now{std::chrono::seconds{1}};
    Instant sent_at{};
    Master master;
    std::vector<MasterEvent> events;
};

} // namespace dpslave::sim
