// SPDX-License-Identifier: Apache-2.0
/// Lamps whose chips hang, fail or come late. The threads are real, the clock is simulated.
#include "app/state/lamps.hpp"
#include "support/eventually.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <list>
#include <map>
#include <mutex>
#include <set>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using test::eventually;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr led::Condition kNoMaster{.running = true};                        // red on, green 1 Hz
constexpr led::Condition kExchange{.running = true, .data_exchange = true}; // red off, green 2 Hz

/// The chips, as their threads see them.
struct Chips {
    std::mutex mutex;
    std::map<std::string, bool> lit;    ///< lamps that are open
    std::map<std::string, int> touched; ///< opened, switched or closed
    std::set<std::string> missing, broken;
    std::string hangs;                   ///< every call of a lamp that begins so
    std::chrono::milliseconds takes{0};  ///< each switching
    std::atomic<bool> may_go_on{false};  ///< what hangs
    std::atomic<std::int64_t> now_ns{0}; ///< the clock

    /// A call of `sink` begins.
    void touch(const std::string& sink)
    {
        bool is_hanging = false;
        {
            const std::lock_guard lock{mutex};
            ++touched[sink];
            is_hanging = !hangs.empty() && sink.starts_with(hangs);
        }
        if (is_hanging) may_go_on.wait(false);
    }
};
std::atomic<Chips*> chips = nullptr; // of the test that runs
std::list<Chips> chips_of_all_tests; // a thread that was left may look at them once more

class FakeLamp final : public io::LedSink {
public:
    explicit FakeLamp(std::string sink) : sink_(std::move(sink))
    {
        const std::lock_guard lock{on_.mutex};
        on_.lit[sink_] = false;
    }
    ~FakeLamp() override
    {
        on_.touch(sink_);
        const std::lock_guard lock{on_.mutex};
        on_.lit.erase(sink_);
    }
    bool set(bool lit) override
    {
        on_.touch(sink_);
        const std::lock_guard lock{on_.mutex};
        on_.now_ns += std::chrono::nanoseconds{on_.takes}.count();
        if (on_.broken.contains(sink_)) return false;
        on_.lit[sink_] = lit;
        return true;
    }

private:
    Chips& on_ = *chips;
    std::string sink_;
};

Result<std::unique_ptr<io::LedSink>, std::string> open(const std::string& sink, const std::filesystem::path&)
{
    Chips& on = *chips;
    on.touch(sink);
    {
        const std::lock_guard lock{on.mutex};
        if (on.missing.contains(sink))
            return Failure{sink + " is missing, look " + std::to_string(on.touched[sink])};
    }
    return Result<std::unique_ptr<io::LedSink>, std::string>{std::make_unique<FakeLamp>(sink)};
}

Instant clock_of_chips()
{
    return Instant{std::chrono::nanoseconds{chips.load()->now_ns.load()}};
}

class LampsOfTwoChips : public testing::Test {
protected:
    LampsOfTwoChips()
    {
        chips = &all;
        pass(1h);
        names({{"line:a:0", "line:b:0"}});
    }
    ~LampsOfTwoChips() override
    {
        all.may_go_on = true;
        all.may_go_on.notify_all();
        lamps.reset();
    }

    /// Stations with a red and a green lamp each, in force from now on.
    void names(const std::vector<std::pair<std::string, std::string>>& sinks)
    {
        config::Config config;
        for (const auto& [red, green] : sinks) {
            auto profile = std::make_shared<profile::Profile>();
            profile->leds = led::Language::option_board;
            config::StationConfig& station = config.stations.emplace_back();
            station.name = "s" + std::to_string(config.stations.size());
            station.profile = profile;
            station.leds = {{"red", red}};
            if (!green.empty()) station.leds.push_back({"green", green});
        }
        lamps->exchange(config);
    }
    Instant now() const { return clock_of_chips(); }
    void pass(std::chrono::nanoseconds time) { all.now_ns += time.count(); }

    /// The main thread goes round until `condition` holds. Its clock stands.
    template <class Condition>
    bool shows_until(Condition condition)
    {
        return eventually([&] {
            lamps->show(now());
            return condition();
        });
    }
    bool shows(const std::string& sink, std::optional<bool> lit)
    {
        return shows_until([&] { return state(sink) == lit; });
    }
    bool works(const std::string& lamp)
    {
        return shows_until([&] { return !lamps->trouble(0, lamp, now()); });
    }
    std::optional<bool> state(const std::string& sink)
    {
        const std::lock_guard lock{all.mutex};
        const auto found = all.lit.find(sink);
        return found != all.lit.end() ? std::optional{found->second} : std::nullopt;
    }
    int touched(const std::string& sink)
    {
        const std::lock_guard lock{all.mutex};
        return all.touched[sink];
    }
    /// What was said until now.
    std::vector<std::string> news()
    {
        std::vector<std::string> all_of_it;
        for (const auto& [station, sentence] : lamps->take_news(now())) all_of_it.push_back(sentence.text);
        return all_of_it;
    }
    void take(std::chrono::milliseconds time)
    {
        const std::lock_guard lock{all.mutex};
        all.takes = time;
    }
    void hang(const std::string& begin)
    {
        const std::lock_guard lock{all.mutex};
        all.hangs = begin;
    }

    Chips& all = chips_of_all_tests.emplace_back();
    std::unique_ptr<Lamps> lamps = std::make_unique<Lamps>(open, clock_of_chips);
};

TEST_F(LampsOfTwoChips, ShowTheirPatternsAtTheirMoments)
{
    lamps->set(0, kExchange);
    EXPECT_TRUE(shows("line:a:0", false));
    EXPECT_TRUE(shows("line:b:0", true)) << "a period begins";
    EXPECT_EQ(lamps->next_change(now()), now() + 250ms);

    pass(250ms);
    EXPECT_TRUE(shows("line:b:0", false));
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:a:0", true));
    EXPECT_THAT(news(), IsEmpty());
}

TEST_F(LampsOfTwoChips, OfAChipThatHangsKeepNeitherTheMainThreadNorTheOtherChip)
{
    hang("line:a");
    lamps->set(0, kExchange);
    EXPECT_TRUE(shows("line:b:0", true));
    pass(250ms);
    EXPECT_TRUE(shows("line:b:0", false));
    EXPECT_EQ(lamps->trouble(0, "red", now()), std::nullopt) << "not for long enough";

    pass(Lamps::kStalled);
    EXPECT_TRUE(works("green"));
    EXPECT_THAT(news(), ElementsAre(AllOf(HasSubstr("s1: the lamp red does not show its pattern"),
                                          HasSubstr("has not answered for 2 s"))));
    EXPECT_THAT(lamps->trouble(0, "red", now()).value_or(""), HasSubstr("LED line:a:0"));
    EXPECT_THAT(lamps->end(0ms), Contains("line:a"));
}

TEST_F(LampsOfTwoChips, GoOnWhenTheirChipAnswersAgain)
{
    hang("line:a");
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:b:0", true));
    pass(1min);
    EXPECT_TRUE(works("green"));
    EXPECT_THAT(news(), ElementsAre(HasSubstr("does not show its pattern")));

    hang("");
    all.may_go_on = true;
    all.may_go_on.notify_all();

    EXPECT_TRUE(shows("line:a:0", true));
    EXPECT_TRUE(shows_until([&] {
        pass(1s); // it was slow, and is left alone for a moment
        return !lamps->trouble(0, "red", now());
    }));
    EXPECT_THAT(news(), Contains("s1: the lamp red shows its pattern now"));
}

TEST_F(LampsOfTwoChips, ThatAreMissingAreTriedAgainAfterAGrowingTimeAndLightWhenTheyHaveCome)
{
    all.missing = {"line:a:0"};
    names({{"line:a:0", ""}});
    lamps->set(0, kNoMaster);
    int tries = 0;
    for (const auto pause : {1s, 2s, 4s, 8s, 16s, 30s, 30s}) {
        const std::string why = "line:a:0 is missing, look " + std::to_string(++tries);
        EXPECT_TRUE(shows_until([&] { return lamps->trouble(0, "red", now()) == why; })) << why;
        pass(pause - 1ns);
        lamps->show(now());
        EXPECT_EQ(touched("line:a:0"), tries) << pause.count();
        pass(1ns);
    }
    EXPECT_THAT(news(),
                ElementsAre("s1: the lamp red does not show its pattern: line:a:0 is missing, look 7"))
        << "said once";

    {
        const std::lock_guard lock{all.mutex};
        all.missing.clear();
    }
    pass(30s);
    EXPECT_TRUE(shows("line:a:0", true));
    EXPECT_TRUE(works("red"));
    EXPECT_THAT(news(), ElementsAre("s1: the lamp red shows its pattern now"));
}

TEST_F(LampsOfTwoChips, ThatCannotBeSwitchedAnyMoreAreOpenedAgain)
{
    lamps->set(0, kExchange);
    EXPECT_TRUE(shows("line:a:0", false));
    {
        const std::lock_guard lock{all.mutex};
        all.broken = {"line:a:0"};
    }
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows_until([&] { return lamps->trouble(0, "red", now()).has_value(); }));
    EXPECT_EQ(state("line:a:0"), std::nullopt) << "closed";
    {
        const std::lock_guard lock{all.mutex};
        all.broken.clear();
    }

    pass(1s);
    EXPECT_TRUE(shows("line:a:0", true));
}

TEST_F(LampsOfTwoChips, ThatAreSlowAreLeftAloneAndThenTriedAgain)
{
    lamps->set(0, kExchange);
    EXPECT_TRUE(shows("line:a:0", false));
    EXPECT_TRUE(shows("line:b:0", true));
    take(Lamps::kSlow + 1ms);
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:a:0", true));
    EXPECT_TRUE(shows_until([&] { return lamps->trouble(0, "red", now()).has_value(); }));
    EXPECT_THAT(*lamps->trouble(0, "red", now()), HasSubstr("took 501 ms"));
    const int before = touched("line:a:0");
    take(0ms);

    lamps->set(0, kExchange);
    EXPECT_TRUE(shows_until([&] { return touched("line:b:0") > 2; }));
    EXPECT_EQ(touched("line:a:0"), before);
    pass(30s);
    EXPECT_TRUE(shows("line:a:0", false));
    EXPECT_TRUE(works("red"));
}

TEST_F(LampsOfTwoChips, ThatStayGoOnWithoutABreakUnderWhateverName)
{
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:a:0", true));
    EXPECT_TRUE(shows("line:b:0", true));
    const int before = touched("line:a:0");

    names({{"line:c:0", "line:c:1"}, {"line:a:0", "line:b:1"}});
    lamps->set(0, kNoMaster);
    lamps->set(1, kNoMaster);
    EXPECT_TRUE(shows("line:c:0", true));
    EXPECT_TRUE(shows("line:b:1", true));
    EXPECT_TRUE(shows("line:b:0", std::nullopt)) << "it is configured no more";
    EXPECT_EQ(state("line:a:0"), true);
    EXPECT_EQ(touched("line:a:0"), before);
}

TEST_F(LampsOfTwoChips, AreDarkAtTheEnd)
{
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:a:0", true));

    EXPECT_THAT(lamps->end(1min), IsEmpty());

    EXPECT_EQ(state("line:a:0"), std::nullopt);
    EXPECT_EQ(state("line:b:0"), std::nullopt);
}

TEST_F(LampsOfTwoChips, ThatHangAtTheEndAreClosedByTheirOwnThreadIfTheyEverAnswer)
{
    lamps->set(0, kNoMaster);
    EXPECT_TRUE(shows("line:a:0", true));
    hang("line:a");
    const int before = touched("line:a:0");
    lamps->set(0, kExchange);
    EXPECT_TRUE(shows_until([&] { return touched("line:a:0") > before; }));

    EXPECT_THAT(lamps->end(0ms), Contains("line:a"));
    lamps.reset();
    EXPECT_TRUE(state("line:a:0").has_value()) << "it hangs still";

    all.may_go_on = true;
    all.may_go_on.notify_all();
    EXPECT_TRUE(eventually([&] { return !state("line:a:0"); }));
}

} // namespace
} // namespace dpslave::app
