// SPDX-License-Identifier: Apache-2.0
// Mapping files: several for one instrument are a site's library (C-045).
#include "second_hand.hpp"

#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using profile::load_mapping;
using test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MappingFile, SaysAllThatTheCommandLineCan)
{
    const Folder folder;
    const auto mapping =
        load_mapping(io::read_regular_file,
                     folder.write("m.toml", "profile = \"605\"\nin = [1, 2]\nout = [3]\nin_out = [4]\n"
                                            "demand = true\nident = 0x1234\nmax_tsdr = 400\n"
                                            "description = \"d\"\nmodel = \"m\"\n"
                                            "[table]\nfile = \"mine.csv\"\nrows = \"tag\\n7\"\n"));
    ASSERT_TRUE(mapping);
    EXPECT_EQ(mapping->profile, "605");
    EXPECT_THAT(mapping->selection.in, ElementsAre(1, 2));
    EXPECT_THAT(mapping->selection.out, ElementsAre(3));
    EXPECT_THAT(mapping->selection.in_out, ElementsAre(4));
    EXPECT_TRUE(mapping->selection.demand);
    EXPECT_EQ(mapping->selection.ident, 0x1234);
    EXPECT_EQ(mapping->selection.max_tsdr, 400U);
    EXPECT_EQ(mapping->selection.description, "d");
    EXPECT_EQ(mapping->selection.model, "m");
    EXPECT_EQ(mapping->table, (profile::OwnTable{"mine.csv", "tag\n7"}));
}

TEST(MappingFile, NeedsNothingButTheProfile)
{
    const Folder folder;
    const auto mapping = load_mapping(io::read_regular_file, folder.write("m.toml", "profile = \"590\"\n"));
    ASSERT_TRUE(mapping);
    EXPECT_THAT(mapping->selection.in, IsEmpty());
    EXPECT_FALSE(mapping->selection.demand);
    EXPECT_EQ(mapping->selection.ident, std::nullopt);
}

TEST(MappingFile, WithAnEmptyListSaysThatThereIsNoParameter)
{
    const Folder folder;
    const auto silent = load_mapping(io::read_regular_file, folder.write("s.toml", "profile = \"2408f\"\n"));
    const auto empty =
        load_mapping(io::read_regular_file, folder.write("e.toml", "profile = \"2408f\"\nlist = []\n"));
    ASSERT_TRUE(silent && empty);
    EXPECT_FALSE(silent->selection.says_parameters());
    EXPECT_TRUE(empty->selection.says_parameters());
    EXPECT_THAT(empty->selection.parameters(), IsEmpty());
}

TEST(MappingFile, HasAListWhoseDirectionsMayAlternate)
{
    using profile::Direction, profile::GsdParameter;
    const Folder folder;
    const auto mapping = load_mapping(
        io::read_regular_file,
        folder.write("m.toml", "profile = \"605\"\nlist = [\"out:3\", \"in:1\", \"in-out:65535\"]\n"));
    ASSERT_TRUE(mapping);
    EXPECT_THAT(mapping->selection.parameters(),
                ElementsAre(GsdParameter{Direction::out, 3}, GsdParameter{Direction::in, 1},
                            GsdParameter{Direction::in_out, 65535}));
}

TEST(MappingFile, HasNoListBesideInAndOutAndNoOtherWordsInIt)
{
    const Folder folder;
    const auto both = load_mapping(
        io::read_regular_file, folder.write("b.toml", "profile = \"605\"\nlist = [\"in:1\"]\nout = [2]\n"));
    ASSERT_FALSE(both);
    EXPECT_THAT(test::short_forms(both.error()),
                ElementsAre(HasSubstr("'out' and 'list' both name parameters: keep one of them.")));
    for (const char* word : {"", "in", "in:", "in:0", "in:65536", "in: 1", "IN:1", "in_out:1", "1", "in:1 "})
        EXPECT_FALSE(profile::parse_parameter(word)) << word;
}

TEST(MappingFile, IsRefusedWithEveryFaultAtItsPlace)
{
    const Folder folder;
    const auto mapping =
        load_mapping(io::read_regular_file, folder.write("m.toml", "in = [0]\nident = 70000\ncolour = 5\n"));
    ASSERT_FALSE(mapping);
    const auto faults = test::short_forms(mapping.error());
    EXPECT_THAT(faults, testing::Contains(HasSubstr("'profile' is missing")));
    EXPECT_THAT(faults, testing::Contains(testing::StartsWith("1:")));
    EXPECT_THAT(faults, testing::Contains(testing::StartsWith("2:")));
    EXPECT_THAT(faults, testing::Contains(HasSubstr("colour")));
    EXPECT_FALSE(load_mapping(io::read_regular_file, folder.path() / "not there.toml"));
}

} // namespace
} // namespace dpslave
