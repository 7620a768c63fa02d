// SPDX-License-Identifier: Apache-2.0
/// M6: refresh cycles against the time that their frames take.
#include "drive_side.hpp"
#include "simulated.hpp"

#include "dpslave/modbus/modbus_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::size_t kCycles = 20;       ///< measured of each line
constexpr std::uint32_t kParityBits = 11; ///< of a Modbus character: 8E1

/// A Modbus slave and its line. It answers when it has seen 3.5 characters of silence behind the request,
/// which is how a frame ends (MODBUS over Serial Line V1.02, 2.5.1.1), and its turnaround is over.
class ModbusLine final : public modbus::ModbusPort {
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
    std::array<std::uint16_t, kDemandTag + 1> words_; ///< by tag
    std::vector<std::uint8_t> answer_;                ///< unit first, without checksum
    std::optional<Instant> answered_;
};

/// Twelve parameters in Data_Exch, every second one written.
OutputImage full_refresh()
{
    OutputImage image;
    image.layout.generation = 1;
    image.may_write = true;
    for (std::uint16_t tag = 1; tag <= kParameters; ++tag) {
        const std::size_t place = image.layout.count++;
        image.layout.parameters[place] = {tag, !is_written(place), is_written(place)};
    }
    image.words.fill(kWord);
    return image;
}

/// The cycle of each of kCycles rounds / what frames and turnarounds of it take.
std::vector<double> cycles(DriveSide& side, const Instant& clock, nanoseconds by_formula)
{
    side.poller().set_outputs(0, full_refresh());
    std::vector<double> ratios;
    for (nanoseconds before{}; ratios.size() < kCycles + 2; before = side.cycle()) {
        const Instant limit = clock + 2 * by_formula;
        while (side.cycle() == before && clock < limit) side.step(limit);
        ratios.push_back(static_cast<double>(side.cycle().count()) / static_cast<double>(by_formula.count()));
    }
    ratios.erase(ratios.begin(), ratios.begin() + 2); // the first reads and writes everything once
    return ratios;
}

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
        EiAsciiDrive drive{9600};
        DriveSide side{drive.client, drive.line.time, false};
        const nanoseconds by_formula = ei_ascii_cycle(drive.line);
        add("12 parameters EI-ASCII 9600", by_formula, cycles(side, drive.line.time, by_formula));
    }
    for (const std::uint32_t baud : {9600U, 19200U}) {
        ModbusLine line{baud};
        modbus::ModbusClient client{
            line, {.baud = baud, .bits_of_a_character = kParityBits, .rules = {}, .units = {}}};
        DriveSide side{client, line.time, true};
        constexpr std::size_t kRequest = 8, kAnswer = 5 + 2 * kParameters;
        const nanoseconds by_formula = line.characters(kRequest + kAnswer) + 2 * line.pause() + kTurnaround;
        add(fmt::format("12 registers read, Modbus {}", baud), by_formula,
            cycles(side, line.time, by_formula));
    }
    return rows;
}

} // namespace dpslave::bench
