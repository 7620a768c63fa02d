// SPDX-License-Identifier: Apache-2.0
// The port of the bus and its driver enable: another rate, gone, of no use, back again, and what is told of
// it.
#include "bus_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <sys/epoll.h>

#include <memory>
#include <utility>

namespace dpslave::app {

/// The search for the rate has decided: the line is switched, and what it had brought at the old rate is
/// gone.
void BusThread::follow_rate()
{
    if (const auto baud = layer2_.take_baud_change()) set_baud(*baud);
}

void BusThread::set_baud(Baud baud)
{
    sender_.abort();
    link_.baud.store(baud, std::memory_order_relaxed);
    if (const auto trouble = port_.set_baud(static_cast<std::uint32_t>(baud))) {
        tell(PortNews::gone);
        refuse_port(*trouble);
    }
}

/// By its edges: each arrival of octets is told once, and asking the port again whether something is left
/// costs more than the reply.
void BusThread::watch_port()
{
    epoll_.add(port_.tty().fd(), EPOLLIN | EPOLLET, kTtyKey);
}

void BusThread::lose_port()
{
    if (!port_.is_open()) return;
    let_go_of_port();
    port_.lose(io::monotonic_now());
    tell(PortNews::gone);
}

/// It can be opened, and is of no use.
void BusThread::refuse_port(const std::string& why)
{
    let_go_of_port();
    port_.refuse(io::monotonic_now(), why);
    tell_trouble();
}

void BusThread::let_go_of_port()
{
    sender_.abort();
    epoll_.remove(port_.tty().fd());
    driver_.detach();
}

void BusThread::tell_trouble()
{
    if (const auto why = port_.take_trouble())
        tell({.is_warning = false, .text = *why + "; it is tried again"});
}

void BusThread::tell(PortWords words)
{
    auto told = std::make_unique<PortWords>(std::move(words));
    static_cast<void>(link_.port_words.offer(told)); // not read yet: the older one is as true
}

/// Nothing is sent through a port whose driver enable does not work: then it is as good as not there.
void BusThread::try_reopen(Instant now)
{
    if (!port_.ready(now)) {
        tell_trouble();
        return;
    }
    watch_port();
    if (const auto trouble = driver_.attach(port_.tty())) {
        refuse_port(port_.path() + ": " + *trouble);
        return;
    }
    guard_told_ = false;
    tell(PortNews::back);
    std::string warnings;
    for (const std::string& one : port_.tty().warnings()) warnings += (warnings.empty() ? "" : ". ") + one;
    if (!warnings.empty()) tell({.is_warning = true, .text = port_.path() + ": " + warnings});
}

/// An edge of the driver enable that failed is told once, and the way back is tried for. So is the first time
/// that the guard was needed.
void BusThread::mind_driver(Instant now)
{
    if (!port_.is_open()) return;
    if (sender_.driver_guarded() != guarded_ && !std::exchange(guard_told_, true))
        tell(PortNews::driver_guarded);
    guarded_ = sender_.driver_guarded();
    const bool works = driver_.works() || (!sender_.is_sending() && driver_.ready(now));
    if (works == driver_worked_) return;
    driver_worked_ = works;
    tell(works ? PortNews::driver_back : PortNews::driver_gone);
}

} // namespace dpslave::app
