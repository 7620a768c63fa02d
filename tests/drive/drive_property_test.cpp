// SPDX-License-Identifier: Apache-2.0
/// Poller, client and drive together on a line with faults: the last value of the master is never lost, with
/// outputs that are refreshed and with outputs that are compared, whatever the ride through its loss.
#include "consistent.hpp"
#include "fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/poller.hpp"

#include <gtest/gtest.h>

#include <random>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;
using test::Fault;

constexpr std::array<int, 5> kTags{100, 101, 102, 103, 104};
constexpr std::size_t kUnits = 2;

TagTable make_table()
{
    std::vector<Tag> rows;
    for (const int number : kTags) {
        Tag tag;
        tag.number = static_cast<std::uint16_t>(number);
        tag.type = number == 104 ? TagType::word : TagType::number;
        tag.decimals = static_cast<std::uint8_t>(number - 100);
        rows.push_back(tag);
    }
    return TagTable{rows};
}

/// Mnemonics of tags 100 to 104 on an AC drive, by hand: 2*36+28 = 100.
constexpr std::array<const char*, 5> kMnemonics{"2s", "2t", "2u", "2v", "2w"};

/// The counts of a text as the drive holds it, by the second hand.
std::uint16_t counts_in(const FakeDrive& drive, std::size_t tag)
{
    const std::string& text = drive.parameters.at(kMnemonics[tag]).text;
    if (tag == 4) return static_cast<std::uint16_t>(std::stoul(text.substr(1), nullptr, 16));
    double value = std::stod(text);
    for (std::size_t i = 0; i < tag; ++i) value *= 10;
    return static_cast<std::uint16_t>(static_cast<int>(value < 0 ? value - 0.5 : value + 0.5));
}

/// What the master of one drive wants, and what it should find in the end.
struct Master {
    OutputImage image;
    std::array<std::optional<std::uint16_t>, 5> last; ///< nothing: never written
    Generation generation = 0;
};

class DriveLine {
public:
    DriveLine(unsigned seed, bool compare) : random_(seed), compare_(compare), table_(make_table())
    {
        line_.drives = {&drives_[0], &drives_[1]};
        for (FakeDrive& drive : drives_)
            for (std::size_t i = 0; i < kTags.size(); ++i)
                drive.parameters[kMnemonics[i]].text = i == 4 ? ">0001" : "1.";
        DriveSettings one, two;
        one.tags = two.tags = &table_;
        one.compare_outputs = two.compare_outputs = compare;
        one.output_refresh = two.output_refresh = 3600s; // no refresh to help
        two.address = {0, 1};
        poller_.emplace(std::vector{one, two}, client_.block_rule());
    }

    void live_through(int events)
    {
        for (int i = 0; i < events; ++i) {
            happen();
            run(std::chrono::milliseconds{pick(400)});
        }
        for (FakeDrive& drive : drives_) drive.alive = true;
        for (FakeDrive& drive : drives_) drive.faults.clear();
        run(30s); // a lost drive is probed every 8 s at last, a word that was not kept is repeated ever later
    }

    void expect_nothing_lost()
    {
        for (std::size_t unit = 0; unit < kUnits; ++unit)
            for (std::size_t tag = 0; tag < kTags.size(); ++tag)
                if (masters_[unit].last[tag]) {
                    EXPECT_EQ(counts_in(drives_[unit], tag), *masters_[unit].last[tag])
                        << "drive " << unit << " tag " << kTags[tag];
                }
    }

    const DriveSnapshot& seen(std::size_t unit) const { return poller_->snapshot(unit); }

private:
    unsigned pick(unsigned below) { return static_cast<unsigned>(random_() % below); }

    void happen()
    {
        const std::size_t unit = pick(kUnits);
        switch (pick(14)) {
            case 0: enter(unit); break;
            case 1: leave(unit); break;
            case 2: drives_[unit].alive = false; break;
            case 3: power_cycle(unit); break;
            case 4: drives_[unit].faults.push_back(Fault::lost_answer); break;
            case 5: drives_[unit].faults.push_back(static_cast<Fault>(pick(8))); break;
            case 6: drives_[unit].alive = true; break;
            case 7: poller_->set_zero_after(unit, std::chrono::milliseconds{pick(3000)}); break;
            case 8: turn_the_panel(unit); break;
            default: change(unit); break;
        }
    }

    void enter(std::size_t unit)
    {
        if (masters_[unit].image.layout.generation != 0) leave(unit);
        Master& master = masters_[unit];
        master.image = {};
        master.image.layout.generation = ++master.generation;
        for (const int tag : kTags) {
            const unsigned use = pick(4);
            if (use == 0) continue;
            LayoutEntry& parameter = master.image.layout.parameters[master.image.layout.count++];
            parameter = {static_cast<std::uint16_t>(tag), (use & 1) != 0, use >= 2};
        }
        poller_->set_outputs(unit, master.image);
    }

    void leave(std::size_t unit)
    {
        Master& master = masters_[unit];
        if (master.image.layout.generation == 0) return;
        poller_->left_data_exchange(unit, {master.generation});
        if (master.image.may_write)
            for_outputs(master,
                        [&master](std::size_t, std::size_t tag) { master.last[tag] = std::uint16_t{0}; });
        if (pick(2) == 0) poller_->set_outputs(unit, master.image); // the mailbox still held it
        master.image = {};
        poller_->set_outputs(unit, master.image);
        if (pick(2) == 0)
            poller_->left_data_exchange(unit, {master.generation}); // it is called again and again
    }

    void change(std::size_t unit)
    {
        Master& master = masters_[unit];
        if (master.image.layout.generation == 0) return enter(unit);
        master.image.may_write = true;
        for_outputs(master, [&](std::size_t place, std::size_t tag) {
            if (pick(2) == 0)
                master.image.words[place] =
                    static_cast<std::uint16_t>(pick(4) == 0 ? pick(3) : pick(0x10000));
            master.last[tag] = master.image.words[place];
        });
        poller_->set_outputs(unit, master.image);
    }

    /// A change at the front panel; only a compared output is overridden.
    void turn_the_panel(std::size_t unit)
    {
        const std::size_t tag = pick(kTags.size());
        if (compare_ && outputs_now(unit, tag))
            drives_[unit].parameters[kMnemonics[tag]].text = tag == 4 ? ">0007" : "7.";
    }

    /// The drive comes back with its old settings, long enough away to be noticed.
    void power_cycle(std::size_t unit)
    {
        drives_[unit].alive = false;
        run(3s);
        for (std::size_t i = 0; i < kTags.size(); ++i)
            if (outputs_now(unit, i)) drives_[unit].parameters[kMnemonics[i]].text = i == 4 ? ">0001" : "1.";
        drives_[unit].alive = true;
    }

    bool outputs_now(std::size_t unit, std::size_t tag)
    {
        bool writes = false;
        if (masters_[unit].image.may_write)
            for_outputs(masters_[unit], [&](std::size_t, std::size_t t) { writes = writes || t == tag; });
        return writes;
    }

    template <class What>
    static void for_outputs(const Master& master, What what)
    {
        for (std::size_t i = 0; i < master.image.layout.count; ++i)
            if (master.image.layout.parameters[i].writes)
                what(i, static_cast<std::size_t>(master.image.layout.parameters[i].tag - kTags[0]));
    }

    void run(std::chrono::nanoseconds duration)
    {
        const Instant end = line_.time + duration;
        while (line_.time < end) {
            const auto next = poller_->next(line_.time);
            if (!next) {
                line_.time = std::min(end, std::max(line_.time + 1us, poller_->next_deadline()));
                continue;
            }
            const UnitAddress address{0, static_cast<std::uint8_t>(next->unit)};
            std::uint16_t word = 0;
            AccessError error = AccessError::none;
            switch (next->kind) {
                case Transaction::Kind::read: error = client_.read(address, *next->tag, {&word, 1}); break;
                case Transaction::Kind::write: error = client_.write(address, *next->tag, next->words); break;
                case Transaction::Kind::probe: error = client_.probe(address); break;
            }
            poller_->done({error, {&word, 1}}, line_.time);
            ASSERT_TRUE(test::is_consistent(poller_->snapshot(next->unit)));
        }
    }

    std::mt19937 random_;
    bool compare_;
    TagTable table_;
    test::SimulatedLine line_;
    std::array<FakeDrive, kUnits> drives_{FakeDrive{'0', '0'}, FakeDrive{'0', '1'}};
    EiAsciiClient client_{line_, {}, {{{0, 0}, MnemonicRule::ac}, {{0, 1}, MnemonicRule::ac}}};
    std::optional<Poller> poller_;
    std::array<Master, kUnits> masters_;
};

class LastValueOfTheMaster : public testing::TestWithParam<unsigned> {
protected:
    static void is_never_lost(bool compare)
    {
        for (unsigned i = 0; i < 12; ++i) {
            DriveLine line{GetParam() * 1000 + i, compare};
            line.live_through(60);
            line.expect_nothing_lost();
            ASSERT_FALSE(HasFailure()) << "seed " << GetParam() * 1000 + i;
            EXPECT_TRUE(line.seen(0).answers);
            EXPECT_TRUE(line.seen(1).answers);
        }
    }
};

TEST_P(LastValueOfTheMaster, IsNeverLost)
{
    is_never_lost(false);
}
TEST_P(LastValueOfTheMaster, IsNeverLostWhereOutputsAreCompared)
{
    is_never_lost(true);
}
INSTANTIATE_TEST_SUITE_P(Seeds, LastValueOfTheMaster, testing::Range(1u, 13u));

} // namespace
} // namespace dpslave::drive
