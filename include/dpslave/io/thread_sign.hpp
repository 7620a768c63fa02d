// SPDX-License-Identifier: Apache-2.0
/// The signs of life of a thread that uses ports, and the call that it is in when none come. The
/// functions of this library that wait give them for the thread that called.
#pragma once

#include "dpslave/base/sign_of_life.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::io {

/// A system call that may not come back.
enum class PortCall : std::uint8_t { none, open, close, read, write, set, drain, driver_enable };
/// As a text says it: "write"; "" for none.
std::string_view name(PortCall call);

class ThreadSign {
public:
    /// Signs come at least every kSlice. A call that takes kStall has stalled.
    static constexpr std::chrono::milliseconds kSlice{50}, kStall{400};

    // The thread's own.
    /// It goes round. A machine that had no time for it is no stall: those who judge the signs decide.
    void give(Instant now) { sign_.give(now); }
    void enter(PortCall call, Instant now);
    void leave(Instant now); ///< the call has come back
    struct Stall {
        std::chrono::nanoseconds length{};
        PortCall call = PortCall::none;
    };
    /// The first call that has stalled since clear_stall(). Until then the thread waits for nothing more.
    const std::optional<Stall>& stall() const { return stall_; }
    void clear_stall() { stall_.reset(); }

    // Any thread's.
    Instant last() const { return sign_.last(); }
    PortCall call() const { return call_.load(std::memory_order_relaxed); } ///< in which it is

private:
    SignOfLife sign_;
    std::atomic<PortCall> call_{PortCall::none};
    Instant entered_{};
    std::optional<Stall> stall_;
};

/// The signs of the calling thread from now on; null: nobody judges it. `sign` outlives the thread, or the
/// next call of this.
void set_sign_of_this_thread(ThreadSign* sign);
/// The calling thread goes round.
void give_sign();
/// One of its calls has stalled: what it waited for is not waited for any longer.
bool this_thread_stalled();

/// The calling thread is in this call, while the object lives.
class InCall {
public:
    explicit InCall(PortCall call);
    ~InCall();
    InCall(const InCall&) = delete;
    InCall& operator=(const InCall&) = delete;
};

} // namespace dpslave::io
