// SPDX-License-Identifier: Apache-2.0
/// The tests of layer 2 use this: a SAP user that writes down how it was called, and a slave 5 on a bus.
#pragma once

#include "support/bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>
#include <vector>

namespace test {

class RecordingUser final : public dpslave::fdl::SapUser {
public:
    struct Call {
        std::uint8_t sa;
        std::optional<std::uint8_t> dsap;
        std::optional<std::uint8_t> ssap;
        Octets data;
        dpslave::Instant at;
    };

    dpslave::fdl::Answer srd(const dpslave::fdl::Indication& request, dpslave::fdl::ReplyData& reply) override
    {
        srds.push_back(call(request));
        reply.append(inputs);
        min_tsdr_bits = min_tsdr_after_srd.value_or(min_tsdr_bits);
        return answer;
    }
    void sdn(const dpslave::fdl::Indication& request) override { sdns.push_back(call(request)); }
    void heard(std::uint8_t sa, dpslave::Instant at) override { heards.push_back({sa, {}, {}, {}, at}); }
    dpslave::Tbit min_tsdr() const override { return min_tsdr_bits; }
    dpslave::fdl::Supervision supervision() const override { return level; }
    void on_time(dpslave::Instant now) override
    {
        times.push_back(now);
        deadline = deadline_after_on_time;
        level = level_after_on_time.value_or(level);
    }
    dpslave::Instant next_deadline() const override
    {
        ++deadline_questions;
        return deadline;
    }

    // No list in the initializer below: g++ 12 believes it uninitialized as soon as it optimizes.
    static constexpr std::array<std::uint8_t, 2> kInputs{0x12, 0x34};

    // What it is to say.
    dpslave::fdl::Answer answer = dpslave::fdl::Answer::low;
    Octets inputs = Octets(kInputs.begin(), kInputs.end());
    dpslave::Tbit min_tsdr_bits{11};
    std::optional<dpslave::Tbit> min_tsdr_after_srd;
    dpslave::fdl::Supervision level = dpslave::fdl::Supervision::unowned;
    std::optional<dpslave::fdl::Supervision> level_after_on_time;
    dpslave::Instant deadline = dpslave::kNever;
    dpslave::Instant deadline_after_on_time = dpslave::kNever;

    // What it heard.
    std::vector<Call> srds;
    std::vector<Call> sdns;
    std::vector<Call> heards;
    std::vector<dpslave::Instant> times;
    mutable std::size_t deadline_questions = 0;

private:
    static Call call(const dpslave::fdl::Indication& request)
    {
        return {
            request.sa, request.dsap, request.ssap, {request.data.begin(), request.data.end()}, request.at};
    }
};

inline constexpr std::uint8_t kOther = 9; // another slave, not of this station
inline constexpr std::uint8_t kMaster = 2;
inline constexpr std::uint8_t kOtherMaster = 3;

// FC of requests (wire reference 2.3).
inline constexpr std::uint8_t kFdlStatus = 0x49;
inline constexpr std::uint8_t kSrdFirst = 0x6D;
inline constexpr std::uint8_t kSrdFcb0 = 0x5D;
inline constexpr std::uint8_t kSrdFcb1 = 0x7D;
inline constexpr std::uint8_t kSrdUncounted = 0x4D;
inline constexpr std::uint8_t kSdnHigh = 0x46;

/// When the last octet of a request was read.
inline constexpr dpslave::Instant kRead{std::chrono::seconds{5}};
/// A request to slave 5 with two octets of data.
inline const Octets kAsk = sd2(kUs, kMaster, kSrdFcb1, {0xAA, 0xBB});

/// Slave 5 at 187.5 kbit/s with the class default of 60 T_bit.
class FdlStation : public testing::Test {
protected:
    FdlStation()
    {
        station.attach(kUs, user, kClassMaxTsdr);
        bus.advance({}); // the edge wakes up once
    }

    RecordingUser user;
    dpslave::fdl::Layer2 station{{.baud = dpslave::Baud::k187_5, .search = {}, .start_up_latency = {}}};
    Bus bus{station};
};

/// A slave 5 of its own for each telegram, so that none hides what the one before left behind.
struct Line {
    explicit Line(dpslave::Baud baud)
        : station{{.baud = baud, .search = {}, .start_up_latency = {}}},
          bus{station, {.baud = baud, .min_tsdr = dpslave::Tbit{11}, .max_tsdr = {}}}
    {
        station.attach(kUs, user, kClassMaxTsdr);
        bus.advance({});
    }

    /// Of all kinds.
    std::uint64_t flaws() const
    {
        const auto& each = station.counters().flaws;
        return std::accumulate(each.begin(), each.end(), std::uint64_t{0});
    }

    RecordingUser user;
    dpslave::fdl::Layer2 station;
    Bus bus;
};

/// How a FIFO may hand a telegram over: whole, or so many octets at a time.
inline constexpr std::size_t kWhole = 300; // more than any telegram has octets
inline constexpr std::array<std::size_t, 6> kBunches{kWhole, 1, 4, 8, 14, 16};

inline Octets without(const Octets& telegram, std::size_t lost)
{
    Octets rest = telegram;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(lost));
    return rest;
}

inline const auto kNameOf = [](const auto& info) { return std::string{info.param.name}; };

} // namespace test
