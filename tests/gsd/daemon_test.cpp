// SPDX-License-Identifier: Apache-2.0
// The daemon accepts exactly what `dpctl gsd make` wrote (C-048): a master that goes by the file is accepted,
// one that deviates by one octet is not. What the master sends is taken from the file by the master of dpsim,
// which shares nothing with the project's own reader.
#include "dpsim/master/gsd_station.hpp"
#include "second_hand.hpp"

#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/set_prm.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using Octets = std::vector<std::uint8_t>;
using profile::Selection;

/// What a master does with the file.
struct Master {
    Octets prm; ///< Set_Prm: seven octets, then User_Prm_Data
    Octets cfg;

    explicit Master(const std::string& gsd, const std::vector<std::string>& modules = {})
    {
        auto telegrams = sim::gsd_telegrams(gsd, modules);
        EXPECT_TRUE(telegrams) << (telegrams ? "" : telegrams.error());
        if (!telegrams) return;
        prm = std::move(telegrams->set_prm);
        cfg = std::move(telegrams->chk_cfg);
    }
};

/// The layout that the daemon takes; nothing if it refuses one of the two.
std::optional<dp::Configuration> accepted(const dp::Personality& personality, const Octets& prm,
                                          const Octets& cfg)
{
    const auto parameters = dp::check_set_prm(personality, prm);
    if (!parameters) return std::nullopt;
    const auto configuration = dp::check_chk_cfg(personality, parameters->tags(), cfg);
    return configuration ? std::optional{*configuration} : std::nullopt;
}

struct Case {
    std::string profile;
    const char* name;
    Selection selection;
};
void PrintTo(const Case& one, std::ostream* out)
{
    *out << one.profile << one.name;
}

class Daemon : public testing::TestWithParam<Case> {
protected:
    Daemon()
    {
        profile::Profile profile = test::load(GetParam().profile);
        master_.emplace(test::made(profile, GetParam().selection));
        personality_ = profile.personality;
        personality_.ident = profile.ident.value_or(test::kOwnIdent); // as the station says it
    }

    bool accepts(const Octets& prm, const Octets& cfg) const
    {
        return accepted(personality_, prm, cfg).has_value();
    }
    bool is_identifier(std::uint8_t octet) const
    {
        for (const dp::Identifier& each : personality_.identifiers)
            if (each.form[0] == octet) return true;
        return false;
    }

    std::optional<Master> master_;
    dp::Personality personality_;
};

TEST_P(Daemon, AcceptsWhatTheFileSaysAndTakesTheTagsInTheirOrder)
{
    const auto taken = accepted(personality_, master_->prm, master_->cfg);
    ASSERT_TRUE(taken);
    const Selection& selection = GetParam().selection;
    EXPECT_EQ(taken->demand, selection.demand);
    std::vector<LayoutEntry> wanted;
    for (const std::uint16_t tag : selection.in) wanted.push_back({tag, true, false});
    for (const std::uint16_t tag : selection.out) wanted.push_back({tag, false, true});
    for (const std::uint16_t tag : selection.in_out) wanted.push_back({tag, true, true});
    ASSERT_EQ(taken->layout.count, wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(taken->layout.parameters[i], wanted[i]) << i;
    const std::size_t demand = selection.demand ? 8 : 0;
    EXPECT_EQ(taken->in_length, demand + 2 * (selection.in.size() + selection.in_out.size()));
    EXPECT_EQ(taken->out_length, demand + 2 * (selection.out.size() + selection.in_out.size()));
}

TEST_P(Daemon, RefusesAnotherIdent)
{
    for (const std::size_t octet : {std::size_t{4}, std::size_t{5}})
        for (int bit = 0; bit < 8; ++bit) {
            Octets prm = master_->prm;
            prm[octet] = static_cast<std::uint8_t>(prm[octet] ^ 1U << bit);
            EXPECT_FALSE(accepts(prm, master_->cfg)) << octet << '.' << bit;
        }
}

TEST_P(Daemon, RefusesAnOctetMoreOrLessOfUserPrmData)
{
    Octets prm = master_->prm;
    prm.push_back(0);
    EXPECT_FALSE(accepts(prm, master_->cfg));
    prm.resize(master_->prm.size() - 1);
    if (master_->prm.size() > dp::kPrmHeader) {
        EXPECT_FALSE(accepts(prm, master_->cfg));
    }
}

TEST_P(Daemon, RefusesATagThatIsMissingAmongThem)
{
    const std::size_t count = master_->cfg.size() - (GetParam().selection.demand ? 1 : 0);
    for (std::size_t i = 0; i < count; ++i) {
        Octets prm = master_->prm;
        const std::size_t at = dp::kPrmHeader + personality_.prm.tags_at + 2 * i;
        prm[at] = prm[at + 1] = 0;
        EXPECT_FALSE(accepts(prm, master_->cfg)) << i;
    }
}

TEST_P(Daemon, RefusesAnIdentifierMoreOrLess)
{
    Octets cfg = master_->cfg;
    cfg.push_back(personality_.identifiers.at(0).form[0]);
    EXPECT_FALSE(accepts(master_->prm, cfg));
    for (std::size_t i = 0; i < master_->cfg.size(); ++i) {
        cfg = master_->cfg;
        cfg.erase(cfg.begin() + static_cast<std::ptrdiff_t>(i));
        const bool only_demand_is_missing = GetParam().selection.demand && i == 0 && !cfg.empty();
        EXPECT_EQ(accepts(master_->prm, cfg), only_demand_is_missing)
            << i; // Demand Data is the master's choice
    }
}

TEST_P(Daemon, RefusesEveryOctetThatIsNoIdentifierOfTheDevice)
{
    for (std::size_t i = 0; i < master_->cfg.size(); ++i)
        for (unsigned octet = 0; octet < 256; ++octet) {
            Octets cfg = master_->cfg;
            cfg[i] = static_cast<std::uint8_t>(octet);
            const bool demand_place = i == 0 && GetParam().selection.demand;
            const bool legal = demand_place ? octet == personality_.demand_identifier : is_identifier(cfg[i]);
            EXPECT_EQ(accepts(master_->prm, cfg), legal) << i << ": " << octet;
        }
}

std::vector<Case> cases()
{
    std::vector<Case> out;
    for (const std::string& profile : test::kProfiles) {
        out.push_back({profile, "InAndOut", {.in = {11, 1127}, .out = {13}}});
        out.push_back({profile, "WithDemandData", {.in = {11}, .out = {13, 2047}, .demand = true}});
        out.push_back({profile, "DemandDataAlone", {.demand = true}});
        out.push_back({profile,
                       "AsManyAsAnOptionBoardHas",
                       {.in = test::tags(100, 6), .out = test::tags(1500, 6), .demand = true}});
    }
    for (const char* profile : {"2408f", "2404f"}) { // without tags they have their own mapping, EURD2400
        for (Case& one : out)
            if (one.profile == profile && std::string{one.name} == "DemandDataAlone")
                one = {profile, "EURD2400", {.in = {1, 5, 3, 75}, .out = {24, 25, 15, 274}, .demand = true}};
        out.push_back({profile, "GainScheduling", {.in = {1}, .out = {6, 8, 9, 18, 17}}});
        out.push_back({profile,
                       "With117Words",
                       {.in = test::tags(500, 54), .out = test::tags(1500, 55), .demand = true}});
    }
    for (const char* profile : {"584sv", "590plus", "605", "690plus"}) {
        out.push_back(
            {profile, "BothWays", {.in = {271}, .out = {269}, .in_out = {270, 255}, .demand = true}});
        out.push_back({profile,
                       "With30Parameters",
                       {.in = test::tags(1, 10),
                        .out = test::tags(20, 10),
                        .in_out = test::tags(40, 10),
                        .demand = true}});
    }
    return out;
}

INSTANTIATE_TEST_SUITE_P(And, Daemon, testing::ValuesIn(cases()), [](const auto& one) {
    return "TheMasterOf" + test::case_name(one.param.profile) + one.param.name;
});

/// A file whose modules the master's tool puts together is accepted once tags and modules agree in number.
TEST(DaemonAndModularFile, AcceptEachOtherWhenTagsAndModulesAgree)
{
    for (const char* name : {"584s", "590", "620", "605"}) {
        const profile::Profile profile = test::load(name);
        const std::string gsd = test::content_of(test::kSource / "gsd" / name / profile.gsd.file);
        const Master with_demand{gsd, {"#1"}};
        EXPECT_TRUE(accepted(profile.personality, with_demand.prm, with_demand.cfg))
            << name << ": as it comes, with Demand Data alone";

        const Master with_words{gsd, {"#1", "#2", "#3"}};
        Octets prm = with_words.prm;
        const std::size_t at = dp::kPrmHeader + profile.personality.prm.tags_at;
        prm[at + 1] = 55;
        prm[at + 3] = 56;
        EXPECT_EQ(with_words.cfg, (Octets{0x73, 0x50, 0x60}));
        EXPECT_TRUE(accepted(profile.personality, prm, with_words.cfg)) << name;
        EXPECT_FALSE(accepted(profile.personality, prm, {0x73, 0x50})) << name;
    }
}

} // namespace
} // namespace dpslave
