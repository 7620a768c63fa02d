// SPDX-License-Identifier: Apache-2.0
// Each case for each family, on the simulated clock and over a pty: suites Simulated_OptionBoard,
// Pty_OptionBoard and so on. With --document FILE... it runs nothing and prints docs/reference/conformance.md
// from the results (GoogleTest's JSON) in these files.
#include "case.hpp"
#include "daemon_slave.hpp"
#include "document.hpp"
#include "simulated_slave.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <memory>

namespace conformance {

const std::vector<Case>& cases()
{
    static const std::vector<Case> all = [] {
        std::vector<Case> list;
        add_fdl_cases(list);
        add_start_up_cases(list);
        add_exchange_cases(list);
        add_master_cases(list);
        add_global_control_cases(list);
        add_diagnosis_cases(list);
        add_parameter_cases(list);
        add_bus_cases(list);
        add_device_cases(list);
        add_data_cases(list);
        return list;
    }();
    return all;
}

namespace {

class OnTheClock : public testing::Test {
public:
    OnTheClock(const Case& one, const Family& family) : case_(one), family_(family) {}
    void TestBody() override
    {
        if (const char* const why = case_.why_not(family_)) GTEST_SKIP() << "not applicable: " << why;
        SimulatedSlave slave{family_};
        Bench bench{family_, slave};
        case_.run != nullptr ? case_.run(bench) : case_.run_simulated(bench, slave);
    }

private:
    const Case& case_;
    const Family& family_;
};

/// One daemon for all cases of a family; each case begins with it switched off and on.
class OverAPty : public testing::Test {
public:
    OverAPty(const Case& one, const Family& family) : case_(one), family_(family) {}
    static void TearDownTestSuite() { daemon.reset(); }
    void TestBody() override
    {
        if (const char* const why = case_.why_not(family_)) GTEST_SKIP() << "not applicable: " << why;
        if (!daemon) daemon = std::make_unique<DaemonSlave>(family_);
        daemon->begin_case();
        Bench bench{family_, *daemon};
        case_.run(bench);
        daemon->end_case();
    }

private:
    static inline std::unique_ptr<DaemonSlave> daemon;
    const Case& case_;
    const Family& family_;
};

template <class Wired>
void add(const std::string& wire, const Case& one, const Family& family)
{
    testing::RegisterTest((wire + family.suite).c_str(), one.name, nullptr, nullptr, __FILE__, __LINE__,
                          [&one, &family]() -> testing::Test* { return new Wired(one, family); });
}

void add_all()
{
    for (const Family& family : families())
        for (const Case& one : cases()) {
            add<OnTheClock>("Simulated_", one, family);
            if (one.why_simulated == nullptr) add<OverAPty>("Pty_", one, family);
        }
}

} // namespace
} // namespace conformance

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && arguments[0] == "--document") {
        std::cout << conformance::document({arguments.begin() + 1, arguments.end()});
        return 0;
    }
    conformance::add_all();
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
