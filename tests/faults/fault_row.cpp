// SPDX-License-Identifier: Apache-2.0
#include "fault_row.hpp"

#include "support/paths.hpp"

#include <algorithm>

namespace dpslave::test {
namespace {

/// The window of the replies: Gateway promises it to its masters unless a row says otherwise.
constexpr std::chrono::milliseconds kWindow{15};

/// The numbers behind `words` in the lines of a program.
std::vector<int> numbers_behind(const std::string& words, const Transcript& transcript)
{
    std::vector<int> numbers;
    for (const std::string& line : transcript.lines())
        if (const auto at = line.find(words); at != std::string::npos)
            numbers.push_back(std::stoi(line.substr(at + words.size())));
    return numbers;
}

} // namespace

Wiring wiring_of(const std::string& protocol)
{
    Wiring wiring;
    wiring.table = "tag,name,type,decimals,min,max,access,start\n"
                   "55,Speed,INT,0,,,ro,0\n"
                   "56,Setpoint,INT,0,,,rw,0\n"
                   "57,Ramp,INT,0,,,rw,0\n"
                   "58,Limit,INT,0,,,rw,0\n";
    wiring.output_refresh_s = "0.2";
    if (protocol != "modbus-rtu") return wiring;
    wiring.profile = "2408f";
    wiring.protocol = protocol;
    wiring.units = {"1"};
    wiring.keys = "ident = 0x0A0B\n";
    return wiring;
}

Arguments master_of(const std::string& protocol, Arguments more)
{
    Arguments arguments{"--tags", "55,56w,57w"};
    if (protocol == "modbus-rtu")
        arguments.insert(arguments.end(), {"--family", "controller", "--ident", "0x0A0B", "--master", "36"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

FaultRow::FaultRow() = default;

void FaultRow::master_leaves_the_bus()
{
    ASSERT_TRUE(master->does("stop"));
    ASSERT_TRUE(master->leaves());
    master.reset();
}

void FaultRow::installs(Wiring wiring)
{
    wiring.environment.emplace("LD_PRELOAD", built_path("tests/libreply_watch_library.so"));
    wiring.environment.emplace(reply_watch::kVariable, folder / "replies");
    const bool started = std::exchange(wiring.started, false);
    gateway.emplace(std::move(wiring));
    replies.watch(gateway->folder("bus-gateway"), kWindow);
    if (started) gateway->start_daemon();
}

void FaultRow::begins(Wiring wiring, const Arguments& settings)
{
    installs(std::move(wiring));
    exchanges(settings);
}

void FaultRow::exchanges(const Arguments& settings)
{
    settings_ = settings;
    master.emplace(*gateway, settings);
    ASSERT_TRUE(master->does("start 30s"));
    drive_shows(1);
    ASSERT_TRUE(master_sees(1));
    ASSERT_TRUE(master->does("follow on"));
    ASSERT_TRUE(master_wants(1));
    ASSERT_TRUE(drive_takes(1));
}

void FaultRow::TearDown()
{
    if (!gateway) return;
    if (master) master->end(SIGKILL); // nothing more comes
    EXPECT_EQ(replies.late(), 0U) << "replies written after their window; the slowest took "
                                  << replies.slowest().count() << " ns";
    EXPECT_GT(replies.replies(), 0U) << "or nothing was judged";
    EXPECT_EQ(gateway->counter("bus", "too_late"), 0U);
    EXPECT_TRUE(restarts || counts_what_it_missed());
}

/// What the bus thread publishes may be a moment old.
::testing::AssertionResult FaultRow::counts_what_it_missed() const
{
    std::string last;
    const auto result = eventually([&] {
        const auto of_bus = [&](const char* name) { return gateway->counter("bus", name); };
        const std::uint64_t heard = of_bus("requests") - gateway->counter("unwinder", "global_control");
        const std::uint64_t written = replies.replies() - of_bus("write_errors");
        const std::uint64_t missed = of_bus("late") + of_bus("overtaken") + of_bus("unsent");
        last = std::to_string(heard) + " requests, " + std::to_string(written) + " replies, " +
               std::to_string(missed) + " counted as missed";
        return heard == written + missed;
    });
    return result ? result : ::testing::AssertionFailure() << last;
}

void FaultRow::drive_shows(int value)
{
    gateway->drive().send_line("set 55 " + std::to_string(value));
}

::testing::AssertionResult FaultRow::master_stays_in_data_exchange()
{
    const auto result = master->does("expect state data-exchange");
    if (!result) return result;
    if (gateway->station().at("left_count") != 0)
        return ::testing::AssertionFailure() << "Data_Exch was left";
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult FaultRow::drive_takes(int value)
{
    return eventually([&] {
        const auto all = taken();
        return !all.empty() && all.back() == value;
    });
}

::testing::AssertionResult FaultRow::doctor_names(const std::string& rule, bool named) const
{
    std::string all;
    const auto result = eventually([&] {
        const Json findings = gateway->json({"doctor"}).at("findings");
        all = findings.dump();
        return named == std::any_of(findings.begin(), findings.end(),
                                    [&](const Json& one) { return one.at("rule") == rule; });
    });
    if (!result) return ::testing::AssertionFailure() << "the doctor says: " << all;
    return result;
}

::testing::AssertionResult FaultRow::status_says(const std::string& words) const
{
    std::string shown;
    const auto result = eventually([&] {
        shown = gateway->dpctl({"status"}).out;
        return shown.find(words) != std::string::npos;
    });
    if (!result) return ::testing::AssertionFailure() << "dpctl status says: " << shown;
    return result;
}

std::vector<int> FaultRow::taken(std::size_t from) const
{
    std::vector<int> all = numbers_behind("tag 56 written ", gateway->drive().transcript());
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(from, all.size())));
    return all;
}

std::vector<int> FaultRow::seen() const
{
    return numbers_behind("in 1 is ", master->transcript());
}

::testing::AssertionResult FaultRow::never_an_older_one(const std::vector<int>& values)
{
    const auto older = std::is_sorted_until(values.begin(), values.end());
    if (older == values.end()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << *older << " came after " << *std::prev(older);
}

} // namespace dpslave::test
