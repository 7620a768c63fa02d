// SPDX-License-Identifier: Apache-2.0
/// An EI-ASCII drive in memory on a serial line with simulated time. Written from the EI-ASCII
/// reference, sections 1 and 4, by a second hand: it shares no encoder with the library under test. Values
/// are kept as the text that travels.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/drive/serial_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::drive::test {

using namespace std::chrono_literals;

/// What the drive does wrong with one request.
enum class Fault {
    none,
    silent,          ///< does nothing
    lost_answer,     ///< does it and the answer gets lost
    bad_bcc,         ///< of a reply to a poll
    half_answer,     ///< the answer stops in the middle
    stray_octet,     ///< a printable octet before the answer
    glitch,          ///< FF before the answer, as a transceiver makes it
    wrong_parameter, ///< a reply for another mnemonic
};

class FakeDrive {
public:
    struct Parameter {
        std::string text;
        bool read_only = false;
        bool write_only = false;
        double min = -1e9, max = 1e9;
        unsigned writes = 0;
        unsigned reads = 0;
    };

    FakeDrive(char group, char unit) : group_(group), unit_(unit) { parameters["II"].text = ">2650"; }

    std::map<std::string, Parameter> parameters;
    std::string ee = ">00C0";
    bool alive = true;
    std::deque<Fault> faults;            ///< one for each request to come
    std::deque<std::string> refuse_next; ///< EE of writes to be refused with NAK, whatever they say
    std::chrono::nanoseconds turnaround = 5ms;
    unsigned requests = 0;
    std::vector<std::string> selected; ///< the mnemonic of each write that was heard, refused ones included

    /// One octet of the line; gives what the drive answers to it.
    std::string on_octet(char c)
    {
        if (!alive) return {};
        if (c == '\x04' && state_ != State::check) {
            state_ = State::address;
            collected_.clear();
            return {};
        }
        switch (state_) {
            case State::idle: return {};
            case State::address: return on_address(c);
            case State::poll: return on_poll(c);
            case State::select:
                collected_ += c;
                if (c == '\x03') state_ = State::check;
                return {};
            case State::check: state_ = State::idle; return on_select(c);
        }
        return {};
    }

private:
    enum class State { idle, address, poll, select, check };

    std::string on_address(char c)
    {
        collected_ += c;
        if (collected_.size() < 4) return {};
        if (collected_.size() == 4) {
            const std::string mine{group_, group_, unit_, unit_};
            if (collected_ != mine) state_ = State::idle;
            return {};
        }
        collected_.clear();
        state_ = c == '\x02' ? State::select : State::poll;
        if (state_ == State::poll) collected_ += c;
        return {};
    }

    std::string on_poll(char c)
    {
        if (c != '\x05') {
            collected_ += c;
            return {};
        }
        state_ = State::idle;
        ++requests;
        const Fault fault = next_fault();
        if (fault == Fault::silent || fault == Fault::lost_answer) return {};
        if (collected_ == "EE") return spoiled(reply("EE", ee), fault);
        const auto at = parameters.find(collected_);
        if (at == parameters.end()) {
            ee = ">01C7";
            return spoiled("\x04", fault);
        }
        if (at->second.write_only) {
            ee = ">04C8";
            return spoiled("\x04", fault);
        }
        ++at->second.reads;
        return spoiled(reply(fault == Fault::wrong_parameter ? "zz" : collected_, at->second.text), fault);
    }

    std::string on_select(char check)
    {
        ++requests;
        const Fault fault = next_fault();
        if (fault == Fault::silent) return {};
        selected.push_back(collected_.substr(0, 2));
        const std::string answer = written(check) ? "\x06" : "\x15";
        return fault == Fault::lost_answer ? std::string{} : spoiled(answer, fault);
    }

    bool written(char check)
    {
        if (check != parity_of(collected_)) return refuse(">02C2");
        if (collected_.starts_with("EE")) {
            ee = ">00C0";
            return true;
        }
        if (!refuse_next.empty()) {
            const std::string why = refuse_next.front();
            refuse_next.pop_front();
            return refuse(why);
        }
        const std::string name = collected_.substr(0, 2);
        const std::string text = collected_.substr(2, collected_.size() - 3);
        const auto at = parameters.find(name);
        if (at == parameters.end()) return refuse(">01C7");
        if (at->second.read_only) return refuse(">05C8");
        char* end = nullptr;
        const bool hexadecimal = text.starts_with('>');
        if (!hexadecimal && text.find('.') == std::string::npos)
            return refuse(">07C8"); // the point is mandatory
        const double value = hexadecimal ? static_cast<double>(std::strtol(text.c_str() + 1, &end, 16))
                                         : std::strtod(text.c_str(), &end);
        if (*end != '\0') return refuse(">07C8");
        if (value < at->second.min || value > at->second.max) return refuse(">08C8");
        at->second.text = text;
        ++at->second.writes;
        return true;
    }

    bool refuse(const std::string& why)
    {
        ee = why;
        return false;
    }

    static char parity_of(const std::string& covered)
    {
        int sum = 0;
        for (const char c : covered) sum ^= c;
        return static_cast<char>(sum);
    }

    static std::string reply(const std::string& name, const std::string& text)
    {
        const std::string covered = name + text + '\x03';
        return '\x02' + covered + parity_of(covered);
    }

    static std::string spoiled(std::string answer, Fault fault)
    {
        switch (fault) {
            case Fault::bad_bcc: answer.back() = static_cast<char>(answer.back() ^ 1); break;
            case Fault::half_answer: answer.resize(answer.size() / 2); break;
            case Fault::stray_octet: answer.insert(0, 1, 'x'); break;
            case Fault::glitch: answer.insert(0, 1, '\xFF'); break;
            case Fault::none:
            case Fault::silent:
            case Fault::lost_answer:
            case Fault::wrong_parameter: break;
        }
        return answer;
    }

    Fault next_fault()
    {
        if (faults.empty()) return Fault::none;
        const Fault fault = faults.front();
        faults.pop_front();
        return fault;
    }

    char group_, unit_;
    State state_ = State::idle;
    std::string collected_;
};

/// The line with its drives. Time passes only here: ten bits a character, and what read() waits.
class SimulatedLine final : public SerialLine {
public:
    explicit SimulatedLine(unsigned baud = 9600) : character_(std::chrono::nanoseconds{10'000'000'000 / baud})
    {}

    std::vector<FakeDrive*> drives;
    Instant time{};
    bool unplugged = false;
    bool stalls = false; ///< write() fails, and the request leaves all the same
    bool echoes = false; ///< the transceiver hears what it sends
    std::string sent;    ///< octets of all requests
    Instant asked_at{};  ///< begin of the last request

    std::chrono::nanoseconds character() const { return character_; }
    void comes_by_itself(const std::string& octets, std::chrono::nanoseconds after = 0ns)
    {
        arrives(octets, time + after);
    }

    /// For ever: one octet, again and again.
    void babbles(char octet, std::chrono::nanoseconds every, std::chrono::nanoseconds after = 0ns)
    {
        babble_ = octet;
        babble_every_ = every;
        next_babble_ = time + after;
    }

    Instant now() const override { return time; }

    bool write(Bytes octets) override
    {
        if (unplugged) return false;
        asked_at = time;
        Instant at = std::max(time, sent_until_); // one behind the other, as a port sends
        for (const std::uint8_t octet : octets) {
            at += character_;
            sent += static_cast<char>(octet);
            if (echoes) arrives(std::string(1, static_cast<char>(octet)), at - character_);
            for (FakeDrive* drive : drives) {
                const std::string answer = drive->on_octet(static_cast<char>(octet));
                if (!answer.empty()) arrives(answer, at + drive->turnaround);
            }
        }
        sent_until_ = at;
        return !stalls;
    }
    bool may_have_left() const override { return stalls; }

    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override
    {
        babble_until(time + timeout);
        if (pending_.empty() || pending_.front().second > time + timeout) {
            time += timeout;
            return 0;
        }
        time = std::max(time, pending_.front().second);
        std::size_t got = 0;
        while (got < into.size() && !pending_.empty() && pending_.front().second <= time) {
            into[got++] = static_cast<std::uint8_t>(pending_.front().first);
            pending_.pop_front();
        }
        return got;
    }

    void discard() override
    {
        babble_until(time);
        while (!pending_.empty() && pending_.front().second <= time) pending_.pop_front();
    }

private:
    void arrives(const std::string& octets, Instant begin)
    {
        for (const char c : octets) {
            begin += character_;
            pending_.emplace_back(c, begin);
        }
        in_order();
    }

    void babble_until(Instant end)
    {
        if (!babble_) return;
        for (; next_babble_ <= end; next_babble_ += babble_every_)
            pending_.emplace_back(*babble_, next_babble_);
        in_order();
    }

    void in_order()
    {
        std::stable_sort(pending_.begin(), pending_.end(),
                         [](auto& a, auto& b) { return a.second < b.second; });
    }

    std::chrono::nanoseconds character_;
    Instant sent_until_{};
    std::deque<std::pair<char, Instant>> pending_;
    std::optional<char> babble_;
    std::chrono::nanoseconds babble_every_{};
    Instant next_babble_{};
};

} // namespace dpslave::drive::test
