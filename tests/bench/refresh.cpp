// SPDX-License-Identifier: Apache-2.0
/// M6 and M7: poller and client as the drive thread calls them, on a line where only frames and the drive
/// take time.
#include "drive/fake_drive.hpp"
#include "simulated.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/modbus/modbus_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::size_t kParameters = 12;
constexpr std::size_t kCycles = 20;      ///< measured of each line
constexpr nanoseconds kTurnaround = 4ms; ///< of the drive
constexpr std::uint16_t kDemandTag = kParameters;
constexpr std::uint16_t kWord = 1234;       ///< of every tag, with two decimals
constexpr std::string_view kText = "12.34"; ///< the same as EI-ASCII writes it
constexpr std::uint32_t kParityBits = 11;   ///< of a Modbus character: 8E1
constexpr std::string_view kMnemonics = "a0a1a2a3a4a5a6a7a8a9b0b1b2";

drive::TagTable make_table()
{
    std::vector<drive::Tag> rows;
    for (std::uint16_t number = 0; number <= kDemandTag; ++number) {
        drive::Tag tag;
        tag.number = number;
        tag.decimals = 2;
        tag.mnemonic = std::string{kMnemonics.substr(2 * std::size_t{number}, 2)};
        rows.push_back(tag);
    }
    return drive::TagTable{rows};
}

/// A Modbus slave and its line. It answers when it has seen 3.5 characters of silence behind the request,
/// which is how a frame ends (MODBUS over Serial Line V1.02, 2.5.1.1), and its turnaround is over.
class ModbusLine final : public modbus::FrameLine {
public:
    explicit ModbusLine(std::uint32_t baud)
        : character_(std::int64_t{kParityBits} * std::nano::den / baud), words_{}
    {
        words_.fill(kWord);
    }

    Instant time{1h};

    nanoseconds characters(std::size_t count) const { return static_cast<std::int64_t>(count) * character_; }
    nanoseconds pause() const { return character_ * 7 / 2; }

    bool send(std::uint8_t unit, Bytes pdu) override
    {
        answer_.assign(1, unit);
        const unsigned first = be16(pdu, 1);
        if (pdu[0] == 3) {
            answer_.push_back(3);
            answer_.push_back(static_cast<std::uint8_t>(2 * be16(pdu, 3)));
            for (unsigned i = 0; i < be16(pdu, 3); ++i) {
                answer_.push_back(high(words_.at(first + i)));
                answer_.push_back(low(words_.at(first + i)));
            }
        } else if (pdu[0] == 6) {
            words_.at(first) = be16(pdu, 3);
            answer_.insert(answer_.end(), pdu.begin(), pdu.end());
        } else if (pdu[0] == 16) {
            for (unsigned i = 0; i < be16(pdu, 3); ++i) words_.at(first + i) = be16(pdu, 6 + 2 * i);
            answer_.insert(answer_.end(), pdu.begin(), pdu.begin() + 5);
        } else {
            throw std::runtime_error{"a Modbus function that this slave has not"};
        }
        answered_ =
            time + characters(pdu.size() + 3) + pause() + kTurnaround + characters(answer_.size() + 2);
        return true;
    }

    Heard receive(Instant until) override
    {
        if (!answered_ || *answered_ > until) {
            time = std::max(time, until);
            return Heard::silence;
        }
        time = std::max(time, *answered_);
        answered_.reset();
        return Heard::frame;
    }

    Bytes frame() const override { return answer_; }
    Instant now() const override { return time; }

private:
    nanoseconds character_;
    std::array<std::uint16_t, kDemandTag + 1> words_;
    std::vector<std::uint8_t> answer_; ///< unit first, without check sum
    std::optional<Instant> answered_;
};

/// Twelve parameters in Data_Exchange, every second one written, and the orders of Demand Data.
class Refresh {
public:
    Refresh(drive::Backend& backend, bool compares, const Instant& time)
        : backend_(backend), time_(time), poller_(settings(compares), backend.block_rule())
    {
        image_.layout.generation = 1;
        image_.may_write = true;
        for (std::uint16_t tag = 0; tag < kParameters; ++tag)
            image_.layout.parameters[image_.layout.count++] = {tag, tag % 2 == 0, tag % 2 != 0};
        image_.words.fill(kWord);
        poller_.set_outputs(0, image_);
    }

    void order(std::uint32_t number)
    {
        poller_.set_demand(0, {DemandOrder::Kind::read, kDemandTag, 0, number, image_.layout.generation});
    }
    /// Of the newest order: it is on its way to the master.
    bool is_answered(std::uint32_t number)
    {
        while (const auto answer = poller_.take_demand_answer(0)) answered_ = answer->number;
        return answered_ == number;
    }

    /// One transaction, or the wait for it; what it took.
    nanoseconds step(Instant& clock)
    {
        const Instant began = time_;
        const auto next = poller_.next(began);
        if (!next) {
            clock = std::max(clock, poller_.next_deadline());
            return 0ns;
        }
        words_.resize(next->count);
        const AccessError error = next->kind == drive::Transaction::Kind::read
                                      ? backend_.read({0, 1}, *next->tag, words_)
                                      : backend_.write({0, 1}, *next->tag, next->words);
        if (error != AccessError::none) throw std::runtime_error{backend_.last_trouble()};
        poller_.done({error, words_, backend_.last_answer()}, time_);
        return time_ - began;
    }
    nanoseconds cycle() const { return poller_.snapshot(0).cycle; }

private:
    std::vector<drive::UnitSettings> settings(bool compares) const
    {
        drive::UnitSettings unit;
        unit.tags = &table_;
        unit.output_refresh = 0ns; // every parameter in every cycle
        unit.compare_outputs = compares;
        return {unit};
    }

    const drive::TagTable table_ = make_table();
    drive::Backend& backend_;
    const Instant& time_;
    drive::Poller poller_;
    OutputImage image_;
    std::vector<std::uint16_t> words_;
    std::uint32_t answered_ = 0;
};

/// The cycle of each of kCycles rounds / what frames and turnarounds of it take.
std::vector<double> cycles(Refresh& refresh, Instant& clock, nanoseconds by_formula)
{
    std::vector<double> ratios;
    for (nanoseconds before{}; ratios.size() < kCycles + 2; before = refresh.cycle()) {
        const Instant began = clock;
        while (refresh.cycle() == before && clock - began < 2 * by_formula) refresh.step(clock);
        ratios.push_back(static_cast<double>(refresh.cycle().count()) /
                         static_cast<double>(by_formula.count()));
    }
    ratios.erase(ratios.begin(), ratios.begin() + 2); // the first reads and writes everything once
    return ratios;
}

struct EiAscii {
    explicit EiAscii(std::uint32_t baud)
        : line(baud), client(line, {.baud = baud}, {{{0, 1}, drive::MnemonicRule::none}})
    {
        line.drives = {&drive};
        drive.turnaround = kTurnaround;
        for (std::size_t at = 0; at < kMnemonics.size(); at += 2)
            drive.parameters[std::string{kMnemonics.substr(at, 2)}].text = kText;
    }

    drive::test::FakeDrive drive{'0', '1'};
    drive::test::SimulatedLine line;
    drive::EiAsciiClient client;
};

Row refresh_row(std::string line, std::vector<double> ratios)
{
    return {.id = "M6",
            .metric = fmt::format("refresh cycle / wire time, {}, simulated clock", line),
            .limit = 1.02,
            .blocks = std::move(ratios)};
}

/// EOT, address and two letters frame the text of a value (EI-ASCII reference, section 1).
nanoseconds ei_ascii_cycle(const drive::test::SimulatedLine& line)
{
    constexpr std::size_t kPoll = 8, kValue = 5 + kText.size(), kSelect = 10 + kText.size(), kAck = 1;
    constexpr std::size_t kOfTwo = kPoll + kValue + kSelect + kAck; // one read, one written
    return kParameters / 2 * (static_cast<std::int64_t>(kOfTwo) * line.character() + 2 * kTurnaround);
}

} // namespace

std::vector<Row> measure_refresh(nlohmann::json& curves)
{
    std::vector<Row> rows;
    nlohmann::json& shown = curves["refresh"] = nlohmann::json::array();
    const auto add = [&](const std::string& line, nanoseconds by_formula, std::vector<double> ratios) {
        const double ms = std::chrono::duration<double, std::milli>{by_formula}.count();
        rows.push_back(refresh_row(line, std::move(ratios)));
        shown.push_back(
            {{"line", line + ", simulated clock"}, {"wire_ms", ms}, {"cycle_ms", ms * rows.back().ratio()}});
    };
    {
        EiAscii drive{9600};
        Refresh refresh{drive.client, false, drive.line.time};
        const nanoseconds by_formula = ei_ascii_cycle(drive.line);
        add("12 parameters EI-ASCII 9600", by_formula, cycles(refresh, drive.line.time, by_formula));
    }
    for (const std::uint32_t baud : {9600U, 19200U}) {
        ModbusLine line{baud};
        modbus::ModbusClient client{
            line, {.baud = baud, .bits_of_a_character = kParityBits, .rules = {}, .units = {}}};
        Refresh refresh{client, true, line.time};
        constexpr std::size_t kRequest = 8, kAnswer = 5 + 2 * kParameters;
        const nanoseconds by_formula = line.characters(kRequest + kAnswer) + 2 * line.pause() + kTurnaround;
        add(fmt::format("12 registers Modbus {}", baud), by_formula, cycles(refresh, line.time, by_formula));
    }
    return rows;
}

/// One order in each round at most, each at any moment: more than that is for the rounds behind it.
Row measure_demand_data(bool quick)
{
    const std::size_t orders = quick ? 20 : 500;
    EiAscii drive{38'400};
    Refresh refresh{drive.client, false, drive.line.time};
    Instant& clock = drive.line.time;
    nanoseconds longest{};
    while (refresh.cycle() == 0ns) longest = std::max(longest, refresh.step(clock));
    const nanoseconds round = refresh.cycle();
    std::mt19937_64 random{1};
    Row row{.id = "M7",
            .metric = "Demand Data read, p99 of order to answer / longest transaction, under full refresh",
            .limit = 2.2};
    std::uint32_t number = 0;
    for (std::size_t block = 0; block < (quick ? 1 : kBlocks); ++block) {
        std::vector<double> took;
        while (took.size() < orders) {
            auto wait = std::uniform_int_distribution<std::int64_t>{round.count(), 2 * round.count()};
            const Instant ordered = clock + nanoseconds{wait(random)};
            while (clock < ordered) refresh.step(clock);
            refresh.order(++number); // fetched behind the transaction that was under way
            while (!refresh.is_answered(number)) refresh.step(clock);
            took.push_back(static_cast<double>((clock - ordered).count()) /
                           static_cast<double>(longest.count()));
        }
        std::sort(took.begin(), took.end());
        row.blocks.push_back(took[took.size() * 99 / 100]);
    }
    return row;
}

} // namespace dpslave::bench
