// SPDX-License-Identifier: Apache-2.0
#include "scripted_slave.hpp"

#include <poll.h>

#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace dpslave::modbus::test {
namespace {

/// How long something may take that normally takes a moment: the machine may be slow and loaded.
constexpr std::chrono::seconds kLimit{60};

/// Bit by bit, as the protocol's annex describes it; the library has a table.
std::uint16_t checksum(const Octets& octets)
{
    std::uint16_t sum = 0xFFFF;
    for (const std::uint8_t octet : octets) {
        sum = static_cast<std::uint16_t>(sum ^ octet);
        for (int bit = 0; bit < 8; ++bit) {
            const bool carry = (sum & 1) != 0;
            sum = static_cast<std::uint16_t>(sum >> 1);
            if (carry) sum = static_cast<std::uint16_t>(sum ^ 0xA001);
        }
    }
    return sum;
}

std::string text(const Octets& octets)
{
    std::ostringstream out;
    out << std::hex << std::uppercase << std::setfill('0');
    for (const std::uint8_t octet : octets)
        out << (out.tellp() == 0 ? "" : " ") << std::setw(2) << int{octet};
    return out.str();
}

/// Octets of a request with its checksum; 0: too few are known.
std::size_t length_of(const Octets& request)
{
    if (request.size() < 2) return 0;
    if (request[1] != 16) return 8;
    return request.size() < 7 ? 0 : 9u + request[6];
}

} // namespace

Octets octets(const std::string& text)
{
    Octets out;
    std::istringstream in{text};
    for (std::string two; in >> two;) out.push_back(static_cast<std::uint8_t>(std::stoul(two, nullptr, 16)));
    return out;
}

Octets framed(const std::string& text)
{
    Octets frame = octets(text);
    const std::uint16_t sum = checksum(frame);
    frame.push_back(static_cast<std::uint8_t>(sum & 0xFF));
    frame.push_back(static_cast<std::uint8_t>(sum >> 8));
    return frame;
}

ScriptedSlave::ScriptedSlave(int fd) : fd_(fd)
{
    thread_ = std::thread([this] { run(); });
}

ScriptedSlave::~ScriptedSlave()
{
    ends_ = true;
    thread_.join();
}

void ScriptedSlave::says(Octets exactly)
{
    const std::lock_guard lock(mutex_);
    script_.push_back(std::move(exactly));
}

std::vector<std::string> ScriptedSlave::requested(std::size_t at_least) const
{
    std::unique_lock lock(mutex_);
    was_asked_.wait_for(lock, kLimit, [&] { return requests_.size() >= at_least; });
    return requests_;
}

void ScriptedSlave::run()
{
    constexpr int kLookWhetherItEnds = 5; // ms
    while (!ends_) {
        pollfd line{.fd = fd_, .events = POLLIN, .revents = 0};
        if (::poll(&line, 1, kLookWhetherItEnds) <= 0) continue;
        std::uint8_t part[512];
        const ssize_t got = ::read(fd_, part, sizeof part);
        if (got <= 0) continue;
        heard_.insert(heard_.end(), part, part + got);
        hear();
    }
}

void ScriptedSlave::hear()
{
    const std::size_t length = length_of(heard_);
    if (length == 0 || heard_.size() < length) return;
    const Octets request = std::exchange(heard_, {});
    const Octets without(request.begin(), request.end() - 2);
    if (request.size() != length || framed(text(without)) != request) return;
    const std::lock_guard lock(mutex_);
    requests_.push_back(text(request));
    was_asked_.notify_all();
    if (script_.empty()) return;
    const Octets answer = std::move(script_.front());
    script_.pop_front();
    if (!answer.empty() && ::write(fd_, answer.data(), answer.size()) < 0) ends_ = true;
}

Bench::Bench(std::chrono::milliseconds timeout, std::uint32_t baud, drive::WireTime wire_time)
{
    auto opened = ModbusRtu::open(
        {.port = cable_.path(), .baud = baud, .timeout = timeout, .wire_time = wire_time}, is_open_);
    if (!opened) throw std::runtime_error{opened.error()};
    drive_ = *std::move(opened);
    slave_ = std::make_unique<ScriptedSlave>(cable_.fd());
}

AccessError Bench::read(const drive::Tag& tag, std::uint8_t unit)
{
    word_ = kUntouched;
    return drive_->read({.unit = unit}, tag, {&word_, 1});
}

AccessError Bench::write(const drive::Tag& tag, std::uint16_t word, std::uint8_t unit)
{
    return drive_->write({.unit = unit}, tag, {&word, 1});
}

drive::Tag number(std::uint16_t tag, std::uint8_t decimals)
{
    drive::Tag row;
    row.number = tag;
    row.decimals = decimals;
    return row;
}

drive::Tag at_register(drive::Tag row, std::uint16_t modbus_register)
{
    row.modbus_register = modbus_register;
    return row;
}

drive::Tag read_only(drive::Tag row)
{
    row.access = drive::Access::read_only;
    return row;
}

} // namespace dpslave::modbus::test
