// SPDX-License-Identifier: Apache-2.0
/// A reload whose disk or name service hangs. The thread beside the main thread is real, the clock of the
/// main thread is the test's.
#include "app/reload/reload.hpp"
#include "config/config_bench.hpp"
#include "control/interface.hpp"
#include "support/eventually.hpp"

#include "dpslave/control/client.hpp"
#include "dpslave/io/clock.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <future>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using control::Json;
using test::eventually;
using test::kGood;
using testing::AllOf;
using testing::HasSubstr;

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

class ReloadBeside : public test::ConfigFile {
protected:
    ReloadBeside()
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
    ~ReloadBeside() override
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
        server->on_ready();
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
    int applied = 0;
    Reload reload{{file, monitor, plant, bus, lamps, notifier, happenings,
                   [this](const std::vector<Station>&, std::optional<gid_t>) { ++applied; }}};
    std::optional<control::Server> server;
};

TEST_F(ReloadBeside, AsksForTheGroupOnceAndIsAnswered)
{
    change_file();
    auto caller = call();

    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), true) << reply;
    EXPECT_TRUE(is_changed());
    EXPECT_EQ(applied, 1);
    EXPECT_EQ(gates->names.asked, 1);
}

TEST_F(ReloadBeside, WhoseDiskHangsIsRefusedInItsTimeAndNotDoneLater)
{
    change_file();
    gates->disk.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->disk.asked == 1; }));

    now += Reload::kLongestReading + 1ms;
    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), false);
    EXPECT_THAT(reply.at("faults").at(0).get<std::string>(),
                AllOf(HasSubstr("the disk with " + file.path().string()), HasSubstr("nothing was changed")));
    EXPECT_TRUE(reload.is_idle());
    gates->disk.open();
    EXPECT_TRUE(file.settle(1min));
    EXPECT_FALSE(is_changed());
    auto next = call();
    EXPECT_EQ(answer_to(next).at("applied"), true);
    EXPECT_TRUE(is_changed());
}

TEST_F(ReloadBeside, WhoseNameServiceHangsSaysSo)
{
    change_file();
    gates->names.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->names.asked == 1; }));

    now += Reload::kLongestReading + 1ms;

    EXPECT_THAT(answer_to(caller).at("faults").at(0).get<std::string>(),
                HasSubstr("the name service, asked for the group \"root\", has not answered for 4 s"));
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, BySignalThatHangsIsTold)
{
    gates->ports.close();
    reload.request();
    ASSERT_TRUE(goes_round_until([&] { return gates->ports.asked == 1; }));

    now += Reload::kLongestReading + 1ms;
    go_round();

    EXPECT_TRUE(reload.is_idle());
    EXPECT_THAT(events.events().back().text, HasSubstr("the ports of the lines has not answered"));
}

TEST_F(ReloadBeside, WhoseLinkOfAPortHangsKeepsTheMainThreadNotAndChangesNothing)
{
    change_file();
    gates->links.close();
    auto caller = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->links.asked == 1; }));

    now += Reload::kLongestReading + 1ms;

    EXPECT_THAT(answer_to(caller).at("faults").at(0).get<std::string>(),
                HasSubstr("the ports of the lines has not answered"));
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, ToAnotherNameOfTheSamePortLeavesNoDrive)
{
    folder_.write("etc/dpslaved.toml", std::string{kGood}.replace(std::string{kGood}.find("/dev/null-p3"), 12,
                                                                  "/dev/serial/by-id/p3"));
    auto caller = call();
    ASSERT_EQ(answer_to(caller).at("applied"), true);

    std::unique_ptr<LineChange> change;
    ASSERT_TRUE(plant.lines().front()->link.change.take(change));
    EXPECT_TRUE(change->opens_port);
    EXPECT_TRUE(change->is_held) << "the line itself has it still";
    EXPECT_FALSE(change->is_other_port);
    EXPECT_FALSE(change->leaves_drives);
}

TEST_F(ReloadBeside, ToAnotherPortLeavesTheDrivesOfTheOldOne)
{
    folder_.write("etc/dpslaved.toml",
                  std::string{kGood}.replace(std::string{kGood}.find("/dev/null-p3"), 12, "/dev/null-p4"));
    auto caller = call();
    ASSERT_EQ(answer_to(caller).at("applied"), true);

    std::unique_ptr<LineChange> change;
    ASSERT_TRUE(plant.lines().front()->link.change.take(change));
    EXPECT_FALSE(change->is_held);
    EXPECT_TRUE(change->is_other_port);
    EXPECT_TRUE(change->leaves_drives);
}

TEST_F(ReloadBeside, ThatComesWhileOneHangsIsAnsweredWithItAndSoIsADryRun)
{
    gates->disk.close();
    auto first = call();
    ASSERT_TRUE(goes_round_until([&] { return gates->disk.asked == 1; }));
    auto second = call();
    auto trial = call(true);
    ASSERT_TRUE(goes_round_until([&] { return server->counters().calls == 3; }));
    EXPECT_FALSE(reload.is_idle());

    now += Reload::kLongestReading + 1ms;

    for (control::Client* const caller : {&first, &second, &trial})
        EXPECT_THAT(answer_to(*caller).at("faults").at(0).get<std::string>(), HasSubstr("has not answered"));
    EXPECT_EQ(gates->disk.asked, 1);
}

TEST_F(ReloadBeside, AsADryRunChangesNothing)
{
    change_file();
    auto caller = call(true);

    const Json reply = answer_to(caller);

    EXPECT_EQ(reply.at("applied"), false);
    EXPECT_EQ(reply.at("faults"), Json::array());
    EXPECT_EQ(reply.at("changes").size(), 1U) << reply;
    EXPECT_FALSE(is_changed());
}

TEST_F(ReloadBeside, LooksOnceASecondWhetherTheFileHasChanged)
{
    folder_.write("etc/dpslaved.toml",
                  std::string{kGood}.replace(std::string{kGood}.find("address = 5"), 11, "address = 9"));
    EXPECT_EQ(file.address_of("unwinder"), 5);

    now += 1s;

    EXPECT_TRUE(goes_round_until([&] { return file.address_of("unwinder") == 9; }));
    EXPECT_EQ(gates->disk.asked, 1);
    now += 1s;
    go_round();
    EXPECT_TRUE(file.settle(1min));
    EXPECT_EQ(gates->disk.asked, 1) << "read once";
}

} // namespace
} // namespace dpslave::app
