// SPDX-License-Identifier: Apache-2.0
/// The common part of all simulated devices on the drive side of the gateway: parameters, and the serial line
/// they are on.
#pragma once

#include "answer_faults.hpp"
#include "tag_file.hpp"
#include "telegram.hpp"

#include "dpslave/base/units.hpp"

#include <deque>
#include <utility>

namespace dpslave::sim {

/// A value that moves by itself.
struct Motion {
    std::int32_t from = 0; ///< counts
    std::int32_t to = 0;
    Instant began{};
    std::chrono::nanoseconds takes{1};
    bool back_and_forth = false; ///< false: stays at `to`
};

struct SimParameter {
    SimTag tag;
    std::string mnemonic; ///< of an EI-ASCII drive; empty: cannot be reached over its line
    SimValue value;
    std::optional<Motion> motion;

    SimValue at(Instant now) const;
    void put(SimValue to); ///< and stays there
};

/// The faults that any device makes on request. All faults of a device are set together.
struct DeviceFaults {
    bool silence = false;             ///< no request is received, as without power
    bool bad_check = false;           ///< replies carry a wrong checksum
    bool garbage = false;             ///< replies are random octets
    std::chrono::nanoseconds slow{0}; ///< on top of the turnaround
};

/// One device with its parameters.
class Device {
public:
    Device(std::string address, std::vector<SimParameter> parameters)
        : parameters_(std::move(parameters)), address_(std::move(address))
    {}
    Device(Device&&) = default;
    Device& operator=(Device&&) = default;
    virtual ~Device() = default;

    const std::string& address() const { return address_; }
    const std::vector<SimParameter>& parameters() const { return parameters_; } ///< ascending by tag
    SimParameter* find(std::uint16_t tag);                                      ///< null: it has no such tag

    virtual void settle(Instant /*now*/) {} ///< what had to happen by itself until now
    /// On the way of its replies, beside what the device itself does wrong.
    AnswerFaults answer_faults{};

    /// A value was set in another way than over the line: what follows from it.
    virtual void changed(std::uint16_t /*tag*/, Instant /*now*/) {}

protected:
    std::vector<SimParameter> parameters_;

private:
    std::string address_;
};

/// One or more devices on one serial line. It is pure: octets and times go in, replies with their due times
/// and log lines come out.
class DeviceLine {
public:
    virtual ~DeviceLine() = default;

    virtual void on_bytes(Bytes octets, Instant now) = 0;
    std::optional<Octets> take_reply(Instant now);
    Instant next_deadline() const { return replies_.empty() ? kNever : replies_.front().due; }
    virtual std::vector<Device*> devices() = 0;

    std::vector<std::string> take_log() { return std::exchange(log_, {}); }
    void set_logging(bool on) { logging_ = on; }
    void set_echo(bool on) { echo_ = on; }
    bool echoes() const { return echo_; } ///< what is received is sent back at once

protected:
    /// `turnaround`: from the last octet of a request to the first of the reply. `most_octet`: 7Fh on a line
    /// of 7 data bits, else FFh.
    DeviceLine(std::chrono::nanoseconds turnaround, std::uint8_t most_octet)
        : turnaround_(turnaround), most_octet_(most_octet)
    {}

    /// A reply of this device to a request that was complete at `now`. `faults` and its answer faults say
    /// what leaves in its place, and when: one reply after the other, in the order of the requests.
    void reply(Device& device, const DeviceFaults& faults, Octets octets, Concerned concerned, Instant now);
    /// A new request: of the replies that wait only late ones still leave.
    void drop_reply();
    void log(const Device& device, std::string_view words);
    void warn(const Device& device, std::string_view words); ///< even if nothing is logged

private:
    struct Reply {
        const Device* device = nullptr;
        Octets octets;
        Instant due;
        bool is_late = false;
    };
    std::chrono::nanoseconds turnaround_;
    std::uint8_t most_octet_;
    std::minstd_rand random_{1}; ///< of octets that are garbage
    std::deque<Reply> replies_;  ///< by their due times; those of one device in the order of the questions
    bool logging_ = false;
    bool echo_ = false;
    std::vector<std::string> log_;
};

} // namespace dpslave::sim
