// SPDX-License-Identifier: Apache-2.0
/// M7: Demand Data the whole way, from a request telegram of the master to the first reply that carries the
/// answer: layer 2 and slave, poller and client, a drive on its line.
#include "dp/bench.hpp"
#include "drive_side.hpp"
#include "simulated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using ::test::octets;
using ::test::Octets;

constexpr nanoseconds kBusCycle = 1ms;
const Octets kNothing = octets("00 00 00 00 00 00 00 00");
const Octets kRead{0x10, kDemandTag, 0, 0, 0, 0, 0, 0};

/// Layer 2 and slave at 1.5 Mbit/s: an option board with Demand Data and the twelve parameters.
class BusSide {
public:
    explicit BusSide(Instant now)
    {
        slave_.start(now);
        layer2_.attach(::test::kUs, slave_, personality_.max_tsdr);
        std::vector<std::uint16_t> tags;
        std::string identifiers = "73";
        for (std::uint16_t tag = 1; tag <= kParameters; ++tag) {
            identifiers += is_written(tags.size()) ? " 60" : " 50";
            tags.push_back(tag);
        }
        const auto sends = [&](std::uint8_t fc, std::uint8_t sap, const std::string& data) {
            ask(::test::sd2(::test::kUs, kMaster, fc, ::test::Saps{sap, 62}, octets(data)), now);
        };
        sends(0x6D, 60, "");
        sends(0x5D, 61, ::test::board_prm(tags, "80 00 00 0B 05 33 00"));
        sends(0x7D, 62, identifiers);
        sends(0x5D, 60, "");
        if (slave_.state() != dp::State::data_exch) throw std::runtime_error{"the slave does not start up"};
    }

    dp::Slave& slave() { return slave_; }

    /// Data_Exchange with this Demand Data and all outputs at kWord: the Demand Data of the reply.
    Octets exchange(const Octets& demand, Instant at)
    {
        Octets data = demand;
        for (std::size_t i = 0; i < kParameters; ++i)
            if (is_written(i)) data.insert(data.end(), {high(kWord), low(kWord)});
        frame_count_bit_ ^= 0x20;
        const auto fc = static_cast<std::uint8_t>(0x5D ^ frame_count_bit_);
        const Octets reply = ask(::test::sd2(::test::kUs, kMaster, fc, data), at);
        constexpr std::size_t kHead = 7, kDemand = 8;
        if (reply.size() < kHead + kDemand) throw std::runtime_error{"Data_Exchange is not answered"};
        return {reply.begin() + kHead, reply.begin() + kHead + kDemand};
    }

private:
    static constexpr std::uint8_t kMaster = 2;

    /// A request that is heard at this moment, and its reply; empty: there is none.
    Octets ask(const Octets& telegram, Instant at)
    {
        layer2_.on_bytes(Bytes{telegram}, at);
        layer2_.on_time(at);
        layer2_.on_time(at + duration_of(slave_.min_tsdr(), layer2_.baud()));
        const auto reply = layer2_.take_transmit();
        return reply ? Octets(reply->begin(), reply->end()) : Octets{};
    }

    dp::Personality personality_ = ::test::option_board();
    fdl::Layer2 layer2_{{.baud = Baud::k1500, .search = {}, .start_up_latency = {}}};
    dp::Slave slave_{personality_, ::test::kUs};
    std::uint8_t frame_count_bit_ = 0;
};

/// Both sides. The master exchanges data once in a bus cycle; the drive line is under full refresh.
class WholeWay {
public:
    Instant now() const { return now_; } ///< of the last bus cycle
    /// From now on the drive has this word in the tag of Demand Data. The answer that carries it.
    Octets drive_holds(std::uint16_t word)
    {
        drive_.drive.parameters[mnemonic_of(kDemandTag)].text = fmt::format("{:05.2f}", word / 100.0);
        return {0x10, kDemandTag, 0, 0, 0, 0, high(word), low(word)};
    }
    nanoseconds round() const { return drive_side_.cycle(); }
    nanoseconds longest() const { return longest_; } ///< transaction of the refresh, before any order

    /// One bus cycle with this Demand Data: that of the reply. Behind the first order no transaction counts
    /// for longest().
    Octets bus_cycle(const Octets& demand)
    {
        now_ += kBusCycle;
        const Instant& line = drive_.line.time;
        while (line < now_) {
            hand_up();
            const nanoseconds took = drive_side_.step(now_);
            if (!ordered_) longest_ = std::max(longest_, took);
        }
        if (line == now_) hand_up(); // else a transaction is under way: what it brings is not there yet
        Octets reply = bus_.exchange(demand, now_);
        hand_down();
        return reply;
    }

private:
    void hand_up()
    {
        drive::Poller& poller = drive_side_.poller();
        if (const auto inputs = poller.take_inputs(0)) bus_.slave().set_inputs(*inputs);
        while (const auto answer = poller.take_demand_answer(0)) bus_.slave().set_demand_answer(*answer);
    }
    void hand_down()
    {
        drive::Poller& poller = drive_side_.poller();
        if (const auto outputs = bus_.slave().take_outputs()) poller.set_outputs(0, *outputs);
        while (const auto order = bus_.slave().take_demand_order()) {
            poller.set_demand(0, *order);
            ordered_ = true;
        }
    }

    EiAsciiDrive drive_{38'400};
    DriveSide drive_side_{drive_.client, drive_.line.time, false};
    BusSide bus_{drive_.line.time};
    Instant now_ = drive_.line.time;
    nanoseconds longest_{};
    bool ordered_ = false;
};

} // namespace

/// One order in each round at most, each at any moment: more than that is for the rounds behind it.
Row measure_demand_data(bool quick)
{
    const std::size_t orders = quick ? 20 : 500;
    WholeWay way;
    while (way.round() == 0ns) way.bus_cycle(kNothing);
    const std::int64_t round = way.round() / kBusCycle + 1;
    std::mt19937_64 random{1};
    std::uniform_int_distribution<std::int64_t> wait{round, 2 * round};
    Row row{.id = "M7",
            .metric = "Demand Data read, p99 from request to its answer / longest transaction",
            .limit = 2.2};
    std::uint32_t number = 0;
    for (std::size_t block = 0; block < (quick ? 1 : kBlocks); ++block) {
        std::vector<double> took;
        while (took.size() < orders) {
            for (std::int64_t cycles = wait(random); cycles > 0; --cycles) way.bus_cycle(kNothing);
            const Octets answer = way.drive_holds(static_cast<std::uint16_t>(1000 + number++ % 8999));
            if (way.bus_cycle(kRead) == answer) throw std::runtime_error{"an answer before the order"};
            const Instant asked = way.now();
            while (way.bus_cycle(kRead) != answer)
                if (way.now() - asked > 1s) throw std::runtime_error{"an order is not answered"};
            took.push_back(static_cast<double>((way.now() - asked - kBusCycle).count()) /
                           static_cast<double>(way.longest().count()));
        }
        std::sort(took.begin(), took.end());
        row.blocks.push_back(took[took.size() * 99 / 100]);
    }
    return row;
}

} // namespace dpslave::bench
