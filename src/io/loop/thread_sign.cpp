// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/thread_sign.hpp"

#include "dpslave/io/clock.hpp"

namespace dpslave::io {
namespace {

thread_local ThreadSign* sign_of_this_thread = nullptr;
thread_local SignListener* listener_of_this_thread = nullptr;

} // namespace

std::string_view name(PortCall call)
{
    switch (call) {
        case PortCall::none: break;
        case PortCall::open: return "open";
        case PortCall::close: return "close";
        case PortCall::read: return "read";
        case PortCall::write: return "write";
        case PortCall::set: return "set";
        case PortCall::drain: return "drain";
        case PortCall::driver_enable: return "driver enable";
    }
    return "";
}

void ThreadSign::enter(PortCall call, Instant now)
{
    entered_ = now;
    call_.store(call, std::memory_order_relaxed);
    give(now);
}

void ThreadSign::leave(Instant now)
{
    if (!stall_ && now - entered_ >= kStall) stall_ = Stall{now - entered_, call()};
    call_.store(PortCall::none, std::memory_order_relaxed);
    give(now);
}

void set_sign_of_this_thread(ThreadSign* sign, SignListener* listener)
{
    sign_of_this_thread = sign;
    listener_of_this_thread = listener;
    give_sign();
}

void give_sign()
{
    if (sign_of_this_thread == nullptr) return;
    const Instant now = monotonic_now();
    sign_of_this_thread->give(now);
    if (listener_of_this_thread != nullptr) listener_of_this_thread->on_sign(now);
}

bool this_thread_stalled()
{
    return sign_of_this_thread != nullptr && sign_of_this_thread->stall().has_value();
}

Instant waits_of_this_thread_end()
{
    return sign_of_this_thread != nullptr ? sign_of_this_thread->waits_end() : kNever;
}

bool this_thread_may_write()
{
    const ThreadSign* const sign = sign_of_this_thread;
    return sign == nullptr || (!sign->is_given_up() && !sign->stall() && monotonic_now() < sign->waits_end());
}

InCall::InCall(PortCall call)
{
    if (sign_of_this_thread != nullptr) sign_of_this_thread->enter(call, monotonic_now());
}

InCall::~InCall()
{
    if (sign_of_this_thread != nullptr) sign_of_this_thread->leave(monotonic_now());
}

} // namespace dpslave::io
