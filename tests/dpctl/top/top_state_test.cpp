// SPDX-License-Identifier: Apache-2.0
// Tests what dpctl top shows, and what the keys change in it.
#include "sightings.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using dpctl::Key;
using dpctl::TopState;
using testing::ElementsAre;
using testing::SizeIs;
using Kind = Key::Kind;

/// `text` on the keyboard, character by character.
bool type(TopState& state, std::string_view text)
{
    bool goes_on = true;
    for (const char c : text) goes_on = state.on_key({Kind::character, std::string(1, c)});
    return goes_on;
}

std::vector<std::string> names(const TopState& state)
{
    std::vector<std::string> all;
    for (const report::Station* const one : state.stations()) all.push_back(one->name);
    return all;
}

TEST(TopState, EndsWithQ)
{
    TopState state = one_look();
    EXPECT_TRUE(type(state, "x"));
    EXPECT_FALSE(type(state, "q"));
    EXPECT_FALSE(type(state, "Q"));
}

TEST(TopState, SelectsWithTheArrowsAndStaysAtTheEnds)
{
    TopState state = one_look();
    EXPECT_EQ(state.selected(), 0u);
    state.on_key({Kind::up, {}});
    EXPECT_EQ(state.selected(), 0u);
    state.on_key({Kind::down, {}});
    state.on_key({Kind::down, {}});
    EXPECT_EQ(state.selected(), 1u);
    state.on_key({Kind::up, {}});
    EXPECT_EQ(state.selected(), 0u);
}

TEST(TopState, KeepsTheStationSelectedWhenOthersGo)
{
    TopState state = one_look();
    state.on_key({Kind::down, {}});
    dpctl::Sighting later = sighting(1);
    later.status.stations.erase(later.status.stations.begin());

    state.add(later, {});

    EXPECT_THAT(names(state), ElementsAre("rewinder"));
    EXPECT_EQ(state.selected(), 0u);
}

TEST(TopState, SelectsTheFirstWhenTheSelectedOneGoes)
{
    TopState state = one_look();
    state.on_key({Kind::down, {}});
    dpctl::Sighting later = sighting(1);
    later.status.stations.pop_back();

    state.add(later, {});

    EXPECT_EQ(state.selected(), 0u);
}

TEST(TopState, HasOnlyTheStationsThatWereAskedFor)
{
    dpctl::Sighting one = sighting(0);
    one.io.stations.pop_back(); // GetIo was asked for the unwinder only
    TopState state;
    state.add(one, {});

    EXPECT_THAT(names(state), ElementsAre("unwinder"));
}

TEST(TopState, ScrollsTheValuesByPagesAndNotPastTheEnd)
{
    TopState state = many_stations(2, 20);
    state.on_key({Kind::page_up, {}});
    EXPECT_EQ(state.first_word(), 0u);
    for (int i = 0; i < 9; ++i) state.on_key({Kind::page_down, {}});
    EXPECT_EQ(state.first_word(), 19u);
    state.on_key({Kind::page_up, {}});
    EXPECT_EQ(state.first_word(), 11u);

    state.on_key({Kind::down, {}});

    EXPECT_EQ(state.first_word(), 0u) << "another station begins at its first value";
}

TEST(TopState, FiltersByTheNameOfAStationAndThenHasAllItsValues)
{
    TopState state = one_look();
    EXPECT_TRUE(type(state, "/UNQ")) << "q is a letter of the filter";
    EXPECT_THAT(names(state), ElementsAre());
    state.on_key({Kind::backspace, {}});
    EXPECT_EQ(state.filter(), "UN");
    EXPECT_THAT(names(state), ElementsAre("unwinder"));
    EXPECT_THAT(state.words("unwinder"), SizeIs(2));
}

TEST(TopState, FiltersByTheNameOrTheNumberOfATagAndThenHasThisOneOnly)
{
    TopState state = one_look();
    type(state, "/feedback");
    EXPECT_THAT(names(state), ElementsAre("unwinder"));
    ASSERT_THAT(state.words("unwinder"), SizeIs(1));
    EXPECT_EQ(state.words("unwinder")[0]->tag, 7);

    state.on_key({Kind::clear, {}});
    type(state, "56");
    ASSERT_THAT(state.words("unwinder"), SizeIs(1));
    EXPECT_EQ(state.words("unwinder")[0]->tag, 56);
    EXPECT_TRUE(state.types_filter());
}

TEST(TopState, FiltersByTheAddressOfAStation)
{
    TopState state = one_look();
    type(state, "/16");
    EXPECT_THAT(names(state), ElementsAre("rewinder"));
}

TEST(TopState, KeepsTheFilterWithEnterAndEndsItWithEsc)
{
    TopState state = one_look();
    type(state, "/re");
    state.on_key({Kind::enter, {}});
    EXPECT_FALSE(state.types_filter());
    EXPECT_THAT(names(state), ElementsAre("rewinder"));
    EXPECT_TRUE(type(state, "x")) << "no letter of the filter any more";
    EXPECT_EQ(state.filter(), "re");

    state.on_key({Kind::escape, {}});

    EXPECT_EQ(state.filter(), "");
    EXPECT_THAT(names(state), SizeIs(2));
}

TEST(TopState, TakesWholeCharactersOffTheFilterAndNotMoreThanItHolds)
{
    TopState state = one_look();
    type(state, "/");
    state.on_key({Kind::character, "\u00FC"});
    state.on_key({Kind::backspace, {}});
    EXPECT_EQ(state.filter(), "");
    state.on_key({Kind::backspace, {}});
    EXPECT_EQ(state.filter(), "");

    type(state, std::string(1000, 'a'));

    EXPECT_EQ(state.filter().size(), TopState::kLongestFilter);
}

TEST(TopState, KnowsWhatHasChangedSinceTheLookBefore)
{
    const TopState first = one_look();
    EXPECT_FALSE(first.has_changed(first.now().status.stations[0])) << "there is no look before";
    EXPECT_FALSE(first.has_changed("unwinder", first.now().io.stations[0].words[0]));

    const TopState second = two_looks();
    EXPECT_FALSE(second.has_changed(second.now().status.stations[0]));
    EXPECT_TRUE(second.has_changed(second.now().status.stations[1])) << "another state";
    EXPECT_TRUE(second.has_changed("unwinder", second.now().io.stations[0].words[0]));
    EXPECT_FALSE(second.has_changed("unwinder", second.now().io.stations[0].words[1]));
}

TEST(TopState, CallsWhatIsNewChanged)
{
    TopState state = one_look();
    dpctl::Sighting later = sighting(1);
    later.status.stations[1].name = later.io.stations[1].name = "winder 3";
    later.io.stations[1].words = later.io.stations[0].words;
    later.io.stations[0].words[0].tag = 8; // another layout

    state.add(later, {});

    EXPECT_TRUE(state.has_changed(state.now().status.stations[1]));
    EXPECT_TRUE(state.has_changed("winder 3", state.now().io.stations[1].words[0]));
    EXPECT_TRUE(state.has_changed("unwinder", state.now().io.stations[0].words[0]));
}

TEST(TopState, KeepsTheLastEventsAndTheirTimes)
{
    TopState state = one_look();
    ASSERT_THAT(state.events(), SizeIs(3));
    EXPECT_DOUBLE_EQ(state.events().back().unix_seconds, 1'795'580'108.5);
    report::GetEventsReply again = past_events();
    again.events = {again.events.back()};
    again.events[0].count = 41;

    state.add(sighting(1), again);

    ASSERT_THAT(state.events(), SizeIs(3)) << "it has the number of one that is known";
    EXPECT_EQ(state.events().back().text, "rewinder: Chk_Cfg of master 2 was refused (41 times)");

    again.events[0].age_ms += 1;
    state.add(sighting(1), again);
    EXPECT_DOUBLE_EQ(state.events().back().unix_seconds, 1'795'580'109.5) << "the same event keeps its time";

    report::GetEventsReply many;
    for (int i = 0; i < 1000; ++i) many.events.push_back({100 + i, 1.0, {}, "state", "x", 1});
    state.add(sighting(2), many);
    EXPECT_THAT(state.events(), SizeIs(TopState::kMostEvents));
    EXPECT_EQ(state.events().back().number, 1099);
}

} // namespace
} // namespace dpslave::test
