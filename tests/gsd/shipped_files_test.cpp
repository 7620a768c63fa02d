// SPDX-License-Identifier: Apache-2.0
// The files in gsd/ are those that the command makes, octet for octet, and no other.
#include "second_hand.hpp"

#include "dpslave/gsd/type_file.hpp"
#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

#include <set>

namespace dpslave {
namespace {

using test::content_of;
using test::kSource;
using testing::IsEmpty;

class ShippedGsd : public testing::TestWithParam<const char*> {
protected:
    const profile::Profile profile_ = test::load(GetParam());
    const std::string content_ = content_of(kSource / "gsd" / GetParam() / profile_.gsd.file);
};

TEST_P(ShippedGsd, IsWhatTheCommandMakes)
{
    EXPECT_EQ(content_, test::made(profile_, {}))
        << "make it again: dpctl gsd make --profile " << GetParam()
        << " --profiles config/profiles --force --output gsd/" << GetParam() << '/' << profile_.gsd.file;
}

TEST_P(ShippedGsd, IsLikedByAStrictReaderWithItsName)
{
    EXPECT_THAT(test::findings_of(content_, gsd::Reading::strict, profile_.gsd.file), IsEmpty());
}

TEST_P(ShippedGsd, IsPlainAsciiWithCrLfAndANameThatDosCanHold)
{
    for (std::size_t i = 0; i < content_.size(); ++i) {
        EXPECT_LT(static_cast<unsigned char>(content_[i]), 0x7F) << i;
        if (content_[i] == '\n') {
            EXPECT_EQ(content_[i - 1], '\r') << i;
        }
    }
    EXPECT_EQ(profile_.gsd.file.size(), 12U);
    EXPECT_EQ(profile_.gsd.file.substr(8), ".GSD");
}

INSTANTIATE_TEST_SUITE_P(Gsd, ShippedGsd, testing::Values("584s", "590", "620", "605"),
                         [](const auto& one) { return "Of" + std::string{one.param}; });

TEST(ShippedFiles, AreAllThoseOfProfilesWithAKnownIdentAndNoneBeside)
{
    std::set<std::string> wanted{"README.md", "manual/584s-590/EURO0533.GSD", "manual/620/EURO0533.GSD",
                                 "mappings/gain-scheduling.toml"};
    for (const std::string& name : io::names_in(kSource / "config/profiles", ".toml"))
        if (const profile::Profile profile = test::load(name); profile.ident)
            wanted.insert(name + '/' + profile.gsd.file);
    for (const gsd::TypeFile& file : gsd::type_files(gsd::TypeName::printed))
        wanted.insert("et200/" + file.name);
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator{kSource / "gsd"})
        if (entry.is_regular_file())
            found.insert(std::filesystem::relative(entry.path(), kSource / "gsd").string());
    EXPECT_EQ(found, wanted);
}

TEST(ProfilesOfTheseTests, AreAllThatAreShipped)
{
    EXPECT_THAT(io::names_in(kSource / "config/profiles", ".toml"),
                testing::UnorderedElementsAreArray(test::kProfiles));
}

TEST(ShippedTypeFiles, AreWhatTheCommandMakes)
{
    for (const gsd::TypeFile& file : gsd::type_files(gsd::TypeName::printed))
        EXPECT_EQ(content_of(kSource / "gsd/et200" / file.name), file.content) << file.name;
}

} // namespace
} // namespace dpslave
