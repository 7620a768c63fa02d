// SPDX-License-Identifier: Apache-2.0
/// What all simulated devices behind the gateway have in common: parameters, and a serial line they are on.
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

struct Parameter {
    SimTag tag;
    std::string mnemonic; ///< of an EI-ASCII drive; empty: cannot be reached over its line
    SimValue value;
    std::optional<Motion> motion;

    SimValue at(Instant now) const;
    void put(SimValue to); ///< and stands still there
};

/// One device with its parameters.
class Device {
public:
    Device(std::string address, std::vector<Parameter> parameters)
        : parameters_(std::move(parameters)), address_(std::move(address))
    {}
    Device(Device&&) = default;
    Device& operator=(Device&&) = default;
    virtual ~Device() = default;

    const std::string& address() const { return address_; }
    const std::vector<Parameter>& parameters() const { return parameters_; } ///< ascending by tag
    Parameter* find(std::uint16_t tag);                                      ///< null: it has no such tag

    virtual void settle(Instant /*now*/) {} ///< what had to happen by itself until now
    /// On the way of its replies, beside what the device itself does wrong.
    AnswerFaults answer_faults{};

    /// Somebody beside the line has put a value into this tag: what follows from it.
    virtual void changed(std::uint16_t /*tag*/, Instant /*now*/) {}

protected:
    std::vector<Parameter> parameters_;

private:
    std::string address_;
};

/// One or more devices on one serial line. Pure: octets and times go in, replies with their due times and log
/// lines come out.
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
    bool echoes() const { return echo_; } ///< all that is heard comes back at once

protected:
    /// A prompt reply of this device would leave at `due`; its faults say what really does. It takes as long
    /// for each reply, and gives them in the order of the questions.
    void reply(Device& device, Octets octets, Concerned concerned, Instant due, Instant now);
    /// The master has gone on: only late replies still come.
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
    std::deque<Reply> replies_; ///< by their due times; those of one device in the order of the questions
    bool logging_ = false;
    bool echo_ = false;
    std::vector<std::string> log_;
};

} // namespace dpslave::sim
