// SPDX-License-Identifier: Apache-2.0
// Records that begin in the middle of a telegram. The telegrams are made by the tests alone.
#include "support/wire.hpp"

#include "dpslave/trace/telegrams.hpp"

#include <gmock/gmock.h>

#include <random>

using namespace dpslave;
using namespace dpslave::trace;
using namespace std::chrono_literals;
using test::Octets;
using What = Entry::What;

namespace {

constexpr std::uint8_t kRate = 4; // 187.5 kbit/s
constexpr Instant kBegin{1s};

/// What was on a bus, read by read.
class Line {
public:
    /// One read with these octets, `pause` behind the one before.
    void hear(const Octets& octets, std::chrono::nanoseconds pause = 500us)
    {
        at_ += pause + duration_of(Tbit{11 * static_cast<std::uint32_t>(octets.size())}, kBauds[kRate]);
        Record record{.head = {.kind = Kind::heard, .rate = kRate, .at = at_}};
        record.octets.assign(octets);
        records.push_back(record);
    }
    void note(Kind kind, std::uint8_t address = 0)
    {
        records.push_back(
            {.head = {.kind = kind, .rate = kRate, .address = address, .at = at_, .begun = at_}});
    }
    void reply(const Octets& octets)
    {
        note(Kind::sent);
        records.back().octets.assign(octets);
    }

    std::vector<Record> records;

private:
    Instant at_ = kBegin;
};

/// The records behind the first `cut` octets heard. `is_inside`: the cut is not between two records.
std::vector<Record> behind(const std::vector<Record>& all, std::size_t cut)
{
    std::vector<Record> rest;
    for (Record record : all) {
        const Bytes octets = record.octets;
        if (cut >= octets.size() && cut > 0) {
            cut -= octets.size();
            continue;
        }
        if (cut > 0) {
            const Bytes end = octets.subspan(std::exchange(cut, 0));
            record.octets.assign(Octets(end.begin(), end.end()));
        }
        rest.push_back(record);
    }
    return rest;
}

std::vector<Entry> entries_of(const std::vector<Record>& records)
{
    Telegrams telegrams{500us};
    for (const Record& record : records) telegrams.add(record);
    if (!records.empty()) telegrams.pass_time(records.back().head.at + 1s);
    std::vector<Entry> all;
    while (auto one = telegrams.take()) all.push_back(*std::move(one));
    return all;
}

testing::AssertionResult is_same(const Entry& one, const Entry& other)
{
    if (one.what != other.what || one.octets != other.octets || one.flaw != other.flaw)
        return testing::AssertionFailure() << "another entry";
    if (one.at != other.at || one.first != other.first || one.last != other.last)
        return testing::AssertionFailure() << "another time";
    return testing::AssertionSuccess();
}

/// The last of `cut` are the last of `all`, as many as there are behind the cut telegram.
void expect_end_of(const std::vector<Entry>& all, const std::vector<Entry>& cut, std::size_t count)
{
    ASSERT_GE(cut.size(), count);
    for (std::size_t i = 1; i <= count; ++i)
        EXPECT_TRUE(is_same(all[all.size() - i], cut[cut.size() - i])) << i << " from the end";
}

const Octets kRequest = test::sd2(5, 2, 0x5D, {0x12, 0x34});
const Octets kReply = test::sd2(2, 5, 0x08, {0x16, 0xE5, 0xDC, 0x10});
const Octets kStatus = test::sd1(7, 2, 0x49);

/// Start-up and exchange of two stations and a second master, in reads that hold more than one telegram, and
/// telegrams in several reads. `damaged` stands in the middle.
std::vector<Record> long_capture(unsigned seed, const Octets& damaged)
{
    std::mt19937 random{seed};
    std::vector<Octets> telegrams;
    for (int i = 0; i < 60; ++i) {
        Octets data(random() % 30 + 1);
        for (std::uint8_t& octet : data) octet = static_cast<std::uint8_t>(random());
        telegrams.push_back(test::sd2(5, 2, i % 2 == 0 ? 0x5D : 0x7D, data));
        telegrams.push_back(i % 3 == 0 ? test::sc() : test::sd2(2, 5, 0x08, data));
        if (i % 4 == 0) telegrams.push_back(test::sd1(7, 2, 0x49));
        if (i % 5 == 0) {
            telegrams.push_back(test::token(3, 2));
            telegrams.push_back(test::token(2, 3));
        }
        if (i == 30) telegrams.push_back(damaged);
    }
    Line line;
    Octets read;
    for (const Octets& telegram : telegrams) {
        const bool is_torn = random() % 3 == 0 && telegram.size() > 1;
        const std::size_t first = is_torn ? 1 + random() % (telegram.size() - 1) : telegram.size();
        read.insert(read.end(), telegram.begin(), telegram.begin() + static_cast<std::ptrdiff_t>(first));
        if (is_torn || random() % 2 == 0) {
            line.hear(read, is_torn ? 100us : 500us);
            read.assign(telegram.begin() + static_cast<std::ptrdiff_t>(first), telegram.end());
            if (is_torn) {
                line.hear(read, 0us);
                read.clear();
            }
        }
    }
    if (!read.empty()) line.hear(read);
    return line.records;
}

/// Of a capture that is cut behind its first `cut` octets. `ends`: of the entries of the whole one.
void expect_cut(const std::vector<Record>& records, const std::vector<Entry>& all,
                const std::vector<std::size_t>& ends, std::size_t cut)
{
    const auto rest = entries_of(behind(records, cut));
    const auto whole = static_cast<std::size_t>(
        std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end > cut; }));
    const bool is_between = cut == 0 || std::find(ends.begin(), ends.end(), cut) != ends.end();
    const Entry& first = all[all.size() - whole];
    ASSERT_EQ(rest.size(), whole);
    expect_end_of(all, rest, is_between ? whole : whole - 1);
    EXPECT_FALSE(rest[0].what == What::piece && first.what != What::piece) << "no flaw is invented";
    const Octets end =
        is_between ? Octets{}
                   : Octets(first.octets.end() - static_cast<std::ptrdiff_t>(ends[all.size() - whole] - cut),
                            first.octets.end());
    if (is_between || test::heard(end)) return; // nothing tells such an end from a whole telegram
    EXPECT_EQ(rest[0].what, What::cut) << test::show(end);
    EXPECT_EQ(rest[0].octets, end);
    EXPECT_EQ(rest[0].last, first.last);
}

TEST(TraceCut, AtEachOctetOfALongCaptureTheRestIsTheSameAndNoFlawIsInvented)
{
    Octets damaged = test::sd2(5, 2, 0x5D, {1, 2, 3});
    damaged[damaged.size() - 2] ^= 0x40;
    for (const unsigned seed : {1U, 2U, 3U}) {
        const std::vector<Record> records = long_capture(seed, damaged);
        const std::vector<Entry> all = entries_of(records);
        std::vector<std::size_t> ends;
        for (const Entry& one : all) ends.push_back((ends.empty() ? 0 : ends.back()) + one.octets.size());
        ASSERT_GT(ends.back(), 1500U);
        ASSERT_EQ(
            std::count_if(all.begin(), all.end(), [](const Entry& one) { return one.what == What::piece; }),
            1);

        for (std::size_t cut = 0; cut + 300 < ends.back(); ++cut) {
            SCOPED_TRACE(testing::Message() << "capture " << seed << ", cut at octet " << cut);
            ASSERT_NO_FATAL_FAILURE(expect_cut(records, all, ends, cut));
        }
    }
}

/// Entries of one read of these octets and a whole telegram.
std::vector<Entry> before_a_request(const Octets& octets)
{
    Line line;
    line.hear(test::joined({octets, kRequest}));
    return entries_of(line.records);
}

TEST(TraceCut, TheEndOfATelegramMayLookLikeOtherTelegrams)
{
    for (const Octets& end : {Octets{0xE5, 0x47, 0x16}, Octets{0xDC, 0x47, 0x16}, Octets{0xA2, 0x16},
                              Octets{0x10, 0x16}, Octets{0x68, 0x05, 0x16}, Octets{0x16, 0x16}, Octets{0x16},
                              Octets{0x10, 1, 2, 3, 4, 0x16}, Octets{0x47, 0x10, 1, 2, 3, 4, 0x16}}) {
        const auto all = before_a_request(end);

        ASSERT_EQ(all.size(), 2U);
        EXPECT_EQ(all[0].what, What::cut);
        EXPECT_EQ(all[0].octets, end);
        EXPECT_EQ(all[1].what, What::telegram);
        EXPECT_EQ(all[1].octets, kRequest);
    }
}

TEST(TraceCut, TheEndOfATokenIsOneOrTwoAddresses)
{
    for (const Octets& end : {Octets{0x02, 0x03}, Octets{0x03}}) {
        const auto all = before_a_request(end);

        ASSERT_EQ(all.size(), 2U);
        EXPECT_EQ(all[0].what, What::cut);
        EXPECT_EQ(all[1].what, What::telegram);
    }
    EXPECT_EQ(before_a_request({0x03, 0x02}).at(0).what, What::piece)
        << "2 goes on, and 3 would have the token";
}

TEST(TraceCut, WholeTelegramsAtTheBeginAreNotCut)
{
    for (const Octets& whole : {test::token(2, 3), test::token(2, 22), test::sc(), kStatus, kReply}) {
        const auto all = before_a_request(whole);

        ASSERT_EQ(all.size(), 2U);
        EXPECT_EQ(all[0].what, What::telegram);
        EXPECT_EQ(all[0].octets, whole);
    }
}

TEST(TraceCut, WhatIsNoEndOfATelegramIsAFlaw)
{
    Octets wrong = kReply;
    wrong[wrong.size() - 2] ^= 1;
    for (const Octets& noise : {Octets{0x00, 0xFF}, Octets{0xFF}, Octets{1, 2, 3, 4, 5, 6}, wrong}) {
        const auto all = before_a_request(noise);

        ASSERT_EQ(all.size(), 2U);
        EXPECT_EQ(all[0].what, What::piece);
        EXPECT_TRUE(all[0].flaw);
        EXPECT_EQ(all[1].octets, kRequest);
    }
}

TEST(TraceCut, AFlawRightBehindTheCutIsStillOne)
{
    Octets wrong = kReply;
    wrong[wrong.size() - 2] ^= 1;
    for (const Octets& flawed : {wrong, Octets{0xFF, 0x00}}) {
        const auto all = before_a_request(test::joined({{0x47, 0x16}, flawed}));

        ASSERT_EQ(all.size(), 3U);
        EXPECT_EQ(all[0].what, What::cut);
        EXPECT_EQ(all[0].octets, (Octets{0x47, 0x16}));
        EXPECT_EQ(all[1].what, What::piece);
        EXPECT_EQ(all[1].octets, flawed);
        EXPECT_TRUE(all[1].flaw);
    }
}

TEST(TraceCut, ABadCharacterInTheBeginIsAFlaw)
{
    Line line;
    line.hear({0x05, 0x02});
    line.note(Kind::bad_character);
    line.hear({0x47, 0x16}, 10ms);
    line.hear(kRequest, 10ms);

    const auto all = entries_of(line.records);

    EXPECT_EQ(all.front().what, What::piece);
    EXPECT_TRUE(all.front().flaw);
    EXPECT_EQ(all.back().octets, kRequest);
}

TEST(TraceCut, TheEndOfARequestIsKnownByOurReplyBehindIt)
{
    Line line;
    line.hear({0x34, 0xAA, 0x16});
    line.reply(kReply);

    const auto all = entries_of(line.records);

    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].what, What::cut);
    EXPECT_EQ(all[1].what, What::reply);
}

TEST(TraceCut, AStumpBehindWhichTheLineFellSilentIsAFlaw)
{
    Line line;
    line.hear({kRequest.begin(), kRequest.begin() + 5});
    line.note(Kind::silence);

    EXPECT_EQ(entries_of(line.records).at(0).flaw, fdl::Flaw::unfinished);
}

TEST(TraceCut, OnBothSidesOfLostRecordsATelegramIsCutAndNoFlaw)
{
    Line line;
    line.hear(test::joined({kStatus, {kRequest.begin(), kRequest.begin() + 6}}));
    line.hear(test::joined({{kReply.end() - 5, kReply.end()}, kStatus}));
    Telegrams telegrams;
    telegrams.add(line.records[0]);
    telegrams.lost(3, kBegin);
    telegrams.add(line.records[1]);

    std::vector<What> what;
    while (const auto one = telegrams.take()) what.push_back(one->what);

    EXPECT_THAT(what, testing::ElementsAre(What::telegram, What::cut, What::lost, What::cut, What::telegram));
}

TEST(TraceCut, WhatStandsBetweenTwoLossesIsCutWhole)
{
    Telegrams telegrams;
    telegrams.lost(3, kBegin);
    Line line;
    line.hear({0x12, 0x34, 0x56});
    telegrams.add(line.records[0]);
    telegrams.lost(2, kBegin);

    EXPECT_EQ(telegrams.take()->what, What::lost);
    EXPECT_EQ(telegrams.take()->what, What::cut);
    EXPECT_EQ(telegrams.take()->what, What::lost);
}

TEST(TraceCut, OctetsThatNeverBecomeATelegramAreAFlawAndNotHeldForEver)
{
    Telegrams telegrams;
    Line line;
    for (int i = 0; i < 60; ++i) {
        line.hear(Octets(10, 0xFF));
        telegrams.add(line.records.back());
    }

    const auto first = telegrams.take();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->what, What::piece);
    EXPECT_EQ(first->flaw, fdl::Flaw::start_delimiter);
}

TEST(TraceCut, WhereItIsKnownThatATelegramBeginsNothingIsCut)
{
    Telegrams telegrams{0us, Telegrams::Begin::at_telegram};
    Line line;
    line.hear(test::joined({{0x47, 0x16}, kRequest}));
    telegrams.add(line.records[0]);

    EXPECT_EQ(telegrams.take()->what, What::piece);
}

} // namespace
