// SPDX-License-Identifier: Apache-2.0
/// The smallest slave: base, fdl and dp alone, through their public headers, on a tty. It has up to four
/// words of both directions and returns each output word as input word.
#include "dpslave/dp/slave.hpp"
#include "dpslave/fdl/layer2.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>

namespace {

using namespace dpslave;

Instant now()
{
    return Instant{std::chrono::steady_clock::now().time_since_epoch()};
}

/// 19.2 kbit/s, 8E1, and a read that never waits.
int open_port(const char* path)
{
    const int port = ::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios line{};
    line.c_cflag = CS8 | PARENB | CREAD | CLOCAL;
    ::cfsetspeed(&line, B19200);
    return port >= 0 && ::tcsetattr(port, TCSANOW, &line) == 0 ? port : -1;
}

void wait_for_octets(int port, Instant until)
{
    const auto wait = std::max((until - now()).count(), BusClock::rep{0});
    const timespec time{.tv_sec = wait / 1'000'000'000, .tv_nsec = wait % 1'000'000'000};
    pollfd ready{port, POLLIN, 0};
    ::ppoll(&ready, 1, until == kNever ? nullptr : &time, nullptr);
}

} // namespace

int main(int argc, char** argv)
{
    const int port = argc == 2 ? open_port(argv[1]) : -1;
    if (port < 0) return 2;
    dp::Personality device;
    device.ident = 0x1234;
    device.identifiers = {{0x70, 1, 1}};
    device.max_parameters = 4;
    device.prm = {.max_length = dp::kMaxUserPrm, .may_be_absent = true, .list = dp::TagList::none};
    device.max_tsdr.fill(Tbit{288}); // 15 ms: dpsim master waits somewhat longer
    dp::Slave slave{device, 5};
    fdl::Layer2 layer2{{.baud = Baud::k19_2, .search = {}}};
    slave.start(now());
    layer2.attach(5, slave, device.max_tsdr);

    while (true) {
        wait_for_octets(port, layer2.next_deadline());
        std::array<std::uint8_t, 256> octets{};
        const ssize_t got = ::read(port, octets.data(), octets.size());
        if (got < 0) return 1;
        if (got > 0) layer2.on_bytes(Bytes{octets}.first(static_cast<std::size_t>(got)), now());
        layer2.on_time(now());
        if (const auto reply = layer2.take_transmit())
            if (::write(port, reply->data(), reply->size()) < 0) return 1;
        if (const auto outputs = slave.take_outputs())
            slave.set_inputs({.generation = outputs->layout.generation,
                              .every_input_tried = true,
                              .words = outputs->words});
    }
}
