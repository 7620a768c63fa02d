// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/wire_form.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace dpslave::trace;
using testing::ElementsAreArray;

namespace {

/// As the table of the document has it.
const std::vector<std::uint8_t> kForm{
    2,    0,   2, 3, 4, 5, 1, 0, // length, kind, detail, rate, address, flags
    7,    0,   0, 0, 0, 0, 0, 0, // number
    8,    1,   0, 0, 0, 0, 0, 0, // at, ns
    9,    0,   0, 0, 0, 0, 0, 0, // begun, ns
    0xE5, 0x16};

Record record()
{
    Record one{.head = {.kind = Kind::sent,
                        .detail = 3,
                        .rate = 4,
                        .more_follows = true,
                        .address = 5,
                        .at = Instant{std::chrono::nanoseconds{264}},
                        .begun = Instant{std::chrono::nanoseconds{9}}},
               .number = 7};
    one.octets.assign(std::vector<std::uint8_t>{0xE5, 0x16});
    return one;
}

TEST(TraceWireForm, IsThatOfTheDocument)
{
    std::vector<std::uint8_t> octets;
    append(record(), octets);

    EXPECT_THAT(octets, ElementsAreArray(kForm));
}

TEST(TraceWireForm, GivesTheRecordBack)
{
    std::vector<std::uint8_t> two = kForm;
    two.insert(two.end(), kForm.begin(), kForm.end());
    Bytes rest = two;

    const auto one = take_record(rest);

    ASSERT_TRUE(one);
    EXPECT_EQ(rest.size(), kForm.size());
    EXPECT_EQ(one->head.kind, Kind::sent);
    EXPECT_EQ(one->head.detail, 3);
    EXPECT_EQ(one->head.rate, 4);
    EXPECT_EQ(one->head.address, 5);
    EXPECT_TRUE(one->head.more_follows);
    EXPECT_EQ(one->number, 7U);
    EXPECT_EQ(one->head.at, record().head.at);
    EXPECT_EQ(one->head.begun, record().head.begun);
    EXPECT_EQ(one->octets, record().octets);
}

TEST(TraceWireForm, WhatIsCutOffOrImpossibleIsNone)
{
    const auto is_one = [](std::vector<std::uint8_t> octets) {
        Bytes rest = octets;
        const bool found = take_record(rest).has_value();
        EXPECT_TRUE(found || rest.size() == octets.size());
        return found;
    };
    const auto with = [](std::size_t at, std::uint8_t value) {
        std::vector<std::uint8_t> octets = kForm;
        octets[at] = value;
        return octets;
    };

    for (std::size_t length = 0; length < kForm.size(); ++length)
        EXPECT_FALSE(is_one({kForm.begin(), kForm.begin() + static_cast<std::ptrdiff_t>(length)})) << length;
    EXPECT_FALSE(is_one(with(1, 0xFF))) << "more octets than a record has";
    EXPECT_FALSE(is_one(with(2, kKinds)));
    EXPECT_FALSE(is_one(with(4, 7))) << "a rate that PROFIBUS does not have";
    EXPECT_FALSE(is_one(with(7, 1)));
}

} // namespace
