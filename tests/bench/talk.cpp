// SPDX-License-Identifier: Apache-2.0
#include "talk.hpp"

#include "dpslave/io/clock.hpp"

#include <unistd.h>

#include <stdexcept>
#include <string>

namespace dpslave::bench {
namespace {

using namespace std::chrono_literals;

/// Stands in for the slot time: long enough that a busy machine is no lost telegram.
constexpr auto kSlot = 50ms;

bool is_sc(std::span<const std::uint8_t> frame)
{
    return frame.size() == 1 && frame[0] == 0xE5;
}

} // namespace

Talk::Talk(Port& port, std::uint8_t address)
    : port_(port),
      address_(address),
      first_(data_exchange(address, 0x6D)),
      even_(data_exchange(address, 0x5D)),
      odd_(data_exchange(address, 0x7D))
{}

/// 6D begins a sequence, then 5D and 7D in turn.
std::uint8_t Talk::next_fc()
{
    const std::uint8_t fc = fc_;
    fc_ = fc == 0x5D ? 0x7D : 0x5D;
    return fc;
}

/// Repeats the request unchanged until it is answered, as a master does. Gives up after ten seconds.
std::optional<Talk::Reply> Talk::ask(const Octets& request)
{
    constexpr std::size_t kTries = 200;
    for (std::size_t retries = 0; retries < kTries; ++retries) {
        if (auto answer = port_.exchange(request, kSlot)) {
            answer->time += retries * kSlot;
            return Reply{.answer = *answer, .retries = retries};
        }
        port_.drain();
    }
    return std::nullopt;
}

std::chrono::nanoseconds Talk::exchange(const Octets& request)
{
    const auto reply = ask(request);
    if (!reply) throw std::runtime_error{port_.path() + ": the responder has fallen silent"};
    if (!is_data_exchange_reply(reply->answer.frame, address_, inputs_of(words_)))
        throw std::runtime_error{port_.path() + ": a wrong answer to Data_Exchange"};
    retries_ += reply->retries;
    return reply->answer.time;
}

std::chrono::nanoseconds Talk::exchange()
{
    const std::uint8_t fc = next_fc();
    return exchange(fc == 0x6D ? first_ : fc == 0x5D ? even_ : odd_);
}

std::chrono::nanoseconds Talk::exchange(std::uint16_t value)
{
    return exchange(data_exchange(address_, next_fc(), words_, value));
}

/// First two octets of Slave_Diag; throws if it is not answered.
std::array<std::uint8_t, 2> Talk::station_status(Child& daemon)
{
    const auto reply = ask(slave_diag(address_, next_fc()));
    if (!reply)
        throw std::runtime_error{daemon.alive() ? "the daemon does not answer Slave_Diag"
                                                : "the daemon has ended"};
    const auto diagnosis = diagnosis_in(reply->answer.frame, address_);
    if (diagnosis.empty()) throw std::runtime_error{"the answer to Slave_Diag is none"};
    return {diagnosis[0], diagnosis[1]};
}

void Talk::expect_sc(const Octets& request, const char* what)
{
    const auto reply = ask(request);
    if (!reply || !is_sc(reply->answer.frame))
        throw std::runtime_error{std::string{what} + " is not acknowledged"};
}

void Talk::start_up(Child& daemon, Words words)
{
    constexpr std::uint8_t kNotReady = 0x02;
    constexpr std::uint8_t kCfgFault = 0x04;
    constexpr std::uint8_t kPrmFault = 0x40;
    constexpr std::uint8_t kPrmReq = 0x01;
    constexpr std::uint8_t kStatDiag = 0x02;
    words_ = words;
    station_status(daemon);
    expect_sc(set_prm(address_, next_fc()), "Set_Prm");
    expect_sc(chk_cfg(address_, next_fc(), words), "Chk_Cfg");
    const Instant limit = io::monotonic_now() + 10s;
    while (io::monotonic_now() < limit) {
        const auto [first, second] = station_status(daemon);
        if ((first & (kCfgFault | kPrmFault)) != 0)
            throw std::runtime_error{"the daemon refuses the start-up"};
        if ((first & kNotReady) == 0 && (second & (kPrmReq | kStatDiag)) == 0) return;
        ::usleep(10'000);
    }
    throw std::runtime_error{"the station does not become ready"};
}

void pause()
{
    constexpr timespec kTime{.tv_sec = 0, .tv_nsec = 50'000};
    ::nanosleep(&kTime, nullptr);
}

} // namespace dpslave::bench
