// SPDX-License-Identifier: Apache-2.0
/// The search for the rate, step by step, without a station (wire reference 7).
#include "dpslave/fdl/baud_search.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace dpslave;
using fdl::BaudSearch;
using fdl::BaudSearchSettings;
using fdl::BaudState;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

namespace {

constexpr Instant kStart{seconds{50}};

/// A search among these rates, at what a UART can do.
BaudSearchSettings among(std::initializer_list<Baud> rates)
{
    BaudSearchSettings settings;
    settings.rates.reset();
    for (const Baud baud : rates) settings.rates.set(index_of(baud));
    return settings;
}

/// Lets `dwells` dwell times pass and writes the rates down.
std::vector<Baud> rates_in(BaudSearch& search, std::size_t dwells)
{
    std::vector<Baud> rates{search.baud()};
    while (rates.size() <= dwells) {
        search.on_time(search.next_deadline());
        rates.push_back(search.baud());
    }
    return rates;
}

TEST(BaudSearch, HasItsFirstDeadlineAtOnce)
{
    const BaudSearch search{BaudSearchSettings{}, Baud::k1500};

    EXPECT_EQ(search.next_deadline(), Instant{});
    EXPECT_EQ(search.state(), BaudState::baud_search);
}

TEST(BaudSearch, GoesDownThroughTheSixRatesAndBeginsAgain)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_time(kStart);

    EXPECT_EQ(rates_in(search, 7), (std::vector<Baud>{Baud::k1500, Baud::k500, Baud::k187_5, Baud::k93_75,
                                                      Baud::k19_2, Baud::k9_6, Baud::k1500, Baud::k500}));
}

TEST(BaudSearch, LeavesOutTheRatesThatTheUartCannotDoWhereverTheyLie)
{
    BaudSearch search{among({Baud::k500, Baud::k93_75, Baud::k9_6}), Baud::k500};
    search.on_time(kStart);

    EXPECT_EQ(rates_in(search, 4),
              (std::vector<Baud>{Baud::k500, Baud::k93_75, Baud::k9_6, Baud::k500, Baud::k93_75}));
}

TEST(BaudSearch, StaysAtTheOnlyRateThatTheUartCanDo)
{
    BaudSearch search{among({Baud::k19_2}), Baud::k1500};
    search.on_time(kStart);

    EXPECT_EQ(rates_in(search, 2), (std::vector<Baud>{Baud::k19_2, Baud::k19_2, Baud::k19_2}));
}

TEST(BaudSearch, GoesOnAtItsRateWithAnotherUartThatCanDoIt)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_time(kStart);
    search.set_rates(among({Baud::k1500, Baud::k93_75}).rates);
    search.on_time(kStart + seconds{1});

    EXPECT_EQ(search.next_deadline(), kStart + seconds{2});
    EXPECT_EQ(rates_in(search, 2), (std::vector<Baud>{Baud::k1500, Baud::k93_75, Baud::k1500}));
}

TEST(BaudSearch, LeavesARateThatAnotherUartCannotDoAtOnceAndHasAWholeDwellAtTheNext)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_time(kStart);
    search.on_telegram(true, kStart);
    search.on_supervision(true, true, kStart);
    ASSERT_EQ(search.state(), BaudState::dp_control);
    search.set_rates(among({Baud::k500, Baud::k93_75}).rates);

    EXPECT_EQ(search.baud(), Baud::k500);
    EXPECT_EQ(search.state(), BaudState::baud_search);
    EXPECT_EQ(search.next_deadline(), Instant{});
    search.on_time(kStart + seconds{1});
    EXPECT_EQ(search.next_deadline(), kStart + seconds{3});
}

TEST(BaudSearch, NeverListensAt45_45AlthoughTheUartCanDoIt)
{
    BaudSearch search{among({Baud::k93_75, Baud::k45_45, Baud::k19_2}), Baud::k45_45};
    search.on_time(kStart);

    EXPECT_EQ(rates_in(search, 3), (std::vector<Baud>{Baud::k93_75, Baud::k19_2, Baud::k93_75, Baud::k19_2}));
}

TEST(BaudSearch, BeginsWithTheRateItIsGiven)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k93_75};
    search.on_time(kStart);

    EXPECT_EQ(rates_in(search, 3), (std::vector<Baud>{Baud::k93_75, Baud::k19_2, Baud::k9_6, Baud::k1500}));
}

TEST(BaudSearch, BeginsWithTheHighestIfTheRateGivenIsNotSearched)
{
    EXPECT_EQ((BaudSearch{BaudSearchSettings{}, Baud::k45_45}.baud()), Baud::k1500);
    EXPECT_EQ((BaudSearch{among({Baud::k500, Baud::k9_6}), Baud::k1500}.baud()), Baud::k500);
    EXPECT_EQ((BaudSearch{among({Baud::k45_45, Baud::k19_2}), Baud::k45_45}.baud()), Baud::k19_2);
}

TEST(BaudSearch, DwellsTwoSecondsFrom93_75UpAndFourBelow)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k93_75};
    search.on_time(kStart);
    EXPECT_EQ(search.next_deadline(), kStart + seconds{2});
    search.on_time(kStart + seconds{2} - nanoseconds{1});
    EXPECT_EQ(search.baud(), Baud::k93_75);
    search.on_time(kStart + seconds{2});
    EXPECT_EQ(search.baud(), Baud::k19_2);

    EXPECT_EQ(search.next_deadline(), kStart + seconds{6});
}

TEST(BaudSearch, TwentyCharactersWithMoreThanThirtyPercentErrorsEndTheDwell)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_characters(13, 0, kStart);
    search.on_characters(0, 6, kStart); // 19 characters
    EXPECT_EQ(search.baud(), Baud::k1500);
    search.on_characters(0, 1, kStart); // 7 of 20

    EXPECT_EQ(search.baud(), Baud::k500);
    EXPECT_EQ(search.next_deadline(), kStart + seconds{2});
}

TEST(BaudSearch, ThirtyPercentErrorsAreNotMore)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_characters(14, 6, kStart);

    EXPECT_EQ(search.baud(), Baud::k1500);
}

TEST(BaudSearch, ThirtyErrorsIn99CharactersAreMoreThanThirtyPercent)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_characters(69, 29, kStart);
    EXPECT_EQ(search.baud(), Baud::k1500);
    search.on_characters(0, 1, kStart);

    EXPECT_EQ(search.baud(), Baud::k500);
}

TEST(BaudSearch, CharactersAreCountedAnewAtEachRate)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_characters(0, 20, kStart);
    ASSERT_EQ(search.baud(), Baud::k500);
    search.on_characters(0, 19, kStart);

    EXPECT_EQ(search.baud(), Baud::k500);
}

TEST(BaudSearch, BadCharactersAreCountedAnewAtEachRate)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k1500};
    search.on_characters(0, 20, kStart);
    ASSERT_EQ(search.baud(), Baud::k500);
    search.on_characters(14, 6, kStart);

    EXPECT_EQ(search.baud(), Baud::k500);
}

TEST(BaudSearch, OneErrorFreeTelegramOfAnyStationIsEvidence)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(false, kStart);

    EXPECT_EQ(search.state(), BaudState::baud_control);
    EXPECT_EQ(search.baud(), Baud::k187_5);
    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{320});
}

TEST(BaudSearch, CharacterErrorsDoNotEndBaudControl)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_characters(0, 1000, kStart);

    EXPECT_EQ(search.state(), BaudState::baud_control);
    EXPECT_EQ(search.baud(), Baud::k187_5);
}

TEST(BaudSearch, BaudControlWithoutEvidenceFor320MsListensAtItsRateBeforeItIsLeft)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_time(kStart + milliseconds{320} - nanoseconds{1});
    EXPECT_FALSE(search.in_doubt());
    search.on_time(kStart + milliseconds{320});
    EXPECT_TRUE(search.in_doubt());

    search.on_time(kStart + milliseconds{2320} - nanoseconds{1});
    EXPECT_EQ(search.state(), BaudState::baud_control);
    EXPECT_EQ(search.baud(), Baud::k187_5);
    search.on_time(kStart + milliseconds{2320});
    EXPECT_EQ(search.state(), BaudState::baud_search);
    EXPECT_EQ(search.baud(), Baud::k93_75);
    EXPECT_FALSE(search.in_doubt());
}

TEST(BaudSearch, InDoubtATelegramOfAnyStationIsEvidence)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_supervision(true, false, kStart);
    search.on_telegram(true, kStart);
    search.on_time(kStart + milliseconds{320});
    search.on_telegram(false, kStart + milliseconds{400});

    EXPECT_FALSE(search.in_doubt());
    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{720});
}

TEST(BaudSearch, InDoubtBadCharactersEndTheDwell)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_time(kStart + milliseconds{320});
    search.on_characters(0, 20, kStart + milliseconds{330});

    EXPECT_EQ(search.state(), BaudState::baud_search);
    EXPECT_EQ(search.baud(), Baud::k93_75);
}

TEST(BaudSearch, TelegramsToOthersRetriggerBaudControlAgainOnceTheOwnerHasGone)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_supervision(true, false, kStart);
    search.on_supervision(false, false, kStart);
    search.on_telegram(false, kStart + milliseconds{300});

    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{620});
}

TEST(BaudSearch, TelegramsToUsRetriggerBaudControl)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_supervision(true, false, kStart);
    search.on_telegram(true, kStart);
    search.on_telegram(true, kStart + milliseconds{300});

    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{620});
}

TEST(BaudSearch, TelegramsToOthersRetriggerBaudControlWhileNoStationHasAnOwner)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(false, kStart);
    search.on_telegram(false, kStart + milliseconds{300});

    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{620});
}

TEST(BaudSearch, TelegramsToOthersDoNotRetriggerBaudControlOnceASlaveIsOwned)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(false, kStart);
    search.on_supervision(true, false, kStart);
    search.on_telegram(false, kStart + milliseconds{300});

    EXPECT_EQ(search.next_deadline(), kStart + milliseconds{320});
}

TEST(BaudSearch, WatchdogOfASlaveTakesOver)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_supervision(true, true, kStart);

    EXPECT_EQ(search.state(), BaudState::dp_control);
    EXPECT_EQ(search.next_deadline(), kNever);
    search.on_time(kStart + seconds{1000});
    EXPECT_EQ(search.state(), BaudState::dp_control);
}

TEST(BaudSearch, BaudControlComesBackWhenNoWatchdogIsLeft)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_supervision(true, true, kStart);
    search.on_supervision(false, false, kStart + seconds{9});

    EXPECT_EQ(search.state(), BaudState::baud_control);
    EXPECT_EQ(search.next_deadline(), kStart + seconds{9} + milliseconds{320});
}

TEST(BaudSearch, OwnerWithoutWatchdogAloneDoesNotMakeDpControl)
{
    BaudSearch search{BaudSearchSettings{}, Baud::k187_5};
    search.on_telegram(true, kStart);
    search.on_supervision(true, false, kStart);

    EXPECT_EQ(search.state(), BaudState::baud_control);
}

TEST(BaudSearch, StatesHaveTheNamesOfTheReference)
{
    EXPECT_EQ(fdl::text(BaudState::fixed), "fixed");
    EXPECT_EQ(fdl::text(BaudState::baud_search), "Baud_Search");
    EXPECT_EQ(fdl::text(BaudState::baud_control), "Baud_Control");
    EXPECT_EQ(fdl::text(BaudState::dp_control), "DP_Control");
}

} // namespace
