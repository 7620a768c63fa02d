// SPDX-License-Identifier: Apache-2.0
// Telegrams that are damaged: C-03 and C-04.
#include "case.hpp"

#include <functional>

namespace conformance {
namespace {

using test::kUs;
using test::sd1;
using test::sd2;

/// Each request of a start-up, as the owner sends it to a slave in Data_Exch. The frame count bit is not
/// valid: an undamaged one would be carried out.
std::vector<Octets> requests(const Bench& b)
{
    return {
        sd1(kUs, 2, 0x49),
        sd2(kUs, 2, 0x6D, Saps{60, 62}),
        sd2(kUs, 2, 0x6D, Saps{59, 62}),
        sd2(kUs, 2, 0x6D, Saps{61, 62}, b.prm({.status = 0x40})), // unlock
        sd2(kUs, 2, 0x6D, Saps{62, 62}, {0x50}),                  // another configuration
        sd2(kUs, 2, 0x6D, words({0x0101, 0x0202, 0x0303, 0x0404})),
        sd2(kUs, 2, 0x6D, Saps{57, 62}),
    };
}

/// Sends each damaged form of each request. After each the slave is silent, and the next good request is
/// answered; at the end nothing has changed.
void damage(Bench& b, const std::function<std::vector<Octets>(const Octets&)>& forms)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    for (const Octets& good : requests(b))
        for (const Octets& damaged : forms(good)) {
            EXPECT_TRUE(b.slave.is_silent_to(damaged));
            ASSERT_EQ(b.owner.rd_outp(), dl({1, 2, 3, 4})) << "after " << test::show(damaged);
        }
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
    EXPECT_EQ(b.foreign.rd_outp(), dl({5, 6, 7, 8}));
}

void C03_InvertedBits(Bench& b)
{
    damage(b, [](const Octets& good) {
        std::vector<Octets> all;
        for (std::size_t i = 0; i < good.size(); ++i)
            for (unsigned bit = 0; bit < 8; ++bit) {
                all.push_back(good);
                all.back()[i] = static_cast<std::uint8_t>(good[i] ^ (1u << bit));
            }
        return all;
    });
}

void C03_MissingOctets(Bench& b)
{
    damage(b, [](const Octets& good) {
        std::vector<Octets> all;
        for (std::size_t i = 0; i < good.size(); ++i) {
            all.push_back(good);
            all.back().erase(all.back().begin() + static_cast<std::ptrdiff_t>(i));
        }
        return all;
    });
}

/// Not the first octet of an SD2 telegram: that is one octet of noise before a telegram that is whole. Not
/// the end delimiter: it stands behind a telegram that is whole, and comes while the reply begins.
void C03_DoubledOctets(Bench& b)
{
    damage(b, [](const Octets& good) {
        std::vector<Octets> all;
        for (std::size_t i = good[0] == 0x68 ? 1 : 0; i + 1 < good.size(); ++i) {
            all.push_back(good);
            all.back().insert(all.back().begin() + static_cast<std::ptrdiff_t>(i), good[i]);
        }
        return all;
    });
}

/// A request whose header announces `le`, with the right FCS and ED.
Octets with_le(std::uint8_t le, std::uint8_t repeated, std::size_t data)
{
    const Octets inner = sd2(kUs, 2, 0x6D, Octets(std::max<std::size_t>(data, 1), 0));
    Octets all{0x68, le, repeated, 0x68, kUs, 2, 0x6D};
    all.insert(all.end(), data, 0);
    all.push_back(inner[inner.size() - 2]); // zeros do not change the sum
    all.push_back(0x16);
    return all;
}

void C04_BrokenTelegrams(Bench& b)
{
    const Octets good = sd2(kUs, 2, 0x6D, Saps{60, 62});
    const auto with = [&](std::size_t at, std::uint8_t octet) {
        Octets wrong = good;
        wrong.at(at) = octet;
        return wrong;
    };
    const Octets status = sd1(kUs, 2, 0x49);
    const std::vector<Octets> all{
        with_le(5, 4, 2),       // LE and LEr differ
        with_le(4, 5, 1),       //
        with_le(3, 3, 0),       // LE is too small, all else is right
        with_le(2, 2, 0),       //
        with_le(250, 250, 247), // too large, likewise
        with_le(255, 255, 252), //
        with(3, 0x10),          // the repeated start delimiter
        with(3, 0x16),          //
        with(good.size() - 2, static_cast<std::uint8_t>(good[good.size() - 2] + 1)), // FCS
        with(good.size() - 2, 0x00),                                                 //
        with(good.size() - 1, 0x68),                                                 // no end delimiter
        with(good.size() - 1, 0x00),                                                 //
        Octets(good.begin(), good.end() - 1),                                        //
        {0x10, kUs, 2, 0x49, 0x51, 0x16},                                            // the same of SD1
        {0x10, kUs, 2, 0x49, 0x50, 0x10},                                            //
        Octets(status.begin(), status.end() - 1),                                    //
        {0x90, kUs, 2, 0x49, 0x50, 0x16},                                            // no start delimiter
        sd2(kUs | 0x80, 2 | 0x80, 0x6D, Octets{60}),   // an extension octet is missing
        sd2(kUs | 0x80, 2 | 0x80, 0x6D, {0x7C, 0x3E}), // it is no SAP
    };
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    for (const Octets& broken : all) {
        EXPECT_TRUE(b.slave.is_silent_to(broken));
        EXPECT_EQ(b.owner.rd_outp(), dl({1, 2, 3, 4})) << "after " << test::show(broken);
    }
    EXPECT_EQ(b.diag(), kExchanging);
}

} // namespace

void add_corruption_cases(std::vector<Case>& all)
{
    all.push_back(
        {.name = "C03_InvertedBits",
         .asks = "Each bit of each request inverted: silence, no change, the next request is answered",
         .run = C03_InvertedBits});
    all.push_back({.name = "C03_MissingOctets",
                   .asks = "Each octet of each request left out: likewise",
                   .run = C03_MissingOctets});
    all.push_back({.name = "C03_DoubledOctets",
                   .asks = "Each octet of each request sent twice: likewise",
                   .run = C03_DoubledOctets});
    all.push_back(
        {.name = "C04_BrokenTelegrams",
         .asks = "LE and LEr differ, LE out of 4 to 249, wrong delimiter, FCS, ED or extension: silence",
         .run = C04_BrokenTelegrams});
}

} // namespace conformance
