// SPDX-License-Identifier: Apache-2.0
// The keys of a station by which it takes the plant's own GSD.
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/station_keys.hpp"

#include <gmock/gmock.h>

namespace dpslave::profile {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Profile shipped(const std::string& name)
{
    auto profile = load_profile(io::read_regular_file, test::source_path("config/profiles"), name);
    return profile ? *std::move(profile) : Profile{};
}

std::string form_of(std::string_view text)
{
    const auto identifier = read_identifier(text);
    if (!identifier) return identifier.error();
    return to_string(*identifier) + ": " + std::to_string(identifier->reads) + " in, " +
           std::to_string(identifier->writes) + " out";
}

TEST(Identifier, HasWholeWordsInTheGeneralAndTheSpecialFormat)
{
    EXPECT_EQ(form_of("50"), "50: 1 in, 0 out");
    EXPECT_EQ(form_of("52"), "52: 3 in, 0 out");
    EXPECT_EQ(form_of("e0"), "E0: 0 in, 1 out") << "consistent as a whole";
    EXPECT_EQ(form_of("7F"), "7F: 16 in, 16 out");
    EXPECT_EQ(form_of("40 40"), "40 40: 1 in, 0 out");
    EXPECT_EQ(form_of("80 FF"), "80 FF: 0 in, 64 out");
    EXPECT_EQ(form_of("C0 41 C1"), "C0 41 C1: 2 in, 2 out");
    EXPECT_EQ(form_of("CF 40 40"), "CF 40 40: 1 in, 1 out") << "no manufacturer's octets follow";
}

TEST(Identifier, IsRefusedInASentenceWhereAWordWouldNotBeOneParameter)
{
    EXPECT_THAT(form_of("10"), HasSubstr("\"10\" counts octets"));
    EXPECT_THAT(form_of("11"), HasSubstr("\"11\" counts octets")) << "two octets are no word for a master";
    EXPECT_THAT(form_of("C0 40 41"), HasSubstr("not as many inputs as outputs"));
    EXPECT_THAT(form_of("C0 40 01"), HasSubstr("counts octets"));
    EXPECT_THAT(form_of("41 40 AA"), HasSubstr("manufacturer's octets"));
    EXPECT_THAT(form_of("C1 40 81"), HasSubstr("cut short"));
    EXPECT_THAT(form_of("50 60"), HasSubstr("a text for each identifier"));
    EXPECT_THAT(form_of("00"), HasSubstr("no inputs and no outputs"));
    EXPECT_THAT(form_of(""), HasSubstr("write its octets in hexadecimal"));
    EXPECT_THAT(form_of("0x52"), HasSubstr("write its octets in hexadecimal"));
    EXPECT_THAT(form_of("152"), HasSubstr("write its octets in hexadecimal"));
}

std::vector<std::string> wrong(const std::string& profile, const StationKeys& keys)
{
    std::vector<std::string> all;
    for (const WrongKey& one : wrong_keys(shipped(profile), keys))
        all.push_back(std::string{one.key} + ": " + one.sentence);
    return all;
}

TEST(StationKeys, AreRefusedWhereTheProfileCannotHaveThem)
{
    EXPECT_THAT(
        wrong("2408f", {.tags_at = 1, .identifiers = {*read_identifier("52"), *read_identifier("60")}}),
        IsEmpty());
    EXPECT_THAT(wrong("590plus", {.tags_at = 2}), ElementsAre(HasSubstr("tags_at: the first three octets")));
    EXPECT_THAT(wrong("2408f", {.tags_at = 4}), ElementsAre(HasSubstr("up to 238 octets")));
    EXPECT_THAT(wrong("2408f", {.identifiers = {*read_identifier("73")}}),
                ElementsAre(HasSubstr("73 is Demand Data, which the profile 2408f takes in first position")));
    EXPECT_THAT(wrong("2408f", {.identifiers = {*read_identifier("52"), *read_identifier("52")}}),
                ElementsAre(HasSubstr("identifiers: the identifier 52 is listed twice")));
}

TEST(StationKeys, MoveThePermittedLengthOfUserPrmDataWithTheTags)
{
    const dp::PrmLayout prm = personality_of(shipped("590"), {.tags_at = 1}).prm;
    EXPECT_EQ(prm.tags_at, 1U);
    EXPECT_EQ(prm.min_length, 25U);
    EXPECT_EQ(prm.max_length, 25U);
    EXPECT_EQ(personality_of(shipped("590plus"), {.tags_at = 5}).prm.max_length, 65U);
}

TEST(StationKeys, ChangeNothingWhereNoneIsSaid)
{
    for (const char* name : {"590", "590plus", "2408f"}) {
        const Profile profile = shipped(name);
        EXPECT_EQ(personality_of(profile, {}), profile.personality) << name;
    }
}

TEST(StationKeys, StandInPlaceOfTheIdentAndTheIdentifiersOfTheProfile)
{
    const dp::Personality own =
        personality_of(shipped("2408f"), {.ident = 0x0536, .identifiers = {*read_identifier("C0 40 40")}});
    EXPECT_EQ(own.ident, 0x0536);
    ASSERT_EQ(own.identifiers.size(), 1U);
    EXPECT_EQ(own.identifiers[0], (dp::Identifier{std::vector<std::uint8_t>{0xC0, 0x40, 0x40}, 1, 1}));
}

} // namespace
} // namespace dpslave::profile
