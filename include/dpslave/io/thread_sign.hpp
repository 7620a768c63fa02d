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

/// Is told when its thread gives a sign: at least every ThreadSign::kSlice, also while it waits.
class SignListener {
public:
    virtual void on_sign(Instant now) = 0;

protected:
    ~SignListener() = default;
};

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
    /// It takes note of what followed from give_up() behind this.
    void clear_given_up() { given_up_.store(false); }
    bool is_given_up() const { return given_up_.load(); }

    // Any thread's.
    /// Whoever waited for it waits no longer: it writes nothing until it has taken note of that.
    void give_up() { given_up_.store(true); }
    /// The thread waits for octets until then at most, whatever it waits for; kNever: that is over.
    void end_waits(Instant at) { waits_end_.store(at, std::memory_order_release); }
    Instant waits_end() const { return waits_end_.load(std::memory_order_acquire); }
    Instant last() const { return sign_.last(); }
    PortCall call() const { return call_.load(std::memory_order_relaxed); } ///< in which it is

private:
    SignOfLife sign_;
    std::atomic<PortCall> call_{PortCall::none};
    Instant entered_{};
    std::optional<Stall> stall_;
    std::atomic<bool> given_up_{false};
    std::atomic<Instant> waits_end_{kNever};
};

/// The signs of the calling thread from now on; null: nobody judges it. Both outlive the thread, or the next
/// call of this.
void set_sign_of_this_thread(ThreadSign* sign, SignListener* listener = nullptr);
/// The calling thread goes round.
void give_sign();
/// One of its calls has stalled: what it waited for is not waited for any longer.
bool this_thread_stalled();
/// ThreadSign::end_waits(); kNever: it waits as long as it wants.
Instant waits_of_this_thread_end();
/// False: it was given up, one of its calls has stalled, or its waits have ended. What it would write now is
/// older than that, or not waited for any more.
bool this_thread_may_write();

/// The calling thread is in this call, while the object lives.
class InCall {
public:
    explicit InCall(PortCall call);
    ~InCall();
    InCall(const InCall&) = delete;
    InCall& operator=(const InCall&) = delete;
};

} // namespace dpslave::io
