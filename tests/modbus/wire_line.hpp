// SPDX-License-Identifier: Apache-2.0
/// A Modbus line that has the only clock. Its octets go through the receiver of the real one.
#pragma once

#include "modbus/frame_receiver.hpp"
#include "scripted_slave.hpp"

#include "dpslave/modbus/modbus_client.hpp"

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace dpslave::modbus::test {

/// At 9600 bit/s. Gives what it is told after the next request, in one read each.
class WireLine final : public ModbusPort {
public:
    static constexpr std::chrono::nanoseconds kCharacter{1'041'666};
    struct Chunk {
        Octets octets;
        std::chrono::nanoseconds after = std::chrono::milliseconds{10}; ///< the request
        bool bad_behind = false; ///< a character with wrong parity follows
    };
    std::deque<Chunk> answers;
    std::deque<Octets> script; ///< one for each request that `answers` says nothing of; empty = silence
    std::size_t requests = 0;
    bool echoes = false;
    Octets noise_before_echo;
    bool wire_time = false;
    Instant time{std::chrono::hours{1}};

    bool send(std::uint8_t unit, Bytes pdu) override
    {
        receiver_.sent(unit, pdu);
        ++requests;
        if (echoes) {
            Octets echo = noise_before_echo;
            const auto begin = static_cast<std::ptrdiff_t>(echo.size());
            echo.push_back(unit);
            echo.insert(echo.end(), pdu.begin(), pdu.end());
            const std::uint16_t crc = crc16(Bytes{echo}.subspan(static_cast<std::size_t>(begin)));
            echo.push_back(low(crc));
            echo.push_back(high(crc));
            coming_.push_back({std::move(echo), time + std::chrono::milliseconds{1}, false});
        }
        for (Chunk& one : answers)
            coming_.push_back({std::move(one.octets), time + one.after, one.bad_behind});
        if (answers.empty() && !script.empty()) {
            arrives(script.front(), std::chrono::milliseconds{10});
            script.pop_front();
        }
        answers.clear();
        return true;
    }
    /// Comes without being asked for.
    void arrives(Octets octets, std::chrono::nanoseconds after = {})
    {
        if (!octets.empty()) coming_.push_back({std::move(octets), time + after, false});
    }
    Heard receive(Instant until) override
    {
        constexpr std::chrono::milliseconds kGap{20};
        for (;;) {
            if (const auto heard = take()) return *heard;
            const bool in_frame = receiver_.in_frame();
            const Instant end = in_frame ? time + kGap : until;
            if (coming_.empty() || coming_.front().at > end) {
                time = std::max(time, end);
                if (!in_frame) return Heard::silence;
                const auto found = receiver_.silence();
                if (found == FrameReceiver::Found::broken) return Heard::broken;
                if (found == FrameReceiver::Found::rest) return Heard::rest;
                continue;
            }
            time = std::max(time, coming_.front().at);
            read_.insert(read_.end(), coming_.front().octets.begin(), coming_.front().octets.end());
            bad_behind_ = coming_.front().bad_behind;
            coming_.pop_front();
        }
    }
    Bytes frame() const override { return receiver_.frame(); }
    Piece piece() const override
    {
        return {.octets = receiver_.piece(),
                .flaw = receiver_.flaw(),
                .read_at = time,
                .begun = receiver_.begun(kCharacter),
                .noise = receiver_.noise()};
    }
    bool takes_wire_time() const override { return wire_time; }
    Instant now() const override { return time; }

private:
    struct Coming {
        Octets octets;
        Instant at{};
        bool bad_behind = false;
    };
    std::optional<Heard> take()
    {
        while (!read_.empty() || bad_behind_) {
            auto found = FrameReceiver::Found::nothing;
            if (read_.empty()) {
                bad_behind_ = false;
                found = receiver_.fault();
            } else {
                const auto behind = static_cast<std::int64_t>(read_.size() - 1);
                found = receiver_.feed(read_.front(), time - behind * kCharacter);
                read_.pop_front();
            }
            if (found == FrameReceiver::Found::frame) return Heard::frame;
            if (found == FrameReceiver::Found::broken) return Heard::broken;
        }
        return std::nullopt;
    }
    FrameReceiver receiver_;
    std::deque<Coming> coming_;
    std::deque<std::uint8_t> read_;
    bool bad_behind_ = false;
};

/// A client on it, which waits 600 ms for an answer.
class WireBench {
public:
    WireBench()
    {
        ClientSettings settings;
        settings.rules.echo = EchoMode::off;
        client_.emplace(line, settings);
    }
    ModbusClient& drive() { return *client_; }
    void says(Octets exactly) { line.script.push_back(std::move(exactly)); } ///< to the next request
    void answers(const std::string& without_checksum) { says(framed(without_checksum)); }
    void is_silent() { says({}); }

    AccessError read(const drive::Tag& tag, std::uint8_t unit = 1) ///< into word
    {
        word = kUntouched;
        return client_->read({.unit = unit}, tag, {&word, 1});
    }
    AccessError write(const drive::Tag& tag, std::uint16_t value, std::uint8_t unit = 1)
    {
        return client_->write({.unit = unit}, tag, {&value, 1});
    }

    WireLine line;
    std::uint16_t word = kUntouched;

private:
    std::optional<ModbusClient> client_;
};

} // namespace dpslave::modbus::test
