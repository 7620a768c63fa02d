// SPDX-License-Identifier: Apache-2.0
/// Answers of Modbus drives: the receiver of frames, and the client on a line where any frame comes at any
/// time. Judged: a frame is what was heard, with a right checksum; a value is only taken from an answer of
/// this unit with this function and length that was heard in this call; a write counts only by the answer
/// to it.
#include "input.hpp"
#include "modbus/frame_receiver.hpp"

#include "dpslave/modbus/modbus_client.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <utility>
#include <vector>

namespace {

using namespace dpslave;
using namespace std::chrono_literals;
using drive::Tag;
using drive::TagType;
using drive::UnitAddress;
using fuzz::demand;
using Octets = std::vector<std::uint8_t>;

/// The checksum of MODBUS, bit by bit: over octets and their own checksum it is 0.
std::uint16_t check(const Octets& octets)
{
    unsigned sum = 0xFFFF;
    for (const std::uint8_t octet : octets)
        for (unsigned bit = 0, mixed = sum ^= octet; bit < 8; ++bit, mixed = sum)
            sum = (mixed & 1) != 0 ? (mixed >> 1) ^ 0xA001 : mixed >> 1;
    return static_cast<std::uint16_t>(sum);
}

unsigned word_at(const Octets& octets, std::size_t at)
{
    return octets[at] * 256u + octets[at + 1];
}

void judge_receiver(fuzz::Input& input)
{
    modbus::FrameReceiver receiver;
    Octets since_silence;
    std::size_t behind_fault = 0; // the place behind the last bad character of them
    bool is_broken = false;
    while (!input.at_end()) {
        const std::uint8_t form = input.octet();
        if (form % 8 == 0) {
            receiver.silence();
            since_silence.clear();
            behind_fault = 0;
            is_broken = false;
            continue;
        }
        if (form % 8 == 1) {
            is_broken |= receiver.fault() == modbus::FrameReceiver::Found::broken;
            since_silence.push_back(0);
            behind_fault = since_silence.size();
            continue;
        }
        if (form % 8 == 2) {
            receiver.sent(input.octet(), input.octets(1 + form % 7));
            continue;
        }
        const auto some = input.octets(1 + form % 13);
        Octets octets{some.begin(), some.end()};
        if (form % 2 == 0) {
            const std::uint16_t sum = check(octets);
            octets.push_back(sum & 0xFF);
            octets.push_back(static_cast<std::uint8_t>(sum >> 8));
        }
        for (const std::uint8_t octet : octets) {
            since_silence.push_back(octet);
            const auto found = receiver.feed(octet);
            demand(found != modbus::FrameReceiver::Found::frame || !is_broken,
                   "behind something broken there is no frame before the line was silent");
            is_broken |= found == modbus::FrameReceiver::Found::broken;
            if (found != modbus::FrameReceiver::Found::frame) continue;
            const Bytes frame = receiver.frame();
            demand(frame.size() >= 2 && frame.size() + 2 <= since_silence.size(), "a frame has its length");
            demand(frame.size() + 2 <= since_silence.size() - behind_fault, "no bad character is in a frame");
            const Octets with_sum{since_silence.end() - static_cast<std::ptrdiff_t>(frame.size() + 2),
                                  since_silence.end()};
            demand(std::ranges::equal(frame, Bytes{with_sum}.first(frame.size())),
                   "a frame is what was heard");
            demand(check(with_sum) == 0, "a frame has its checksum");
        }
    }
}

/// The other end: which frame comes to a request, and when, comes from the input. Time passes only here.
class Line final : public modbus::ModbusPort {
public:
    explicit Line(fuzz::Input& input) : input_(input) {}

    std::vector<Octets> heard; ///< frames given since the begin of the call
    std::vector<Octets> asked; ///< since then

    bool send(std::uint8_t unit, Bytes pdu) override
    {
        Octets request{unit};
        request.insert(request.end(), pdu.begin(), pdu.end());
        asked.push_back(request);
        if (input_.at_end()) return true;
        const std::uint8_t form = input_.octet();
        if ((form & 15) == 15) return false;
        for (Octets& frame : answers_to(request, form & 15))
            pending_.push_back(
                {std::move(frame), now_ + std::chrono::milliseconds{(form >> 4) * (form >> 4) * 20}});
        return true;
    }
    Heard receive(Instant until) override
    {
        if (pending_.empty() || pending_.front().second > until) {
            now_ = std::max(now_, until);
            return Heard::silence;
        }
        now_ = std::max(now_, pending_.front().second);
        frame_ = pending_.front().first;
        pending_.pop_front();
        if (frame_.size() < 2) return frame_.empty() ? Heard::gone : Heard::broken;
        heard.push_back(frame_);
        return Heard::frame;
    }
    Bytes frame() const override { return frame_; }
    Instant now() const override { return now_; }
    void pass(std::chrono::nanoseconds time) { now_ += time; }

private:
    Octets made(std::uint8_t unit, std::uint8_t function, std::size_t octets)
    {
        Octets frame{unit, function, static_cast<std::uint8_t>(octets)};
        const auto some = input_.octets(octets);
        frame.insert(frame.end(), some.begin(), some.end());
        frame.resize(3 + octets);
        return frame;
    }
    std::vector<Octets> answers_to(const Octets& request, int form)
    {
        const std::uint8_t unit = request[0], function = request[1];
        const Octets answer = function <= 4   ? made(unit, function, 2 * (word_at(request, 4) % 126))
                              : function == 8 ? request
                                              : Octets{request.begin(), request.begin() + 6};
        switch (form) {
            case 0: return {};
            case 1: return {{unit, static_cast<std::uint8_t>(function | 0x80), input_.octet()}};
            case 2: return {{static_cast<std::uint8_t>(unit ^ 1), function, 2, 0, 7}};
            case 3: return {made(unit, function, input_.octet() % 16)};
            case 4: return {request};
            case 5: return {request, answer};
            case 6: {
                const auto raw = input_.octets(input_.octet() % 16);
                return {Octets{raw.begin(), raw.end()}};
            }
            case 7: return {made(unit, static_cast<std::uint8_t>(input_.octet() % 20), 2)};
            case 8: return {answer, made(unit, function, answer.size() - 3)};
            case 9: {
                Octets other = answer;
                other[input_.octet() % other.size()] ^= static_cast<std::uint8_t>(1 << input_.octet() % 8);
                return {other};
            }
            default: return {answer};
        }
    }

    fuzz::Input& input_;
    Instant now_{std::chrono::seconds{100}};
    std::deque<std::pair<Octets, Instant>> pending_;
    Octets frame_;
};

Tag row_of(fuzz::Input& input)
{
    const std::uint8_t kind = input.octet();
    Tag tag;
    tag.number = static_cast<std::uint16_t>(1 + kind % 3);
    tag.type = (kind & 4) != 0 ? TagType::word : TagType::number;
    tag.decimals = tag.type == TagType::number ? kind >> 4 & 3 : 0;
    if ((kind & 0x48) == 0x48) { // two registers of the IEEE area
        tag.modbus_register = static_cast<std::uint16_t>(0x8000 + 2 * tag.number);
        tag.is_real = tag.type == TagType::number;
    }
    return tag;
}

/// Is `word` what the two registers of the IEEE area say? The single is within half a count of the word, and
/// a little more: ties are judged by its decimal form.
bool says(const Tag& tag, const Octets& frame, std::uint16_t word)
{
    if (!tag.is_real) return word_at(frame, 3) == word;
    const std::uint32_t bits = word_at(frame, 3) * 65536u + word_at(frame, 5);
    float single = 0;
    std::memcpy(&single, &bits, sizeof single);
    const double counts = static_cast<double>(single) * std::pow(10.0, tag.decimals);
    const double value = tag.is_unsigned ? word : static_cast<double>(static_cast<std::int16_t>(word));
    return std::abs(counts - value) <= 0.5 + std::abs(counts) * 1e-6;
}

/// A frame of this call that answers a read of `count` registers from `first` on, and says `words`.
bool was_shown(const Line& line, std::uint8_t unit, const Tag& tag, std::span<const std::uint16_t> words)
{
    const bool pair = tag.modbus_register.has_value();
    const std::size_t registers = pair ? 2 : words.size();
    return std::ranges::any_of(line.heard, [&](const Octets& frame) {
        if (frame.size() != 3 + 2 * registers || frame[0] != unit || (frame[1] != 3 && frame[1] != 4) ||
            frame[2] != 2 * registers)
            return false;
        if (pair) return says(tag, frame, words[0]);
        for (std::size_t i = 0; i < words.size(); ++i)
            if (word_at(frame, 3 + 2 * i) != words[i]) return false;
        return true;
    });
}

bool was_taken(const Line& line, std::uint8_t unit, unsigned first)
{
    return std::ranges::any_of(line.heard, [&](const Octets& frame) {
        return frame.size() == 6 && frame[0] == unit && (frame[1] == 6 || frame[1] == 16) &&
               word_at(frame, 2) == first;
    });
}

void judge_client(fuzz::Input& input)
{
    constexpr auto kLongest =
        20s; // some exchanges of 600 ms, and the line that has to fall silent before them
    Line line{input};
    modbus::ClientSettings settings;
    settings.rules.echo = static_cast<EchoMode>(input.octet() % 3);
    settings.units = {{.unit = 1, .reads_by_4 = true, .has_loopback = true}, {.unit = 2}};
    modbus::ModbusClient client{line, settings};
    for (int calls = 0; calls < 24 && !input.at_end(); ++calls) {
        const std::uint8_t what = input.octet();
        const UnitAddress unit{0, static_cast<std::uint8_t>(1 + (what >> 4 & 1))};
        const Tag tag = row_of(input);
        const Instant began = line.now();
        line.heard.clear();
        line.asked.clear();
        std::array<std::uint16_t, 3> words{input.word(), input.word(), 7};
        const bool is_block = !tag.modbus_register && (what & 0x40) != 0;
        const std::span<std::uint16_t> some{words.data(), is_block ? words.size() : 1};
        switch (what % 4) {
            case 0:
            case 1:
                if (client.read(unit, tag, some) == AccessError::none)
                    demand(was_shown(line, unit.unit, tag, some), "a value that is read stands in a frame");
                break;
            case 2:
                if (client.write(unit, tag, some) == AccessError::none) {
                    demand(!line.asked.empty(), "a write that counts was sent");
                    demand(was_taken(line, unit.unit, tag.modbus_register.value_or(tag.number)),
                           "a write that counts has its answer");
                }
                break;
            default:
                if (client.probe(unit) == AccessError::none)
                    demand(std::ranges::any_of(line.heard,
                                               [&](const auto& frame) { return frame[0] == unit.unit; }),
                           "a drive that is there was heard");
                break;
        }
        demand(line.now() - began < kLongest, "a call ends");
        line.pass(std::chrono::milliseconds{(what & 0x0C) * 100});
        if ((what & 0x20) != 0) client.listen();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Input input{data, size};
    if (input.octet() % 4 == 0)
        judge_receiver(input);
    else
        judge_client(input);
    return 0;
}
