// SPDX-License-Identifier: Apache-2.0
/// A bus thread on one end of a pty, and a master written by hand on the other. What is waited for is waited
/// for with a bound, never for a fixed time.
#pragma once

#include "app/bus/bus_thread.hpp"
#include "config/config_bench.hpp"
#include "io/pty.hpp"
#include "stand_in_uart.hpp"
#include "support/allocations.hpp"
#include "support/eventually.hpp"
#include "support/wire.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <thread>

namespace dpslave::test {

using ::test::Octets;

inline constexpr std::uint8_t kStation = 5; ///< the address of the station on this bus

/// The octets of one telegram, from the wire; each of them once. Sends everything back where it is to echo.
class Master {
public:
    explicit Master(io::Pty& pty) : pty_(pty) {}
    bool echoes = false; ///< the transceiver at the other end hears what it sends

    /// Repeats the request unchanged until it is answered, as a master does: for a minute, unless the test
    /// says how often.
    std::optional<Octets> ask(const Octets& request, int tries = 200)
    {
        for (int i = 0; i < tries; ++i) {
            pty_.received(); // what came too late
            pty_.send(request);
            if (auto reply = read_telegram(std::chrono::milliseconds{300})) return reply;
        }
        return std::nullopt;
    }
    /// FC of the next request that counts: 6D begins a sequence, then 5D and 7D in turn.
    std::uint8_t next_fc()
    {
        const std::uint8_t fc = fc_;
        fc_ = fc == 0x5D ? 0x7D : 0x5D;
        return fc;
    }

private:
    static std::size_t length_of(const Octets& head)
    {
        if (head.empty()) return 0;
        if (head[0] == 0xE5) return 1;
        if (head[0] == 0x10) return 6;
        return head.size() < 2 ? 0 : head[1] + std::size_t{6};
    }
    std::optional<Octets> read_telegram(std::chrono::nanoseconds within)
    {
        Octets all;
        const Instant limit = io::monotonic_now() + within;
        while (io::monotonic_now() < limit) {
            pollfd waiting{.fd = pty_.fd(), .events = POLLIN, .revents = 0};
            if (::poll(&waiting, 1, 1) <= 0) continue;
            const Octets more = pty_.received();
            if (echoes && !more.empty()) pty_.send(more);
            all.insert(all.end(), more.begin(), more.end());
            if (const std::size_t length = length_of(all); length != 0 && all.size() >= length) return all;
        }
        return std::nullopt;
    }

    io::Pty& pty_;
    std::uint8_t fc_ = 0x6D;
};

// Telegrams of master 2 to `station`, which reads twelve parameters behind Demand Data (profile 590).
inline constexpr std::size_t kInputs = 12;
inline Octets fdl_status(std::uint8_t station)
{
    return ::test::sd1(station, 2, 0x49);
}
inline Octets set_prm(std::uint8_t station, std::uint8_t fc)
{
    Octets data{0x80, 0, 0, 11, 0x05, 0x33, 0x00}; // locked, watchdog off
    for (std::uint8_t tag = 1; tag <= kInputs; ++tag) data.insert(data.end(), {0x00, tag});
    return ::test::sd2(station, 2, fc, ::test::Saps{61, 62}, data);
}
inline Octets chk_cfg(std::uint8_t station, std::uint8_t fc)
{
    Octets data(1 + kInputs, 0x50);
    data.front() = 0x73;
    return ::test::sd2(station, 2, fc, ::test::Saps{62, 62}, data);
}
inline Octets data_exchange(std::uint8_t station, std::uint8_t fc)
{
    return ::test::sd2(station, 2, fc, Octets(8, 0x00));
}

class OnABus : public ConfigFile {
protected:
    struct Options {
        std::optional<Baud> baud = Baud::k500;
        io::Direction direction = io::Direction::rts;
        EchoMode echo = EchoMode::off;
        bool listen = false;
    };

    OnABus() : master(pty)
    {
        uart::reset();
        spdlog::set_level(spdlog::level::warn);
    }
    ~OnABus() override { stop(); }

    /// Sends the request until the bus thread has come to `condition`: one that stood still drops a request
    /// whose window is over.
    template <class Condition>
    bool asked_until(const Octets& request, Condition condition)
    {
        return eventually([&] {
            if (condition()) return true;
            master.ask(request, 1);
            return condition();
        });
    }

    /// A station that promises nothing hasty: the machine may be busy.
    std::shared_ptr<app::BusStation> station(std::uint8_t address)
    {
        links[address] = std::make_shared<app::StationLink>();
        return std::make_shared<app::BusStation>(station_config(address), links[address]);
    }
    config::StationConfig station_config(std::uint8_t address)
    {
        if (!config_) config_ = good(kGood);
        config::StationConfig one = config_->stations.front();
        one.address = address;
        auto patient = std::make_shared<dp::Personality>(*one.personality);
        patient->max_tsdr.fill(Tbit{1023});
        one.personality = patient;
        return one;
    }

    void start(const Options& options, app::BusStations stations)
    {
        config::Config config;
        config.bus.baud = options.baud;
        config.bus.echo = options.echo;
        config.bus.listen = options.listen;
        config.bus.driver_enable.direction = options.direction;
        config.bus.port = port_path();
        driver_.emplace(config.bus.driver_enable);
        opener_.emplace(config, *driver_, link, std::chrono::milliseconds{1});
        opener_->start();
        ASSERT_TRUE(opener_->await_first_try(std::chrono::minutes{1}));
        when_opened();
        bus_ = std::make_unique<app::BusThread>(
            config.bus, *opener_, *driver_, std::make_unique<app::BusStations>(std::move(stations)), link);
        thread_ = std::jthread([this](const std::stop_token& stop) {
            is_realtime = io::enter_realtime(50, -1).empty();
            tid = ::gettid();
            const CountAllocations counted;
            bus_->run(stop, wake_);
        });
        ASSERT_TRUE(eventually([this] { return snapshot().valid; }));
    }
    void stop()
    {
        if (!thread_.joinable()) return;
        thread_.request_stop();
        wake_.ring();
        thread_.join();
        ASSERT_TRUE(opener_->end(std::chrono::minutes{1}));
        bus_.reset();
    }

    /// The way to Data_Exch; the test plays the drive as well.
    void start_up(std::uint8_t address)
    {
        ASSERT_EQ(master.ask(set_prm(address, master.next_fc())), Octets{0xE5});
        ASSERT_EQ(master.ask(chk_cfg(address, master.next_fc())), Octets{0xE5});
        ASSERT_TRUE(eventually([&] { return links[address]->outputs.latest().layout.generation != 0; }));
        inputs_.generation = links[address]->outputs.latest().layout.generation;
        inputs_.every_input_tried = true;
        links[address]->inputs.publish(inputs_);
    }
    /// The first input word in the reply; nothing: there was none, or another reply than to Data_Exchange.
    std::optional<std::uint16_t> exchange(std::uint8_t address)
    {
        const auto reply = master.ask(data_exchange(address, master.next_fc()));
        const auto heard = reply ? ::test::heard(*reply) : std::nullopt;
        if (!heard || heard->sa != address || heard->da != 2 || heard->data.size() != 8 + 2 * kInputs)
            return std::nullopt;
        return be16(heard->data, 8);
    }
    void drive_reads(std::uint8_t address, std::uint16_t value)
    {
        inputs_.words.fill(value);
        links[address]->inputs.publish(inputs_);
    }

    const app::BusSnapshot& snapshot() { return link.snapshot.latest(); }
    bool reports(app::PortEvent wanted)
    {
        return eventually([&] {
            const auto news = link.port_events.pop();
            return news == wanted;
        });
    }
    /// Why the port stays closed; empty = the bus thread did not say it.
    std::string hears_trouble()
    {
        std::unique_ptr<app::PortMessage> words;
        const bool is_said = eventually([&] { return link.port_messages.take(words); });
        return is_said && !words->is_warning ? words->text : "";
    }
    /// What was recorded and is still there, oldest first.
    std::vector<trace::Record> records() const
    {
        std::vector<trace::Record> all;
        trace::Ring::Reader reader{link.trace};
        for (trace::Record one; reader.next(one);) all.push_back(one);
        return all;
    }
    virtual std::string port_path() { return pty.path(); }
    /// The port is open, and the bus thread does not run yet.
    virtual void when_opened() {}

    io::Pty pty;
    Master master;
    app::BusLink link{std::size_t{1} << 20}; ///< it records, as a daemon does
    std::map<std::uint8_t, std::shared_ptr<app::StationLink>> links;
    std::atomic<bool> is_realtime{false};
    std::atomic<int> tid{0}; ///< of the bus thread

private:
    std::optional<config::Config> config_;
    std::optional<io::DriverEnable> driver_;
    std::optional<app::BusPortOpener> opener_;
    std::unique_ptr<app::BusThread> bus_;
    io::EventFd wake_;
    InputImage inputs_{};
    std::jthread thread_;
};

} // namespace dpslave::test
