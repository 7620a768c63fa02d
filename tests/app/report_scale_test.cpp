// SPDX-License-Identifier: Apache-2.0
// X-49 in words: what holds a station, what reads 0, and what to do.
#include "app/state/report.hpp"
#include "device_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using nlohmann::json;
using report::json_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class UnknownScale : public testing::Test {
protected:
    /// The master has chosen tag 55, an input that has answered 12.5.
    UnknownScale()
    {
        bench.view.bus.state = dp::State::data_exch;
        bench.view.bus.stat_diag = true;
        bench.view.bus.layout.generation = bench.view.drive.generation = 3;
        bench.view.bus.layout.count = 1;
        bench.view.bus.layout.parameters[0] = {.tag = 55, .reads = true, .writes = false};
        bench.view.drive.known = bench.view.drive.answers = true;
        found(AccessError::no_scale, "12.5");
    }
    void found(AccessError error, std::string_view answer)
    {
        bench.view.drive.states[0] = error == AccessError::none ? WordState::good : WordState::unscaled;
        bench.view.drive.errors[0] = error;
        bench.view.drive.answer_texts[0] = {};
        answer.copy(bench.view.drive.answer_texts[0].data(), answer.size());
    }
    void exchange_runs()
    {
        bench.view.bus.stat_diag = false;
        bench.view.bus.hold = StartHold::none;
    }
    std::vector<std::string> news()
    {
        bench.update(device);
        std::vector<std::string> texts;
        for (const app::Sentence& one : bench.news.take()) texts.push_back(one.text);
        return texts;
    }
    void has_row(bool confirmed, bool decimals_known)
    {
        drive::Tag row;
        row.number = 55;
        row.confirmed = confirmed;
        row.decimals_known = decimals_known;
        bench.station.tags = std::make_shared<const drive::TagTable>(std::vector{row});
    }

    test::DeviceBench bench;
    app::EmulatedDevice device{bench.station};
};

TEST_F(UnknownScale, ThatHoldsTheStartIsReportedWithTagAnswerAndWhatToDo)
{
    bench.view.bus.hold = StartHold::unscaled;
    EXPECT_THAT(
        app::scale_words(bench.view).value_or(""),
        AllOf(HasSubstr("Data exchange does not start: the scale of tag 55 (answers '12.5') is not known"),
              HasSubstr("tag table"), HasSubstr("dpctl survey"), HasSubstr("unlisted_decimals"),
              HasSubstr("dpctl reload")));
}

TEST_F(UnknownScale, IsReportedOnceAndAsAHoldAlsoInTheMomentBeforeTheBusSideHasIt)
{
    EXPECT_THAT(news(), ElementsAre(HasSubstr("Data exchange does not start")));
    bench.view.bus.hold = StartHold::unscaled;
    EXPECT_THAT(news(), IsEmpty());
}

TEST_F(UnknownScale, OfAStationThatGoesOnWithoutReadsZero)
{
    bench.station.unscaled_holds = false;
    EXPECT_THAT(app::scale_words(bench.view).value_or(""),
                HasSubstr("Inputs are held (0 if never read) and outputs are not written"));
}

TEST_F(UnknownScale, FoundOutLaterIsHeld)
{
    exchange_runs();
    EXPECT_THAT(app::scale_words(bench.view).value_or(""),
                HasSubstr("Inputs are held (0 if never read) and outputs are not written"));
}

TEST_F(UnknownScale, OfARowThatAnAnswerContradictsStaysRefusedUntilTheRowIsCorrected)
{
    found(AccessError::contradicted, "12.34");
    EXPECT_THAT(
        app::scale_words(bench.view).value_or(""),
        AllOf(HasSubstr("too few decimals to tag 55 (answers '12.34')"), HasSubstr("correct its row")));
    EXPECT_EQ(json_of(app::unscaled_report(bench.view)),
              json::parse(R"([{"tag":55,"direction":"in","answer":"12.34","contradicted":true}])"));
}

TEST_F(UnknownScale, IsOverWhenTheTagHasOne)
{
    EXPECT_THAT(news(), Not(IsEmpty()));
    found(AccessError::none, "");
    EXPECT_THAT(news(), IsEmpty()) << "not before the exchange has begun";
    exchange_runs();
    EXPECT_THAT(news(), ElementsAre(HasSubstr(
                            "the drive has every tag that the master has chosen, and its scale is known")));
}

TEST_F(UnknownScale, IsNotOverBecauseTheMasterHasLeft)
{
    EXPECT_THAT(news(), Not(IsEmpty()));
    bench.view.bus.state = dp::State::wait_prm;
    bench.view.bus.layout = {};
    EXPECT_THAT(news(), IsEmpty());

    bench.view.bus.state = dp::State::data_exch;
    bench.view.bus.layout.generation = bench.view.drive.generation = 4;
    bench.view.bus.layout.count = 1;
    bench.view.bus.layout.parameters[0] = {.tag = 55, .reads = true, .writes = false};
    EXPECT_THAT(news(), ElementsAre(HasSubstr("Data exchange does not start"))) << "each start says it";
}

TEST_F(UnknownScale, TheAdviceNamesWhatTheTableLacksAndNeverATableOfThePackage)
{
    bench.station.tag_file = "/usr/share/dpslaved/tags/empty.csv";
    bench.profile().tag_file = "/usr/share/dpslaved/tags/empty.csv";
    EXPECT_THAT(app::row_advice(bench.station, 55),
                AllOf(HasSubstr("write your own table"), Not(HasSubstr("add a line"))));
    bench.station.tag_file = "/etc/dpslaved/my-590.csv";
    EXPECT_THAT(app::row_advice(bench.station, 55), AllOf(HasSubstr("my-590.csv"), HasSubstr("add a line")));
    has_row(false, true);
    EXPECT_THAT(app::row_advice(bench.station, 55), HasSubstr("set confirmed to yes"));
    has_row(true, false);
    EXPECT_THAT(app::row_advice(bench.station, 55), HasSubstr("fill in column decimals"));
    has_row(true, true);
    EXPECT_EQ(app::row_advice(bench.station, 55), "");
}

TEST_F(UnknownScale, OfTripsIsReportedInTheDiagnosisOfABox)
{
    bench.is_a_box();
    exchange_runs();
    found(AccessError::none, "");
    const auto says_so =
        testing::Contains(AllOf(HasSubstr("trips are not known"), HasSubstr("set trip_tag")));
    const auto trouble = [this] {
        return json_of(app::diagnosis_report(bench.view)).at("trouble").get<std::vector<std::string>>();
    };

    EXPECT_THAT(trouble(), Not(says_so));
    bench.station.tec->trip.bit.tag = 0;
    EXPECT_THAT(trouble(), says_so);
}

/// The master has chosen the tags 55 and 56, and the drive denies 55.
class DeniedTags : public testing::Test {
protected:
    DeniedTags()
    {
        bench.view.bus.state = dp::State::data_exch;
        bench.view.bus.stat_diag = true;
        bench.view.bus.hold = StartHold::denied;
        bench.view.bus.layout.generation = bench.view.drive.generation = 3;
        bench.view.bus.layout.count = 2;
        bench.view.bus.layout.parameters[0] = {.tag = 55, .reads = true, .writes = false};
        bench.view.bus.layout.parameters[1] = {.tag = 56, .reads = false, .writes = true};
        bench.view.drive.known = bench.view.drive.answers = true;
        bench.view.drive.states[0] = WordState::invalid_tag;
        std::string_view{"EE >01C7"}.copy(bench.view.drive.answer_texts[0].data(), 8);
        bench.profile().mnemonics = drive::MnemonicRule::dc_590plus;
        bench.profile().mnemonics_assumed = true;
    }

    test::DeviceBench bench;
    app::EmulatedDevice device{bench.station};
};

TEST_F(DeniedTags, ThatHoldTheStartAreReportedWithWhatTheDriveSaidAndWhatToCheck)
{
    EXPECT_THAT(app::denied_words(bench.view).value_or(""),
                AllOf(HasSubstr("Data exchange does not start: the drive denies tag 55 (says 'EE >01C7')"),
                      HasSubstr("mnemonic rule 590plus (assumed), profile "),
                      HasSubstr("or set denied_tags = \"zero\""), HasSubstr("dpctl reload")));
    EXPECT_EQ(json_of(app::station_report(bench.view, Instant{})).at("held_because"),
              "the drive denies a tag");
    bench.update(device);
    const auto news = bench.news.take();
    ASSERT_EQ(news.size(), 1U);
    EXPECT_THAT(news[0].text, HasSubstr("the drive denies tag 55"));
}

TEST_F(DeniedTags, WhereAllAreDeniedTheyAreNamedWithoutAHoldToo)
{
    bench.view.bus.stat_diag = false;
    bench.view.bus.hold = StartHold::none;
    EXPECT_FALSE(app::denied_words(bench.view)) << "one of two: the list of refused tags names it";
    bench.view.drive.states[1] = WordState::invalid_tag;

    EXPECT_THAT(app::denied_words(bench.view).value_or(""),
                AllOf(HasSubstr("the drive denies every chosen tag: tag 55"), HasSubstr("unit ")));
    EXPECT_EQ(json_of(app::denied_report(bench.view)),
              json::parse(R"([{"tag":55,"direction":"in","answer":"EE >01C7"},
                              {"tag":56,"direction":"out","answer":""}])"));
}

} // namespace
} // namespace dpslave
