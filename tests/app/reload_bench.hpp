// SPDX-License-Identifier: Apache-2.0
/// A reload with all that it needs. The thread beside the main thread is real, the clock of the main thread
/// is the test's, and so are the bus thread and the lines.
#pragma once

#include "app/reload/reload.hpp"
#include "config/config_bench.hpp"
#include "control/interface.hpp"
#include "support/eventually.hpp"

#include "dpslave/control/client.hpp"
#include "dpslave/io/clock.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <map>
#include <set>

namespace dpslave::app::test_reload {

using namespace std::chrono_literals;
using control::Json;
using test::eventually;
using test::kGood;

/// What blocks until the test opens it.
class Gate {
public:
    void pass()
    {
        ++asked;
        is_open_.wait(false);
    }
    void open()
    {
        is_open_ = true;
        is_open_.notify_all();
    }
    void close() { is_open_ = false; }
    std::atomic<int> asked{0};

private:
    std::atomic<bool> is_open_{true};
};

struct Gates {
    Gate disk, names, ports, links;
};

class ReloadBench : public test::ConfigFile {
protected:
    ReloadBench()
    {
        plant.open(present);
        control::ServerSettings settings;
        settings.socket = folder_.path() / "control.sock";
        control::Methods methods;
        const auto interface = control::parse_interface(control::interface_text());
        for (const auto& [name, type] : interface->methods)
            methods[name].answer = [](const Json&, const control::Caller&) { return control::Done{}; };
        methods["Reload"].answer = [this](const Json& parameters, const control::Caller& caller) {
            return reload.request(parameters.value("dry_run", false), caller);
        };
        auto opened = control::Server::open(std::move(settings), std::move(methods));
        if (!opened) throw std::runtime_error{opened.error()};
        server.emplace(*std::move(opened));
    }
    ~ReloadBench() override
    {
        for (Gate* const gate : {&gates->disk, &gates->names, &gates->ports, &gates->links}) gate->open();
        EXPECT_TRUE(file.settle(1min));
    }

    /// The main thread goes round once.
    void go_round()
    {
        file.on_time(now);
        reload.advance(now);
        std::unique_ptr<BusStations> taken;
        bus.stations.take(taken); // the bus thread is the test's
        for (const auto& line : plant.lines()) line_goes_round(*line);
        server->on_ready();
    }
    /// A line that does not stall takes what is new for it, and has done it at once.
    void line_goes_round(DriveLine& line)
    {
        if (stalled.contains(line.config.port)) return;
        line.link.sign->give(now);
        if (line.link.change.take(changes[&line])) ++line.link.changes_done;
    }
    control::Client call(bool dry_run = false)
    {
        auto client = control::Client::connect(folder_.path() / "control.sock", 60s);
        if (!client) throw std::runtime_error{client.error().text};
        client->start_one("Reload", {{"dry_run", dry_run}});
        return *std::move(client);
    }
    /// Goes round until the call is answered.
    Json answer_to(control::Client& client)
    {
        auto reply = std::async(std::launch::async, [&client] { return client.next(); });
        EXPECT_TRUE(goes_round_until([&] { return reply.wait_for(0s) == std::future_status::ready; }));
        const auto got = reply.get();
        return got && *got ? (*got)->parameters : Json::object();
    }
    template <class Condition>
    bool goes_round_until(Condition condition)
    {
        return eventually([&] {
            go_round();
            return condition();
        });
    }
    /// The file from now on: the output of the station is refreshed less often.
    void change_file()
    {
        folder_.write("etc/dpslaved.toml", std::string{kGood} + "output_refresh_s = 2.0\n");
    }
    bool is_changed() const { return monitor.config().stations.front().output_refresh == 2s; }

    config::Config present = good(kGood);
    BusLink bus;
    Plant plant{bus, true};
    Monitor monitor{present, plant.stations(), bus};
    Lamps lamps;
    io::Notifier notifier;
    RecentEvents events;
    Happenings happenings{events, [](const Happening&, Instant) {}};
    std::shared_ptr<Gates> gates = std::make_shared<Gates>();
    Instant now = io::monotonic_now();
    static std::shared_ptr<const ConfigSources> sources(const std::shared_ptr<Gates>& gates)
    {
        auto all = std::make_shared<ConfigSources>();
        all->load = [gates](const auto& path, const auto& profiles) {
            gates->disk.pass();
            return config::load_config(path, profiles);
        };
        all->group = [gates](const auto&) -> std::optional<gid_t> {
            gates->names.pass();
            return 0;
        };
        all->port_trouble = [gates](const auto&) -> std::optional<std::string> {
            gates->ports.pass();
            return std::nullopt;
        };
        all->canonical = [gates](const std::string& path) {
            gates->links.pass();
            return path == "/dev/serial/by-id/p3" ? std::string{"/dev/null-p3"} : path;
        };
        return all;
    }

    app::ConfigFile file{present, folder_.path() / "profiles", now, sources(gates)};
    std::set<std::string> stalled;                                   ///< lines, by their ports
    std::map<const DriveLine*, std::unique_ptr<LineChange>> changes; ///< what each has taken last
    int applied = 0;
    Reload reload{{file, monitor, plant, bus, lamps, notifier, happenings,
                   [this](const std::vector<Station>&, std::optional<gid_t>) { ++applied; }}};
    std::optional<control::Server> server;
};

} // namespace dpslave::app::test_reload
