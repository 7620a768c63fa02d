// SPDX-License-Identifier: Apache-2.0
// Tests what a survey sees in the answers of a drive, whom it asks next, and how long it says that it takes.
#include "sightings.hpp"

#include "dpslave/profile/survey.hpp"

#include <gmock/gmock.h>

#include <functional>

namespace dpslave::profile {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::denied;
using test::said;
using test::saw;
using test::silence;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

TEST(SurveySighting, the_most_decimals_count_because_the_drive_leaves_out_zeros)
{
    const Sighting one = saw({"30.", "12.34", "-0.5", "12.5"});

    EXPECT_EQ(one.form, SurveyForm::number);
    EXPECT_EQ(one.decimals, 2U);
    EXPECT_EQ(text(one.lowest), "-0.5");
    EXPECT_EQ(text(one.highest), "30");
    EXPECT_EQ(one.last, "12.5");
    EXPECT_EQ(one.answers, 4U);
}

TEST(SurveySighting, extremes_are_compared_as_numbers_and_not_as_digits)
{
    const Sighting one = saw({"9.5", "10.", "-2.", "-1.75"});

    EXPECT_EQ(text(one.lowest), "-2");
    EXPECT_EQ(text(one.highest), "10");
}

TEST(SurveySighting, a_number_may_have_leading_blanks_and_no_point)
{
    const Sighting one = saw({"    9.87", "12"});

    EXPECT_EQ(one.form, SurveyForm::number);
    EXPECT_EQ(text(one.lowest), "9.87");
    EXPECT_EQ(text(one.highest), "12");
}

TEST(SurveySighting, hexadecimal_answers_keep_their_most_digits)
{
    const Sighting one = saw({">00", ">1B0B", ">A"});

    EXPECT_EQ(one.form, SurveyForm::hexadecimal);
    EXPECT_EQ(one.digits, 4U);
    EXPECT_EQ(one.highest.counts, 0x1B0B);
}

TEST(SurveySighting, what_is_no_number_is_a_text)
{
    for (const char* const answer :
         {"DPSIM-EXAMPLE", "1.2.3", ">12345", ">", "", ".", "1234567890123", "12A"})
        EXPECT_EQ(saw({answer}).form, SurveyForm::other) << answer;
}

TEST(SurveySighting, answers_of_two_forms_are_mixed_and_stay_so)
{
    EXPECT_EQ(saw({"12.", ">000C", "12."}).form, SurveyForm::mixed);
    EXPECT_EQ(saw({"OFF", "1."}).form, SurveyForm::mixed);
}

TEST(SurveySighting, of_modbus_only_the_sixteen_bits_are_known)
{
    Sighting one;
    one.add(said(65000));
    one.add(said(12));

    EXPECT_EQ(one.form, SurveyForm::word);
    EXPECT_EQ(text(one.lowest), "12");
    EXPECT_EQ(text(one.highest), "65000");
}

TEST(SurveySighting, silences_and_denials_are_counted_apart_and_change_nothing_that_was_seen)
{
    Sighting one = saw({"1.5"});
    one.add(silence());
    one.add(denied("invalid tag"));

    EXPECT_EQ(one.form, SurveyForm::number);
    EXPECT_EQ(one.answers, 1U);
    EXPECT_EQ(one.silences, 1U);
    EXPECT_EQ(one.denials, 1U);
    EXPECT_EQ(one.asked(), 3U);
    EXPECT_EQ(one.denied, "invalid tag");
}

// ---- the record

TEST(SurveyRecord, comes_back_from_its_file_as_it_was)
{
    Survey survey;
    survey[55] = saw({"12.34", "-0.5"});
    survey[55].mnemonic = "bj";
    survey[56] = saw({">1B0B"});
    survey[57] = saw({R"(A "text", with comma)"});
    survey[58].add(denied("invalid tag"));
    survey[59].add(silence());
    survey[60] = saw({"1.", ">1"});

    const auto read = read_record(record_text(survey, "unwinder"), "r.csv", "unwinder");

    ASSERT_TRUE(read);
    EXPECT_EQ(record_text(*read, "unwinder"), record_text(survey, "unwinder"));
    ASSERT_EQ(read->size(), 6U);
    EXPECT_EQ(read->at(55).mnemonic, "bj");
    EXPECT_EQ(text(read->at(55).lowest), "-0.5");
    EXPECT_EQ(read->at(55).decimals, 2U);
    EXPECT_EQ(read->at(57).last, R"(A "text", with comma)");
    EXPECT_EQ(read->at(58).denied, "invalid tag");
    EXPECT_EQ(read->at(59).silences, 1U);
    EXPECT_EQ(read->at(60).form, SurveyForm::mixed);
}

TEST(SurveyRecord, another_file_is_refused_with_its_line)
{
    const auto table = read_record("tag,name\n1,SPEED\n", "t.csv", "unwinder");
    ASSERT_FALSE(table);
    EXPECT_THAT(table.error().front().what, HasSubstr("not the record of a survey"));

    Survey survey;
    survey[55] = saw({"1."});
    const auto cut = read_record(record_text(survey, "unwinder") + "56,bk,1,0\n", "r.csv", "unwinder");
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().front().line, 3U);
}

TEST(SurveyRecord, of_another_station_is_refused)
{
    Survey survey;
    survey[55] = saw({"1."});
    const auto read = read_record(record_text(survey, "re,winder"), "r.csv", "unwinder");

    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().front().what, HasSubstr("the record of station 're,winder', not of 'unwinder'"));
}

// ---- which tag is next

std::vector<int> order(SurveyPlan plan, Survey seen, std::size_t steps,
                       const std::function<SurveyAnswer(int)>& answer)
{
    std::vector<int> asked;
    while (asked.size() < steps) {
        const auto tag = plan.next(seen);
        if (!tag) break;
        asked.push_back(*tag);
        seen[*tag].add(answer(*tag));
    }
    return asked;
}

TEST(SurveyPlan, asks_each_tag_once_in_ascending_order)
{
    EXPECT_THAT(order({{{3, 5}, {9, 9}}, 1}, {}, 99, [](int) { return said("1."); }),
                ElementsAre(3, 4, 5, 9));
}

TEST(SurveyPlan, a_denied_tag_is_asked_once_and_a_silent_one_three_times_after_the_others)
{
    const auto answer = [](int tag) {
        return tag == 1 ? denied("invalid tag") : tag == 2 ? silence() : said("1.");
    };

    EXPECT_THAT(order({{{1, 3}}, 1}, {}, 99, answer), ElementsAre(1, 2, 3, 2, 2));
    EXPECT_THAT(order({{{1, 3}}, 3}, {}, 99, answer), ElementsAre(1, 2, 3, 2, 3, 2, 3));
}

TEST(SurveyPlan, without_an_end_goes_on_with_those_that_answer)
{
    const auto answer = [](int tag) { return tag == 1 ? denied("invalid tag") : said("1."); };

    EXPECT_THAT(order({{{1, 3}}, 0}, {}, 7, answer), ElementsAre(1, 2, 3, 2, 3, 2, 3));
    EXPECT_THAT(order({{{1, 1}}, 0}, {}, 7, answer), ElementsAre(1)) << "nothing is left to ask";
}

TEST(SurveyPlan, goes_on_where_a_record_ends_with_the_tags_that_were_asked_least)
{
    Survey seen;
    seen[1] = saw({"1.", "2."});
    seen[2] = saw({"1."});
    seen[3].add(denied("invalid tag"));

    EXPECT_THAT(order({{{1, 5}}, 2}, seen, 99, [](int) { return said("1."); }), ElementsAre(4, 5, 2, 4, 5));
}

TEST(SurveyPlan, takes_tag_65535_too)
{
    EXPECT_THAT(order({{{65534, 65535}}, 1}, {}, 99, [](int) { return denied("invalid tag"); }),
                ElementsAre(65534, 65535));
}

TEST(SurveyPlan, says_how_many_reads_are_left)
{
    const SurveyPlan once{{{1, 100}}, 1}, thrice{{{1, 100}}, 3};
    Survey seen;
    EXPECT_EQ(once.tags(), 100U);
    EXPECT_EQ(once.left(seen), 100U);
    for (std::uint16_t tag = 1; tag <= 10; ++tag)
        seen[tag].add(tag % 2 == 0 ? denied("invalid tag") : said("1."));
    seen[200] = saw({"1."});

    EXPECT_EQ(once.left(seen), 90U);
    EXPECT_EQ(thrice.left(seen), 90U + 90U * 2 / 2 + 5U * 2)
        << "every second of the others will be denied, as it was until now";
}

// ---- how long it takes

TEST(SurveyPace, says_nothing_before_it_has_measured_and_then_what_the_last_reads_took)
{
    SurveyPace pace;
    for (int i = 0; i < 7; ++i) pace.took(milliseconds{50});
    EXPECT_EQ(pace.time_for(100), std::nullopt);
    pace.took(milliseconds{50});
    EXPECT_THAT(pace.time_for(100), Optional(seconds{5}));
    for (int i = 0; i < 64; ++i) pace.took(milliseconds{200});
    EXPECT_THAT(pace.time_for(100), Optional(seconds{20})) << "the silent part of the numbers takes longer";
    EXPECT_THAT(pace.time_for(1), Optional(seconds{1})) << "rounded up";
}

// ---- how long it waits

using Verdict = SurveyPatience::Verdict;

TEST(SurveyPatience, waits_half_a_minute_for_the_drive_and_behind_another_survey)
{
    for (const bool for_drive : {true, false}) {
        SurveyPatience patience{std::nullopt};
        EXPECT_EQ(patience.waits(for_drive, seconds{100}), Verdict::wait);
        EXPECT_EQ(patience.waits(for_drive, milliseconds{129'999}), Verdict::wait);
        EXPECT_EQ(patience.waits(for_drive, seconds{130}),
                  for_drive ? Verdict::no_drive : Verdict::other_survey);
    }
}

TEST(SurveyPatience, begins_anew_with_each_answer)
{
    SurveyPatience patience{std::nullopt};
    EXPECT_EQ(patience.waits(true, seconds{0}), Verdict::wait);
    patience.was_answered();
    EXPECT_EQ(patience.waits(true, seconds{40}), Verdict::wait);
    EXPECT_EQ(patience.waits(true, seconds{70}), Verdict::no_drive);
}

TEST(SurveyPatience, with_a_time_of_its_own_waits_for_the_drive_until_that_is_over)
{
    SurveyPatience patience{seconds{600}};
    EXPECT_EQ(patience.waits(true, seconds{0}), Verdict::wait);
    EXPECT_EQ(patience.waits(true, seconds{599}), Verdict::wait);
    EXPECT_FALSE(patience.is_time_over(seconds{599}));
    EXPECT_EQ(patience.waits(true, seconds{600}), Verdict::no_drive);
    EXPECT_TRUE(patience.is_time_over(seconds{600}));
}

TEST(SurveyPatience, with_a_time_of_its_own_waits_for_another_survey_half_a_minute_all_the_same)
{
    SurveyPatience patience{seconds{600}};
    EXPECT_EQ(patience.waits(false, seconds{0}), Verdict::wait);
    EXPECT_EQ(patience.waits(false, seconds{30}), Verdict::other_survey);

    SurveyPatience at_the_end{seconds{10}};
    EXPECT_EQ(at_the_end.waits(false, seconds{10}), Verdict::time_is_over);
}

// ---- texts of the options

TEST(SurveyTags, are_printed_as_spans)
{
    const std::vector<std::uint16_t> tags{1, 2, 3, 7, 9, 10, 65535};
    EXPECT_EQ(spans_text(tags), "1-3, 7, 9, 10, 65535");
    EXPECT_EQ(spans_text({}), "");
}

} // namespace
} // namespace dpslave::profile
