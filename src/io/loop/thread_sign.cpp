// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/thread_sign.hpp"

#include "dpslave/io/clock.hpp"

namespace dpslave::io {
namespace {

thread_local ThreadSign* sign_of_this_thread = nullptr;

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

void ThreadSign::give(Instant now)
{
    const Instant last = sign_.last();
    if (!stall_ && last != Instant{} && now - last >= kStall) stall_ = Stall{now - last, call()};
    if (!stall_) sign_.give(now);
}

void ThreadSign::resume(Instant now)
{
    stall_.reset();
    sign_.give(now);
}

void set_sign_of_this_thread(ThreadSign* sign)
{
    sign_of_this_thread = sign;
    if (sign != nullptr) sign->resume(monotonic_now());
}

void give_sign()
{
    if (sign_of_this_thread != nullptr) sign_of_this_thread->give(monotonic_now());
}

bool this_thread_stalled()
{
    return sign_of_this_thread != nullptr && sign_of_this_thread->has_stalled();
}

InCall::InCall(PortCall call)
{
    give_sign();
    if (sign_of_this_thread != nullptr) sign_of_this_thread->enter(call);
}

/// The sign comes while the call still has its name: one that stalled is known by it.
InCall::~InCall()
{
    give_sign();
    if (sign_of_this_thread != nullptr) sign_of_this_thread->enter(PortCall::none);
}

} // namespace dpslave::io
