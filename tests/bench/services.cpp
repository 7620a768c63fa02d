// SPDX-License-Identifier: Apache-2.0
/// Answers one kind of request 10 000 times with layer 2 and slave alone, on simulated time, so that valgrind
/// counts the same instructions in each run. tools/run instructions calls it and compares the count.
#include "dp/bench.hpp"

#include "dpslave/dp/bus_members.hpp"

#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

using test::octets;
using test::Octets;
using test::Saps;

constexpr int kRequests = 10'000;
constexpr std::uint8_t kMaster = 2, kOther = 17;

struct Gateway {
    Gateway() { station.listen(&members); }

    dpslave::dp::BusMembers members;
    dpslave::dp::Personality personality = test::option_board();
    dpslave::fdl::Layer2 station{{.baud = dpslave::Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dpslave::dp::Slave slave{personality, test::kUs};
    dpslave::Instant now{std::chrono::seconds{1000}};
    std::size_t replies = 0;
};

} // namespace

/// One telegram from its last octet to the reply, as the bus thread does it. Not inlined, with C linkage:
/// valgrind counts in here alone (--toggle-collect).
extern "C" [[gnu::noinline]] void answer_one_request(Gateway& gateway, dpslave::Bytes telegram)
{
    gateway.station.on_bytes(telegram, gateway.now);
    gateway.station.on_time(gateway.now);
    gateway.now += dpslave::duration_of(gateway.slave.min_tsdr(), gateway.station.baud());
    gateway.station.on_time(gateway.now);
    if (gateway.station.take_transmit()) ++gateway.replies;
    (void)gateway.slave.take_outputs();
    (void)gateway.slave.take_demand_order();
}

namespace {

void ask(Gateway& gateway, const Octets& telegram)
{
    gateway.now += std::chrono::milliseconds{1};
    answer_one_request(gateway, dpslave::Bytes{telegram});
}

/// Set_Prm and Chk_Cfg: 8 octets out, 32 in (Demand Data and 12 inputs), without watchdog.
void start_up(Gateway& gateway)
{
    gateway.slave.start(gateway.now);
    gateway.station.attach(test::kUs, gateway.slave, gateway.personality.max_tsdr);
    const std::string prm = test::board_prm({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "80 00 00 0B 05 33 00");
    ask(gateway, test::sd2(test::kUs, kMaster, 0x6D, Saps{60, 62}, octets("")));
    ask(gateway, test::sd2(test::kUs, kMaster, 0x5D, Saps{61, 62}, octets(prm)));
    ask(gateway,
        test::sd2(test::kUs, kMaster, 0x7D, Saps{62, 62}, octets("73 50 50 50 50 50 50 50 50 50 50 50 50")));
    ask(gateway, test::sd2(test::kUs, kMaster, 0x5D, Saps{60, 62}, octets("")));
}

/// The two telegrams of a kind, which differ in the frame count bit, and how many of 10 000 are answered.
struct Kind {
    Octets telegrams[2];
    std::size_t replies;
};

std::map<std::string_view, Kind> kinds()
{
    const Octets outputs = octets("10 37 00 00 00 00 00 00");
    const auto exchange = [&](std::uint8_t to, std::uint8_t fc) {
        return test::sd2(to, kMaster, fc, outputs);
    };
    const auto diagnosis = [](std::uint8_t fc) {
        return test::sd2(test::kUs, kMaster, fc, Saps{60, 62}, octets(""));
    };
    return {{"Data_Exchange", {{exchange(test::kUs, 0x7D), exchange(test::kUs, 0x5D)}, kRequests}},
            {"Slave_Diag", {{diagnosis(0x7D), diagnosis(0x5D)}, kRequests}},
            {"Data_Exchange_of_another_station", {{exchange(kOther, 0x7D), exchange(kOther, 0x5D)}, 0}}};
}

} // namespace

int main(int count, char** words)
{
    const auto all = kinds();
    const auto kind = count == 2 ? all.find(words[1]) : all.end();
    if (kind == all.end()) {
        for (const auto& [name, telegrams] : all)
            std::printf("%.*s\n", static_cast<int>(name.size()), name.data());
        return count == 1 ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    Gateway gateway;
    start_up(gateway);
    if (gateway.slave.state() != dpslave::dp::State::data_exch || gateway.replies != 4) {
        std::fputs("bench_services: the slave did not reach Data_Exch\n", stderr);
        return EXIT_FAILURE;
    }
    gateway.replies = 0;
    for (int i = 0; i < kRequests; ++i) ask(gateway, kind->second.telegrams[i % 2]);
    if (gateway.replies != kind->second.replies) {
        std::fprintf(stderr, "bench_services: %zu replies to %d requests, not %zu\n", gateway.replies,
                     kRequests, kind->second.replies);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
