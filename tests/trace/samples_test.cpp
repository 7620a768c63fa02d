// SPDX-License-Identifier: Apache-2.0
// Records of a ring of samples, octet by octet, and what is none.
#include "dpslave/trace/samples.hpp"

#include <gmock/gmock.h>

#include <thread>

using namespace dpslave;
using namespace dpslave::trace;
using testing::ElementsAre;

namespace {

constexpr Instant kAt{std::chrono::seconds{5}};

Layout layout_of(Generation generation, std::initializer_list<LayoutEntry> parameters)
{
    Layout layout;
    layout.generation = generation;
    for (const LayoutEntry& one : parameters) layout.parameters[layout.count++] = one;
    return layout;
}

Record only(const Ring& ring)
{
    Ring::Reader reader{ring};
    Record record;
    EXPECT_TRUE(reader.next(record));
    return record;
}

std::vector<std::uint8_t> octets(const Record& record)
{
    const Bytes all = record.octets;
    return {all.begin(), all.end()};
}

Record record_of(std::initializer_list<std::uint8_t> octets)
{
    Record record;
    record.octets.assign(Bytes{octets.begin(), octets.size()});
    return record;
}

TEST(Samples, OfALayoutHaveItsTagsAndWays)
{
    Ring ring{Ring::kLeast};
    put_layout(ring, 7, layout_of(0x01020304, {{55, true, false}, {0x1256, false, true}}), kAt);

    const Record record = only(ring);
    EXPECT_EQ(record.head.at, kAt);
    EXPECT_THAT(octets(record), ElementsAre(0, 2, 0, 0, 0, 7, 1, 2, 3, 4, 0, 55, 1, 0x12, 0x56, 2));
    const auto sample = sample_of(record);
    ASSERT_TRUE(sample);
    EXPECT_TRUE(sample->is_layout);
    EXPECT_EQ(sample->of, (SampleOf{7, 0x01020304}));
    ASSERT_EQ(sample->count, 2);
    EXPECT_EQ(sample->parameters[0], (LayoutEntry{55, true, false}));
    EXPECT_EQ(sample->parameters[1], (LayoutEntry{0x1256, false, true}));
}

TEST(Samples, OfValuesHaveWordsAndStates)
{
    Ring ring{Ring::kLeast};
    const std::array<std::uint16_t, 3> words{0x1234, 0xFFFF, 0};
    const std::array<WordState, 3> states{WordState::good, WordState::stale, WordState::refused};
    put_values(ring, {7, 9}, {words, states, true}, kAt);

    const Record record = only(ring);
    EXPECT_THAT(octets(record),
                ElementsAre(2, 3, 0, 0, 0, 7, 0, 0, 0, 9, 0x12, 0x34, 0xFF, 0xFF, 0, 0, 0x21, 7));
    const auto sample = sample_of(record);
    ASSERT_TRUE(sample);
    EXPECT_FALSE(sample->is_layout);
    EXPECT_TRUE(sample->has_ended);
    EXPECT_EQ(sample->words[1], 0xFFFF);
    EXPECT_EQ(sample->states[0], WordState::good);
    EXPECT_EQ(sample->states[1], WordState::stale);
    EXPECT_EQ(sample->states[2], WordState::refused);
}

TEST(Samples, OfTheLargestLayoutFitIntoARecord)
{
    Ring ring{Ring::kLeast};
    Layout layout = layout_of(1, {});
    layout.count = kMaxParameters;
    for (std::size_t i = 0; i < kMaxParameters; ++i)
        layout.parameters[i] = {static_cast<std::uint16_t>(i), true, true};
    put_layout(ring, 1, layout, kAt);

    const auto sample = sample_of(only(ring));
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->count, kMaxParameters);
    EXPECT_EQ(sample->parameters[kMaxParameters - 1].tag, kMaxParameters - 1);
}

TEST(Samples, AreNotMadeOfOtherOctets)
{
    EXPECT_FALSE(sample_of(record_of({})));
    EXPECT_FALSE(sample_of(record_of({0, 0, 0, 0, 0, 7, 0, 0, 0}))) << "a head is longer";
    EXPECT_FALSE(sample_of(record_of({3, 0, 0, 0, 0, 7, 0, 0, 0, 9}))) << "there is no such kind";
    EXPECT_FALSE(sample_of(record_of({0, 1, 0, 0, 0, 7, 0, 0, 0, 9, 0, 55}))) << "half a parameter";
    EXPECT_FALSE(sample_of(record_of({0, 1, 0, 0, 0, 7, 0, 0, 0, 9, 0, 55, 4}))) << "a third way";
    EXPECT_FALSE(sample_of(record_of({1, 1, 0, 0, 0, 7, 0, 0, 0, 9, 0, 55, 9}))) << "an unknown state";
    EXPECT_FALSE(sample_of(record_of({1, 118, 0, 0, 0, 7, 0, 0, 0, 9}))) << "too many parameters";
    EXPECT_TRUE(sample_of(record_of({1, 0, 0, 0, 0, 7, 0, 0, 0, 9}))) << "no parameter at all";
}

TEST(Samples, AreWholeOrAbsentForAReaderOfAnotherThread)
{
    Ring ring{Ring::kLeast};
    constexpr std::uint16_t kLast = 60'000;
    std::thread writer{[&ring] {
        for (std::uint32_t i = 0; i <= kLast; ++i) {
            const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(i),
                                                     static_cast<std::uint16_t>(~i)};
            const std::array<WordState, 2> states{WordState::good, WordState::good};
            put_values(ring, {1, i}, {words, states, false}, kAt);
        }
    }};
    Ring::Reader reader{ring};
    Record record;
    std::uint64_t seen = 0;
    for (std::uint32_t newest = 0; newest != kLast;) {
        if (!reader.next(record)) continue;
        const auto sample = sample_of(record);
        ASSERT_TRUE(sample);
        newest = sample->of.generation;
        ASSERT_EQ(sample->words[0], static_cast<std::uint16_t>(newest));
        ASSERT_EQ(sample->words[1], static_cast<std::uint16_t>(~newest));
        ++seen;
    }
    writer.join();
    // The reader began at the oldest record of then; what it missed before is in no count.
    EXPECT_LE(seen + reader.lost(), kLast + 1U);
    EXPECT_GT(seen, 0U);
}

} // namespace
