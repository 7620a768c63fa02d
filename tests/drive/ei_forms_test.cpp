// SPDX-License-Identifier: Apache-2.0
/// Tests what an answer of a drive means where the row of the tag does not say its form, and what is said
/// where the two contradict each other.
#include "drive/ei/ei_forms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace dpslave::drive {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr UnitAddress kUnit{1, 2};

Tag number(std::uint16_t tag, std::uint8_t decimals)
{
    Tag row;
    row.number = tag;
    row.decimals = decimals;
    return row;
}

// ---- answers to a tag that is in no table

TEST(EiForms, ANumberIsDigitsWithOnePointAndOneSignAtMost)
{
    for (const char* text : {"12", "0", "9", "-5", "+5", "-12.5", "+.5", "12.", " 12 "}) {
        EiForms forms;
        const auto taken = forms.take(kUnit, unlisted_tag(288), text);
        EXPECT_EQ(taken.error, AccessError::no_scale) << text;
        EXPECT_EQ(taken.word, 0);
    }
}

TEST(EiForms, WhatIsNeitherNumberNorWordIsOfATypeThatIsNotTransported)
{
    for (const char* text :
         {"", ".", "-", "--5", "-+5", "1.2.3", "..", "1-2", "1/2", "1:2", "ABC", "5V", ">12G4"}) {
        EiForms forms;
        const auto taken = forms.take(kUnit, unlisted_tag(288), text);
        EXPECT_EQ(taken.error, AccessError::unsupported_type) << text;
        EXPECT_EQ(taken.word, 0);
        EXPECT_THAT(taken.trouble, EndsWith("', which is neither number nor word"));
    }
}

TEST(EiForms, ANumberHasTheDecimalsThatTheStationGives)
{
    EiForms forms;
    const Tag tag = unlisted_tag(288, 1);
    EXPECT_TRUE(forms.must_be_read(kUnit, tag));
    EXPECT_EQ(forms.take(kUnit, tag, "12.5").word, 125);
    EXPECT_FALSE(forms.must_be_read(kUnit, tag));
    EXPECT_FALSE(forms.is_word(kUnit, tag));
}

TEST(EiForms, AnAnswerThatIsNoWordAnyMoreMakesTheFormUnknownAgain)
{
    EiForms forms;
    const Tag tag = unlisted_tag(536);
    EXPECT_FALSE(forms.is_word(kUnit, tag));
    forms.take(kUnit, tag, ">1A2B");
    EXPECT_TRUE(forms.is_word(kUnit, tag));
    forms.take(kUnit, tag, "12.5");
    EXPECT_FALSE(forms.is_word(kUnit, tag));
    EXPECT_TRUE(forms.must_be_read(kUnit, tag));
}

TEST(EiForms, TheRowCountsOnceItSaysTheForm)
{
    EiForms forms;
    forms.take(kUnit, unlisted_tag(536), ">1A2B");
    EXPECT_FALSE(forms.is_word(kUnit, number(536, 1)));
    EXPECT_EQ(forms.take(kUnit, number(536, 1), ">1A2B").error, AccessError::unsupported_type);
}

// ---- whose answer it was

TEST(EiForms, AnAnswerSaysNothingOfTheSameTagInAnotherDrive)
{
    EiForms forms;
    const Tag tag = unlisted_tag(536);
    forms.take(kUnit, tag, ">1A2B");
    for (const UnitAddress other :
         {UnitAddress{0, 2}, UnitAddress{1, 0}, UnitAddress{2, 1}, UnitAddress{0, 0}})
        EXPECT_TRUE(forms.must_be_read(other, tag)) << int{other.group} << ' ' << int{other.unit};
    EXPECT_TRUE(forms.must_be_read(kUnit, unlisted_tag(537)));
}

TEST(EiForms, ADriveThatMayBeAnotherOneIsForgottenWithAllItsTagsAndNoOtherDriveIs)
{
    EiForms forms;
    const std::vector<UnitAddress> others{{0, 15}, {1, 1}, {1, 3}};
    const std::vector<Tag> tags{unlisted_tag(0), unlisted_tag(1), unlisted_tag(0xFFFF)};
    for (const Tag& tag : tags) {
        forms.take(kUnit, tag, ">1A2B");
        for (const UnitAddress other : others) forms.take(other, tag, ">1A2B");
    }
    forms.forget(kUnit);
    for (const Tag& tag : tags) {
        EXPECT_TRUE(forms.must_be_read(kUnit, tag)) << tag.number;
        for (const UnitAddress other : others) EXPECT_FALSE(forms.must_be_read(other, tag)) << tag.number;
    }
}

// ---- words for the log

TEST(EiForms, AnAnswerThatContradictsItsRowIsSaidWithWhatTheRowSays)
{
    EiForms forms;
    const auto taken = forms.take(kUnit, number(288, 2), "1.234");
    EXPECT_EQ(taken.error, AccessError::contradicted);
    EXPECT_EQ(taken.word, 0);
    EXPECT_THAT(taken.trouble, HasSubstr("its row says INT, 2 decimals: it has more decimals"));
    EXPECT_THAT(forms.take(kUnit, number(288, 1), "1.234").trouble, HasSubstr("INT, 1 decimal: "));
}

TEST(EiForms, AnAnswerThatContradictsTheStationIsSaidWithWhatTheStationSays)
{
    EiForms forms;
    const auto taken = forms.take(kUnit, unlisted_tag(288, 0), "1.2");
    EXPECT_EQ(taken.error, AccessError::contradicted);
    EXPECT_EQ(taken.word, 0);
    EXPECT_THAT(taken.trouble, HasSubstr("unlisted_decimals gives 0 decimals: it has more decimals"));
}

TEST(EiForms, ATableHasToBeCorrectedOnlyWhereTheAnswerHasMoreDecimals)
{
    EiForms forms;
    EXPECT_THAT(forms.take(kUnit, number(288, 1), "12.34").trouble,
                HasSubstr("until the table is corrected"));
    const auto taken = forms.take(kUnit, number(288, 1), "9999.9");
    EXPECT_EQ(taken.error, AccessError::does_not_fit);
    EXPECT_THAT(taken.trouble, Not(HasSubstr("until the table is corrected")));
}

} // namespace
} // namespace dpslave::drive
