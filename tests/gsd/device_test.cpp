// SPDX-License-Identifier: Apache-2.0
// Tests what `dpctl gsd make` puts into a file: mappings, limits, sentences (B-004, B-071, C-010 to C-012,
// C-022, C-042, C-043, C-046, C-048).
#include "second_hand.hpp"

#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using profile::device_of;
using profile::Selection;
using test::kOwnIdent;
using test::load;
using test::made;
using test::second_hand;
using test::tags;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// The sentences that say why there is no file.
std::vector<std::string> refusals(const std::string& name, const Selection& selection)
{
    const auto device = device_of(load(name), selection);
    return device ? std::vector<std::string>{} : device.error();
}

TEST(GsdOfEuro2400, HasTheMappingOfTable4Dash1)
{
    for (const char* name : {"2408f", "2404f"}) {
        const auto gsd = second_hand(made(load(name), {}));
        EXPECT_THAT(gsd.octets("User_Prm_Data"),
                    ElementsAre(0, 1, 0, 5, 0, 3, 0, 75, 0, 24, 0, 25, 0, 15, 1, 18));
        EXPECT_THAT(gsd.cfg(), ElementsAre(0x50, 0x50, 0x50, 0x50, 0x60, 0x60, 0x60, 0x60));
        EXPECT_EQ(gsd.number("Modular_Station"), 0);
        EXPECT_EQ(gsd.number("Ident_Number"), kOwnIdent);
    }
}

TEST(GsdOfEurD2400, IsTheSameWithDemandData)
{
    const auto gsd = second_hand(made(load("2408f"), {.demand = true}));
    EXPECT_THAT(gsd.octets("User_Prm_Data"),
                ElementsAre(0, 1, 0, 5, 0, 3, 0, 75, 0, 24, 0, 25, 0, 15, 1, 18));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x73, 0x50, 0x50, 0x50, 0x50, 0x60, 0x60, 0x60, 0x60));
}

TEST(GsdOfTheControllers, IsOneForBothTypes)
{
    const std::string one = made(load("2408f"), {}), other = made(load("2404f"), {});
    EXPECT_EQ(one.substr(one.find("GSD_Revision")), other.substr(other.find("GSD_Revision")));
}

TEST(GsdOfTheGainSchedulingExample, HasThePidTermsAsOutputs)
{
    const auto mapping =
        profile::load_mapping(io::read_regular_file, test::kSource / "gsd/mappings/gain-scheduling.toml");
    ASSERT_TRUE(mapping);
    const auto gsd = second_hand(made(load(mapping->profile), mapping->selection));
    EXPECT_THAT(gsd.octets("User_Prm_Data"), ElementsAre(0, 1, 0, 6, 0, 8, 0, 9, 0, 18, 0, 17));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x50, 0x60, 0x60, 0x60, 0x60, 0x60));
    EXPECT_EQ(gsd.keys.at("Info_Text"), "\"Gain scheduling from the PLC\"");
}

TEST(GsdOfTheTechnologyBox, HasModulesLengthsAndNamesOfTheManual)
{
    const auto gsd = second_hand(made(load("605"), {}));
    EXPECT_EQ(gsd.number("Ident_Number"), 0x1649);
    EXPECT_EQ(gsd.keys.at("Model_Name"), "\"SSD Drives 605\"");
    EXPECT_EQ(gsd.number("Slave_Family"), 1) << "DRIVES";
    EXPECT_EQ(gsd.number("User_Prm_Data_Len"), 63);
    EXPECT_EQ(gsd.octets("User_Prm_Data"), std::vector<std::uint8_t>(63, 0));
    EXPECT_EQ(gsd.number("Max_Module"), 31);
    EXPECT_EQ(gsd.number("Max_Input_Len"), 68);
    EXPECT_EQ(gsd.number("Max_Output_Len"), 68);
    EXPECT_EQ(gsd.number("Max_Data_Len"), 136);
    EXPECT_EQ(gsd.number("Max_Diag_Data_Len"), 10);
    std::vector<int> octets;
    for (const auto& module : gsd.modules)
        octets.insert(octets.end(), module.identifiers.begin(), module.identifiers.end());
    EXPECT_THAT(octets, ElementsAre(0x73, 0x50, 0x60, 0x70));
    EXPECT_EQ(second_hand(made(load("584sv"), {})).keys.at("Model_Name"), "\"SSD Drives 584SV\"");
}

TEST(GsdOfTheTechnologyBox, HasTheTagsOfTheManualsExampleBehindThreeZeros)
{
    const auto gsd = second_hand(made(load("605"), {.in = {271, 269}, .out = {272, 255}}));
    EXPECT_THAT(gsd.octets("User_Prm_Data"),
                ElementsAre(0, 0, 0, 0x01, 0x0F, 0x01, 0x0D, 0x01, 0x10, 0x00, 0xFF));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x50, 0x50, 0x60, 0x60));
}

TEST(GsdOfTheTechnologyBox, HasParametersOfBothDirections)
{
    const auto gsd = second_hand(made(load("605"), {.in_out = {1127}, .demand = true}));
    EXPECT_THAT(gsd.octets("User_Prm_Data"), ElementsAre(0, 0, 0, 0x04, 0x67));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x73, 0x70));
    EXPECT_EQ(gsd.number("Max_Input_Len"), 10);
    EXPECT_EQ(gsd.number("Max_Output_Len"), 10);
    EXPECT_EQ(gsd.number("Max_Data_Len"), 20);
}

TEST(GsdOfTheOptionBoard, KeepsItsLengthOf24OctetsWhateverTheTags)
{
    const auto gsd = second_hand(made(load("590"), {.in = {55, 57}, .out = {56}, .demand = true}));
    auto octets = std::vector<std::uint8_t>{0, 55, 0, 57, 0, 56};
    octets.resize(24, 0);
    EXPECT_EQ(gsd.octets("User_Prm_Data"), octets);
    EXPECT_EQ(gsd.number("User_Prm_Data_Len"), 24);
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x73, 0x50, 0x50, 0x60));
}

TEST(GsdMake, KeepsTheOrderOfTheTagsAsTheyAreGiven)
{
    const auto gsd = second_hand(made(load("2408f"), {.in = {75, 1}, .out = {25, 24}}));
    EXPECT_THAT(gsd.octets("User_Prm_Data"), ElementsAre(0, 75, 0, 1, 0, 25, 0, 24));
}

TEST(GsdMake, MakesDemandDataAloneWhereNothingElseIsChosen)
{
    const auto gsd = second_hand(made(load("590"), {.demand = true}));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x73));
    EXPECT_EQ(gsd.octets("User_Prm_Data"), std::vector<std::uint8_t>(24, 0));
}

TEST(GsdMake, MakesDemandDataAloneOfAControllerWhereTheListIsEmpty)
{
    const std::string file =
        made(load("2408f"), {.list = std::vector<profile::GsdParameter>{}, .demand = true});
    const auto gsd = second_hand(file);
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x73));
    EXPECT_FALSE(gsd.keys.contains("User_Prm_Data"));
    EXPECT_THAT(file, HasSubstr("dpctl gsd make --profile 2408f --order none --demand"));
}

TEST(GsdMake, MakesNoFileOfAControllerWithoutParametersAndWithoutDemandData)
{
    const auto device =
        device_of(load("2408f"), {.list = std::vector<profile::GsdParameter>{}, .ident = 0x1652});
    ASSERT_FALSE(device);
    EXPECT_THAT(device.error(), ElementsAre(HasSubstr("none is chosen")));
}

TEST(GsdMake, SplitsMoreThan17IdentifiersIntoModulesOfAFixedOrder)
{
    const auto gsd = second_hand(made(load("2408f"), {.in = tags(1, 17), .out = {24}}));
    ASSERT_THAT(gsd.modules, SizeIs(2));
    EXPECT_EQ(gsd.modules[0].name, "Parameters 1 to 17");
    EXPECT_THAT(gsd.modules[0].identifiers, SizeIs(17));
    EXPECT_EQ(gsd.modules[1].name, "Parameter 18");
    EXPECT_EQ(gsd.number("FixPresetModules"), 1);
    EXPECT_THAT(gsd.cfg(), SizeIs(18));

    EXPECT_THAT(second_hand(made(load("2408f"), {.in = tags(1, 16), .demand = true})).modules, SizeIs(1));
    EXPECT_EQ(second_hand(made(load("2408f"), {.in = tags(1, 17), .demand = true})).modules.at(0).name,
              "Demand Data, parameters 1 to 16");
}

TEST(GsdMake, TakesModelAndDescription)
{
    const auto gsd =
        second_hand(made(load("590"), {.description = "Line 3 \"unwinder\"", .model = "Unwinder"}));
    EXPECT_EQ(gsd.keys.at("Model_Name"), "\"Unwinder\"");
    EXPECT_EQ(gsd.keys.at("Info_Text"), "\"Line 3 'unwinder'\"");
}

TEST(GsdMake, LeavesTheProfilesDescriptionToTheProfilesMapping)
{
    EXPECT_EQ(second_hand(made(load("2408f"), {})).keys.at("Info_Text"), "\"Standard parameter mapping\"");
    EXPECT_FALSE(second_hand(made(load("2408f"), {.in = {1}})).keys.count("Info_Text"));
}

TEST(GsdMake, RaisesMaxTsdrOnlyWhereTheMachineNeedsMore)
{
    const auto gsd = second_hand(made(load("590"), {.max_tsdr = 120}));
    EXPECT_EQ(gsd.number("MaxTsdr_9.6"), 120);
    EXPECT_EQ(gsd.number("MaxTsdr_500"), 120);
    EXPECT_EQ(gsd.number("MaxTsdr_1.5M"), 150);
    EXPECT_FALSE(gsd.keys.count("MaxTsdr_45.45"));
}

TEST(GsdMake, SaysInTheFileWhatMadeIt)
{
    const std::string file = made(load("605"), {.in = {1, 2},
                                                .in_out = {3},
                                                .demand = true,
                                                .ident = 0x1650,
                                                .max_tsdr = 300,
                                                .description = "a b",
                                                .model = "M"});
    EXPECT_THAT(file,
                HasSubstr("; Made for the profile 605 of dpslaved by the command\r\n"
                          "; dpctl gsd make --profile 605 --in 1,2 --in-out 3 --demand --ident 0x1650\r\n"
                          "; --max-tsdr 300 --model \"M\" --description \"a b\"\r\n"));
}

TEST(GsdMake, LeavesOutOfTheCommandWhatTheProfileSaysItself)
{
    EXPECT_EQ(made(load("605"), {.in = {1}, .ident = 0x1649, .model = "SSD Drives 605"}),
              made(load("605"), {.in = {1}}));
    EXPECT_EQ(made(load("2408f"), {.in = {1, 5, 3, 75}, .out = {24, 25, 15, 274}}), made(load("2408f"), {}));
}

TEST(GsdMake, KeepsInputsAndOutputsInTheOrderOfTheList)
{
    using profile::Direction;
    const std::string file =
        made(load("605"),
             {.list = std::vector<profile::GsdParameter>{
                  {Direction::out, 3}, {Direction::in, 1}, {Direction::in_out, 9}, {Direction::out, 2}}});
    const auto gsd = second_hand(file);
    EXPECT_THAT(gsd.octets("User_Prm_Data"), ElementsAre(0, 0, 0, 0, 3, 0, 1, 0, 9, 0, 2));
    EXPECT_THAT(gsd.cfg(), ElementsAre(0x60, 0x50, 0x70, 0x60));
    EXPECT_THAT(file, HasSubstr("--order out:3,in:1,in-out:9,out:2\r\n"));
}

TEST(GsdDraft, HasTheOctetsAlsoWhereTheFileIsRefusedAndNamesTheParameter)
{
    const profile::Draft draft = profile::draft_of(load("2408f"), {.in = {1}, .out = {199}});
    ASSERT_THAT(draft.notes, SizeIs(2));
    EXPECT_EQ(draft.notes[0].code, "ident_missing");
    EXPECT_EQ(draft.notes[0].at, std::nullopt);
    EXPECT_EQ(draft.notes[1].code, "never_written");
    EXPECT_EQ(draft.notes[1].at, 1U);
    EXPECT_THAT(draft.device.user_prm_data, ElementsAre(0, 1, 0, 199));
}

TEST(GsdDraft, OfAnySelectionIsMadeToItsEnd)
{
    using profile::Direction;
    for (const std::string& name : test::kProfiles)
        for (const std::size_t count : {0U, 1U, 12U, 13U, 118U, 119U, 200U, 400U}) {
            const profile::Draft draft = profile::draft_of(
                load(name),
                {.in = tags(1, count), .list = std::vector<profile::GsdParameter>{{Direction::in_out, 0}}});
            EXPECT_THAT(draft.parameters, SizeIs(count + 1)) << name;
        }
}

TEST(GsdMake, NamesTheParametersInComments)
{
    EXPECT_THAT(
        made(load("2408f"), {.in = {1}, .out = {24}}),
        testing::AllOf(HasSubstr("; 1 in tag 1 Process "), HasSubstr("; 2 out tag 24 Setpoint 1\r\n")));
}

TEST(GsdMake, RefusesWhereNoIdentIsKnownAndSaysWhereToFindIt)
{
    for (const char* name : {"584sv", "590plus", "690plus", "2408f", "2404f"}) {
        const auto reasons = refusals(name, {});
        ASSERT_THAT(reasons, SizeIs(1)) << name;
        EXPECT_THAT(reasons[0],
                    testing::AllOf(HasSubstr("has no Ident_Number"), HasSubstr("give that of your device"),
                                   HasSubstr("octets 5 and 6")));
    }
}

TEST(GsdDraft, NamesTheParameterThatTheStationWouldRefuse)
{
    const profile::Draft draft = profile::draft_of(load("590"), {.in = {5, 2048}});
    ASSERT_THAT(draft.notes, SizeIs(1));
    EXPECT_EQ(draft.notes[0].code, "prm_tag_too_large");
    EXPECT_EQ(draft.notes[0].at, 1U);
}

TEST(GsdMake, AllowsTwelveParametersOnAnOptionBoardAndNotThirteen)
{
    EXPECT_THAT(refusals("590", {.in = tags(1, 12), .demand = true}), IsEmpty());
    EXPECT_THAT(refusals("590", {.in = tags(1, 7), .out = tags(8, 6)}),
                ElementsAre(HasSubstr(
                    "Set_Prm would be refused: User_Prm_Data has a wrong length, expected 24 octets of "
                    "User_Prm_Data, got 26")));
}

TEST(GsdMake, AllowsThirtyParametersOnATechnologyBoxAndNotThirtyOne)
{
    EXPECT_THAT(refusals("605", {.in_out = tags(1, 30), .demand = true}), IsEmpty());
    EXPECT_THAT(refusals("605", {.in_out = tags(1, 31)}),
                ElementsAre(HasSubstr("expected 63 octets of User_Prm_Data, got 65")));
}

TEST(GsdMake, Allows117WordsOnAControllerDemandDataIncluded)
{
    EXPECT_THAT(refusals("2408f", {.in = tags(500, 60), .out = tags(1500, 57), .ident = 1}), IsEmpty());
    EXPECT_THAT(refusals("2408f", {.in = tags(500, 60), .out = tags(1500, 58), .ident = 1}),
                Contains(HasSubstr("expected 234 octets of User_Prm_Data, got 236")));
    EXPECT_THAT(refusals("2408f", {.in = tags(500, 55), .out = tags(1500, 54), .demand = true, .ident = 1}),
                IsEmpty());
    EXPECT_THAT(
        refusals("2408f", {.in = tags(500, 55), .out = tags(1500, 55), .demand = true, .ident = 1}),
        ElementsAre(HasSubstr(
            "Chk_Cfg would be refused: Cfg_Data has too many identifiers, octet 111, expected at most 110")));
}

TEST(GsdMake, RefusesTagsThatAreNone)
{
    EXPECT_THAT(refusals("590", {.in = {2048}}),
                ElementsAre(HasSubstr(
                    "a tag in User_Prm_Data is too large, octet 8, expected a tag up to 2047, got 2048")));
    EXPECT_THAT(refusals("590", {.out = {0}}),
                ElementsAre(HasSubstr("more identifiers than User_Prm_Data has tags")));
    EXPECT_THAT(refusals("2408f", {.in = {16384}, .ident = 1}),
                ElementsAre(HasSubstr("expected a tag up to 16383, got 16384")));
}

TEST(GsdMake, RefusesATagTwiceInOneDirectionAndAllowsItInBoth)
{
    EXPECT_THAT(refusals("590", {.in = {5, 5}}), ElementsAre("tag 5 is read twice: remove one."));
    EXPECT_THAT(refusals("605", {.out = {5}, .in_out = {5}}),
                ElementsAre(HasSubstr("tag 5 is written twice")));
    EXPECT_THAT(refusals("590", {.in = {5}, .out = {5}}), IsEmpty());
}

TEST(GsdMake, RefusesBothDirectionsAtOnceWhereTheDeviceHasNoIdentifierForThem)
{
    EXPECT_THAT(refusals("590", {.in_out = {5}}),
                ElementsAre(HasSubstr("choose it once as input and once as output")));
}

TEST(GsdMake, RefusesToWriteWhatMustNeverBeWritten)
{
    EXPECT_THAT(refusals("2408f", {.out = {199}, .ident = 1}),
                ElementsAre(HasSubstr("tag 199 must never be written")));
}

TEST(GsdMake, RefusesAMeasuredValueAsAnOutputAndTakesItAsAnInput)
{
    EXPECT_THAT(refusals("2408f", {.out = {5}, .ident = 1}),
                ElementsAre(HasSubstr("tag 5 (Working setpoint) is read only, so it cannot be an output")));
    EXPECT_THAT(refusals("605", {.in_out = {5}}), IsEmpty());
    EXPECT_THAT(refusals("2408f", {.in = {5}, .ident = 1}), IsEmpty());
}

TEST(GsdMake, RefusesTextsThatDoNotFit)
{
    EXPECT_THAT(refusals("590", {.model = std::string(33, 'm')}),
                ElementsAre(HasSubstr("the model has 33 characters")));
    EXPECT_THAT(refusals("590", {.description = std::string(257, 'd')}),
                ElementsAre(HasSubstr("the description has 257 characters: a GSD has room for 256.")));
    EXPECT_THAT(refusals("590", {.description = std::string(56, 'd'), .model = std::string(32, 'm')}),
                IsEmpty());
}

TEST(GsdMake, RefusesAMaxTsdrThatChangesNothing)
{
    EXPECT_THAT(refusals("590", {.max_tsdr = 60}), ElementsAre(HasSubstr("MaxTsdr 60 is at no rate larger")));
    EXPECT_THAT(refusals("590", {.max_tsdr = 70000}), ElementsAre(HasSubstr("room for 65535")));
}

TEST(GsdMake, ReportsEveryReasonAtOnce)
{
    EXPECT_THAT(refusals("2408f", {.in = {1, 1}, .out = {199}, .model = std::string(40, 'm')}), SizeIs(4));
}

TEST(GsdMake, WarnsOfWhatIsLegalButProbablyNotMeant)
{
    const auto warnings = [](const std::string& name, const Selection& selection) {
        const auto device = device_of(load(name), selection);
        return device ? device->warnings : std::vector<std::string>{"refused"};
    };
    EXPECT_THAT(warnings("590", {}), IsEmpty());
    EXPECT_THAT(warnings("590", {.ident = 0x1234}),
                ElementsAre(HasSubstr("write ident = 0x1234 into the station")));
    EXPECT_THAT(warnings("590", {.max_tsdr = 1001}), ElementsAre(HasSubstr("above 1000 bit times")));
    EXPECT_THAT(warnings("590", {.description = "5 \xE2\x84\xA6"}),
                ElementsAre(HasSubstr("becomes a question mark")));
}

TEST(GsdMake, WarnsOfAnOutputWhoseAccessNoSourceStates)
{
    auto box = load("605");
    box.tags = *profile::read_tags("tag,name,type,access\n7,Known,INT,rw\n8,Open,INT,\n", "own.csv");
    const auto warnings = [&](const Selection& selection) {
        const auto device = device_of(box, selection);
        return device ? device->warnings : std::vector<std::string>{"refused"};
    };
    EXPECT_THAT(warnings({.out = {7}}), IsEmpty());
    EXPECT_THAT(warnings({.in = {8, 9}}), IsEmpty());
    EXPECT_THAT(warnings({.out = {8}}), ElementsAre(HasSubstr("tag 8 (Open) may be read only")));
    EXPECT_THAT(warnings({.in_out = {9}}), ElementsAre(HasSubstr("tag 9 is in no tag table")));
}

/// A profile that was never written as a file: what the maker does is in the data, not in names.
TEST(GsdMake, GoesByTheProfileAlone)
{
    profile::Profile profile = load("590");
    profile.personality.prm.list = dp::TagList::exact;
    profile.personality.prm.min_length = 0;
    EXPECT_THAT(device_of(profile, {}).error(), ElementsAre(HasSubstr("choose tags as inputs and outputs")));

    profile.gsd.in_tags = {7};
    EXPECT_THAT(second_hand(made(profile, {})).octets("User_Prm_Data"), ElementsAre(0, 7));

    profile.personality.demand_identifier = 0;
    EXPECT_THAT(device_of(profile, {.demand = true}).error(), ElementsAre(HasSubstr("has no Demand Data")));

    profile.tags_only_from_table = true;
    EXPECT_THAT(device_of(profile, {.in = {1999}}).error(),
                ElementsAre(HasSubstr("is not in the tag table")));

    profile.personality.prm.list = dp::TagList::none;
    EXPECT_THAT(device_of(profile, {.in = {55}}).error(),
                Contains(HasSubstr("takes no tags from the master")));
}

} // namespace
} // namespace dpslave
