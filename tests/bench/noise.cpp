// SPDX-License-Identifier: Apache-2.0
/// M11: layer 2 behind a UART that samples bit by bit, 8E1 with parity on both sides, at 187.5 kbit/s.
#include "simulated.hpp"
#include "support/wire.hpp"

#include "dpslave/fdl/layer2.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace dpslave::bench {
namespace {

using test::Octets;

constexpr Baud kBaud = Baud::k187_5;
constexpr std::uint8_t kStation = 5, kMaster = 2;
constexpr std::size_t kOutputs = 8;
constexpr std::size_t kBitsOfACharacter = 11;
constexpr std::size_t kSyn = 33; ///< T_SYN
constexpr std::size_t kSlot = 400;

/// Takes what arrives and answers 32 octets.
class User final : public fdl::SapUser {
public:
    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override
    {
        taken.assign(request.data.begin(), request.data.end());
        reply.append(std::array<std::uint8_t, 32>{});
        return fdl::Answer::low;
    }
    void sdn(const fdl::Indication&) override {}
    void heard(std::uint8_t, Instant) override {}
    Tbit min_tsdr() const override { return Tbit{11}; }
    fdl::Supervision supervision() const override { return fdl::Supervision::owned; }
    void on_time(Instant) override {}
    Instant next_deadline() const override { return kNever; }

    Octets taken; ///< the outputs executed last
};

/// The line as levels of one bit time each; idle is 1. Some bits flip.
class Wire {
public:
    explicit Wire(std::mt19937_64& random, double error_rate) : random_(random), flips_(error_rate) {}

    void idle(std::size_t bits)
    {
        for (std::size_t i = 0; i < bits; ++i) push(true);
    }
    /// An octet with a wrong parity bit, or without its stop bit.
    void bad_character(std::uint8_t octet, bool stops)
    {
        character(octet);
        levels_[levels_.size() - (stops ? 2 : 1)].flip();
    }
    void character(std::uint8_t octet)
    {
        push(false);
        bool parity = false;
        for (int bit = 0; bit < 8; ++bit) {
            const bool level = (octet >> bit & 1) != 0;
            parity = parity != level;
            push(level);
        }
        push(parity);
        push(true);
    }
    /// True: no bit of it has flipped.
    bool telegram(const Octets& octets)
    {
        const std::size_t before = flipped_;
        for (const std::uint8_t octet : octets) character(octet);
        return flipped_ == before;
    }
    std::vector<bool> take() { return std::exchange(levels_, {}); }

private:
    void push(bool level)
    {
        const bool flips = flips_(random_);
        flipped_ += flips ? 1 : 0;
        levels_.push_back(level != flips);
    }

    std::mt19937_64& random_;
    std::bernoulli_distribution flips_;
    std::size_t flipped_ = 0;
    std::vector<bool> levels_;
};

/// Station, UART and clock.
class Receiver {
public:
    Receiver()
    {
        station_.attach(kStation, user,
                        {Tbit{60}, Tbit{60}, Tbit{60}, Tbit{60}, Tbit{60}, Tbit{100}, Tbit{150}});
    }

    User user;

    /// The levels of the line, then silence for a slot time. The octets of the reply; nothing: there is none.
    std::optional<Octets> hear(const std::vector<bool>& levels)
    {
        const Instant begin = now_;
        const auto level = [&levels](std::size_t at) { return at >= levels.size() || levels[at]; };
        for (std::size_t at = 0; at < levels.size(); ++at) {
            if (level(at)) continue; // no start bit
            std::uint8_t octet = 0;
            bool parity = level(at + 9);
            for (std::size_t bit = 0; bit < 8; ++bit) {
                octet = static_cast<std::uint8_t>(octet | (level(at + 1 + bit) ? 1U : 0U) << bit);
                parity = parity != level(at + 1 + bit);
            }
            at += kBitsOfACharacter - 1; // the stop bit
            pass_until(begin + bits(at + 1));
            if (parity || !level(at))
                station_.on_character_error(now_);
            else
                station_.on_bytes(Bytes{&octet, 1}, now_);
            while (!level(at)) ++at; // it was none: the next character begins behind the idle line
        }
        const Instant end = begin + bits(levels.size());
        pass_until(end);
        reply_.reset(); // nothing may be answered before its end
        pass_until(end + bits(kSlot));
        return reply_;
    }

private:
    static std::chrono::nanoseconds bits(std::size_t count)
    {
        return duration_of(Tbit{static_cast<std::uint32_t>(count)}, kBaud);
    }
    void pass_until(Instant until)
    {
        for (;;) {
            station_.on_time(now_);
            if (const auto octets = station_.take_transmit()) reply_.emplace(octets->begin(), octets->end());
            const Instant next = station_.next_deadline();
            if (next > until) break;
            now_ = std::max(now_ + std::chrono::nanoseconds{1}, next);
        }
        now_ = std::max(now_, until);
        station_.on_time(now_);
    }

    fdl::Layer2 station_{{.baud = kBaud, .search = {}, .start_up_latency = {}}};
    Instant now_{std::chrono::seconds{1000}};
    std::optional<Octets> reply_;
};

/// A master that repeats a request until it is answered.
class Master {
public:
    explicit Master(std::mt19937_64& random) : random_(random) { renew(); }

    const Octets& request() const { return request_; }
    const Octets& outputs() const { return outputs_; }
    void answered()
    {
        fc_ = fc_ == 0x5D ? 0x7D : 0x5D;
        renew();
    }

private:
    void renew()
    {
        outputs_.resize(kOutputs);
        for (std::uint8_t& octet : outputs_) octet = static_cast<std::uint8_t>(random_());
        request_ = test::sd2(kStation, kMaster, fc_, outputs_);
    }

    std::mt19937_64& random_;
    std::uint8_t fc_ = 0x6D;
    Octets outputs_, request_;
};

/// Octets of any kind: noise, the beginning of a telegram, one without its end, bad characters.
void garbage(Wire& wire, std::mt19937_64& random, const Octets& telegram)
{
    const auto below = [&random](std::size_t limit) { return random() % limit; };
    const std::size_t kind = below(5);
    if (kind == 0)
        for (std::size_t n = 1 + below(40); n > 0; --n) wire.character(static_cast<std::uint8_t>(random()));
    if (kind == 1) { // the head of a long telegram
        const auto length = static_cast<std::uint8_t>(4 + below(246));
        for (const std::uint8_t octet : {std::uint8_t{0x68}, length, length, std::uint8_t{0x68}})
            wire.character(octet);
        for (std::size_t n = below(length); n > 0; --n) wire.character(static_cast<std::uint8_t>(random()));
    }
    if (kind == 2)
        wire.telegram({telegram.begin(),
                       telegram.begin() + static_cast<std::ptrdiff_t>(1 + below(telegram.size() - 1))});
    if (kind == 3) { // an octet that flips somewhere
        Octets spoilt = telegram;
        spoilt[below(spoilt.size())] ^= static_cast<std::uint8_t>(1 + below(255));
        wire.telegram(spoilt);
    }
    if (kind == 4) { // one character without parity or stop bit
        const std::size_t bad = below(telegram.size());
        for (std::size_t i = 0; i < telegram.size(); ++i)
            if (i == bad)
                wire.bad_character(telegram[i], below(2) == 0);
            else
                wire.character(telegram[i]);
    }
}

void must_be_what_was_sent(const Receiver& receiver, const Master& master)
{
    if (receiver.user.taken != master.outputs()) throw std::runtime_error{"a wrong telegram was executed"};
}

/// How many of the whole telegrams are not answered.
double lost_behind_garbage(std::size_t telegrams, std::uint64_t seed)
{
    std::mt19937_64 random{seed};
    Receiver receiver;
    Master master{random};
    std::size_t lost = 0;
    for (std::size_t i = 0; i < telegrams; ++i) {
        Wire wire{random, 0};
        garbage(wire, random, master.request());
        wire.idle(kSyn);
        wire.telegram(master.request());
        if (!receiver.hear(wire.take())) {
            ++lost;
            continue;
        }
        must_be_what_was_sent(receiver, master);
        master.answered();
    }
    return static_cast<double>(lost);
}

/// Answered requests of all / the share that arrives without a flipped bit.
double goodput(std::size_t telegrams, std::uint64_t seed)
{
    constexpr double kErrorRate = 1e-4;
    std::mt19937_64 random{seed};
    Receiver receiver;
    Master master{random};
    std::size_t answered = 0;
    for (std::size_t i = 0; i < telegrams; ++i) {
        Wire wire{random, kErrorRate};
        wire.idle(kSyn);
        wire.telegram(master.request());
        if (!receiver.hear(wire.take())) continue;
        must_be_what_was_sent(receiver, master);
        master.answered();
        ++answered;
    }
    const auto bits = static_cast<double>(kBitsOfACharacter * master.request().size());
    return static_cast<double>(answered) / static_cast<double>(telegrams) / std::pow(1 - kErrorRate, bits);
}

} // namespace

std::vector<Row> measure_noise(bool quick)
{
    const std::size_t telegrams = quick ? 500 : 10'000;
    Row lost{.id = "M11", .metric = "telegrams lost that came whole behind garbage and T_SYN", .limit = 0};
    Row good{.id = "M11", .metric = "goodput at BER 1e-4 / (1-BER)^bits", .limit = 0.98, .is_least = true};
    for (std::uint64_t seed = 1; seed <= (quick ? 1 : kBlocks); ++seed) {
        lost.blocks.push_back(lost_behind_garbage(telegrams, seed));
        good.blocks.push_back(goodput(telegrams, seed));
    }
    // One lost telegram is too many, in whatever block it is.
    std::sort(lost.blocks.begin(), lost.blocks.end());
    lost.blocks = {lost.blocks.back()};
    return {lost, good};
}

} // namespace dpslave::bench
