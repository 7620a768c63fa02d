// SPDX-License-Identifier: Apache-2.0
#include "bus_master.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace dpslave::endurance {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// 300 bit times at 1.5 Mbit/s (wire reference 1.4).
constexpr auto kSlot = 200us;
/// How long a reply may be held up on its way: a busy machine is no fault of the daemon.
constexpr auto kHeldUp = 10ms, kLongHeldUp = 200ms;
constexpr std::uint8_t kFirstOther = 20;
constexpr std::uint64_t kMostShown = 10; ///< wrong answers
constexpr std::uint8_t kSd1 = 0x10, kFdlStatus = 0x49;

/// The answer to FDL_Status: SD1, a slave, nothing else.
bool is_status(Reply reply)
{
    return reply.size() == 6 && reply[0] == kSd1 && reply[3] == 0x00;
}

bool is_ready(int fd, short event, std::chrono::nanoseconds time)
{
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::max(time, 0ns));
    const timespec limit{.tv_sec = seconds.count(), .tv_nsec = (std::max(time, 0ns) - seconds).count()};
    pollfd one{.fd = fd, .events = event, .revents = 0};
    return ::ppoll(&one, 1, &limit, nullptr) > 0;
}

} // namespace

BusMaster::BusMaster(std::size_t others) : others_(2 * others)
{
    for (std::size_t i = 0; i < others; ++i) {
        const auto address = static_cast<std::uint8_t>(kFirstOther + i);
        const Octets request = ::test::sd2(address, kMaster, i % 2 == 0 ? 0x5D : 0x7D, Octets(8, 0x11));
        const Octets reply = ::test::sd2(kMaster, address, 0x08, Octets(32, 0x22));
        sent_.insert(sent_.end(), request.begin(), request.end());
        sent_.insert(sent_.end(), reply.begin(), reply.end());
    }
    others_length_ = sent_.size();
}

void BusMaster::hold_open()
{
    held_open_ = io::Fd{::open(pty_.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    termios settings{};
    if (!held_open_ || ::tcgetattr(held_open_.get(), &settings) != 0)
        throw std::system_error{errno, std::system_category(), pty_.path()};
    ::cfmakeraw(&settings); // an echo would come back as an answer
    ::cfsetspeed(&settings, B1500000);
    ::tcsetattr(held_open_.get(), TCSANOW, &settings);
}

void BusMaster::forget_unread()
{
    ::tcflush(held_open_.get(), TCIFLUSH);
}

void BusMaster::serve(const std::stop_token& stop, const std::vector<SlaveTalk*>& slaves)
{
    while (!stop.stop_requested())
        for (SlaveTalk* const slave : slaves) exchange(*slave);
}

void BusMaster::exchange(SlaveTalk& slave)
{
    if (!exchange_once(slave, kHeldUp)) find_out_what_is_late(slave.address());
}

bool BusMaster::exchange_once(SlaveTalk& slave, std::chrono::nanoseconds patience)
{
    const auto reply = ask(slave.request(), patience);
    if (!reply) return false;
    const Octets asked = slave.request();
    if (slave.takes(*reply)) return true;
    if (++counts_.wrong <= kMostShown)
        fmt::print("a wrong answer behind {} requests:\n  asked {}\n  got   {}\n", counts_.requests,
                   ::test::show(asked), ::test::show({reply->begin(), reply->end()}));
    return true;
}

std::optional<Reply> BusMaster::ask(const Octets& request, std::chrono::nanoseconds patience)
{
    send(request);
    auto reply = reply_within(kSlot);
    const bool belated = !reply;
    if (belated) reply = reply_within(patience);
    if (belated && reply) ++counts_.belated;
    return reply;
}

/// The daemon drops a reply that it cannot begin within 100 us. But one that it has written may be held up
/// behind it, on a busy machine for long. Nothing overtakes it: so it comes before the answer to FDL_Status.
/// Where that question was repeated each answer to it is waited for: a later one would be taken for the
/// answer to the next question of this kind.
void BusMaster::find_out_what_is_late(std::uint8_t address)
{
    const Octets question = ::test::sd1(address, kMaster, kFdlStatus);
    std::size_t asked = 0, answered = 0;
    while (answered == 0) {
        send(question);
        ++asked;
        while (const auto reply = reply_within(answered == 0 ? kHeldUp : kLongHeldUp)) {
            if (!is_status(*reply))
                ++counts_.belated;
            else if (++answered == asked)
                return;
            else
                ++counts_.belated;
        }
    }
}

void BusMaster::take_what_is_late()
{
    while (reply_within(0ns)) ++counts_.belated;
}

void BusMaster::send(const Octets& request)
{
    if (have_ != 0) take_what_is_late();
    sent_.resize(others_length_);
    sent_.insert(sent_.end(), request.begin(), request.end());
    write(sent_);
    ++counts_.requests;
    counts_.others += others_;
    counts_.octets += sent_.size();
}

void BusMaster::write(std::span<const std::uint8_t> octets)
{
    while (!octets.empty()) {
        const ssize_t done = ::write(pty_.fd(), octets.data(), octets.size());
        if (done > 0)
            octets = octets.subspan(static_cast<std::size_t>(done));
        else if (errno == EAGAIN)
            is_ready(pty_.fd(), POLLOUT, 1s);
        else
            throw std::system_error{errno, std::system_category(), "write"};
    }
}

/// One whole telegram, which counts as answer. What came behind it stays for the next call.
std::optional<Reply> BusMaster::reply_within(std::chrono::nanoseconds time)
{
    const auto limit = Clock::now() + time;
    for (;;) {
        const std::size_t length = length_of(std::span{room_}.first(have_));
        if (length != 0 && have_ >= length) {
            std::copy_n(room_.begin(), length, reply_.begin());
            std::copy(room_.begin() + static_cast<std::ptrdiff_t>(length),
                      room_.begin() + static_cast<std::ptrdiff_t>(have_), room_.begin());
            have_ -= length;
            ++counts_.answers;
            return std::span{reply_}.first(length);
        }
        if (!is_ready(pty_.fd(), POLLIN, limit - Clock::now())) return std::nullopt;
        const ssize_t got = ::read(pty_.fd(), room_.data() + have_, room_.size() - have_);
        if (got <= 0) throw std::system_error{errno, std::system_category(), "the daemon has gone"};
        have_ += static_cast<std::size_t>(got);
    }
}

} // namespace dpslave::endurance
