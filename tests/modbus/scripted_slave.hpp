// SPDX-License-Identifier: Apache-2.0
/// The other end of the line: a Modbus RTU slave by an independent hand, with its own framing and checksum.
/// It says what the test has written down, and writes down what it was asked.
#pragma once

#include "io/pty.hpp"

#include "dpslave/modbus/modbus_rtu.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace dpslave::modbus::test {

using Octets = std::vector<std::uint8_t>;

/// "01 03 02 00 B7" as octets.
Octets octets(const std::string& text);
/// The same with its checksum behind it, low octet first.
Octets framed(const std::string& text);

class ScriptedSlave {
public:
    explicit ScriptedSlave(int fd); ///< of the line, which outlives it
    ~ScriptedSlave();
    ScriptedSlave(const ScriptedSlave&) = delete;
    ScriptedSlave& operator=(const ScriptedSlave&) = delete;

    /// What it says to the next request that is not provided for yet. Nothing provided for: silence.
    void answers(const std::string& without_checksum) { says(framed(without_checksum)); }
    void says(Octets exactly);
    void is_silent() { says({}); }

    /// All requests so far, once there are `at_least` so many: "01 03 00 01 00 01 D5 CA". One that has no
    /// good checksum, or more than itself in it, is none.
    std::vector<std::string> requested(std::size_t at_least = 0) const;

private:
    void run();
    void hear();

    int fd_;
    mutable std::mutex mutex_;
    mutable std::condition_variable was_asked_;
    std::deque<Octets> script_;
    std::vector<std::string> requests_;
    Octets heard_;
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

/// A line with a slave at its other end. Long enough to wait for a loaded machine, unless a test says how
/// long.
class Bench {
public:
    explicit Bench(std::chrono::milliseconds timeout = std::chrono::seconds{60}, std::uint32_t baud = 115'200,
                   drive::WireTime wire_time = drive::WireTime::automatic);

    ScriptedSlave& slave() { return *slave_; }
    ModbusRtu& drive() { return *drive_; }
    void arrives(const Octets& octets) { cable_.send(octets); } ///< without having been asked for

    AccessError read(const drive::Tag& tag, std::uint8_t unit = 1); ///< into word()
    std::uint16_t word() const { return word_; }
    AccessError write(const drive::Tag& tag, std::uint16_t word, std::uint8_t unit = 1);

private:
    io::Pty cable_;
    std::atomic<bool> is_open_{false};
    std::unique_ptr<ModbusRtu> drive_;
    std::unique_ptr<ScriptedSlave> slave_;
    std::uint16_t word_ = 0;
};

/// A row of a tag table.
drive::Tag number(std::uint16_t tag, std::uint8_t decimals = 0);
drive::Tag at_register(drive::Tag row, std::uint16_t modbus_register);
drive::Tag read_only(drive::Tag row);

/// What was read before and still stands there when a call gave nothing.
inline constexpr std::uint16_t kUntouched = 0xABCD;

} // namespace dpslave::modbus::test
