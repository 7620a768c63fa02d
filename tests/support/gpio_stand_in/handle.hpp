// SPDX-License-Identifier: Apache-2.0
/// What both versions of the stand-in are made of: a chip that was opened, a line that was taken.
#pragma once

#include "chip_file.hpp"

namespace dpslave::stand_in {

/// A chip that was opened. Errors are reported by errno, with the values that the kernel uses.
class Handle {
public:
    /// Nothing: errno says why.
    static Handle* open(const char* path) noexcept;
    /// Another one of the same chip, that keeps what was taken.
    Handle* again() const noexcept;
    ~Handle();
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    const char* label() const noexcept { return chip_->label.data(); }
    unsigned lines() const noexcept { return chip_->lines; }
    const char* consumer(unsigned line) const noexcept { return chip_->line[line].consumer.data(); }

    bool take(unsigned line, bool active_low, const char* consumer, bool active) noexcept;
    bool set(unsigned line, bool active) noexcept;
    void give_back(unsigned line) noexcept;

private:
    Handle(int fd, Chip* chip) noexcept;
    bool pin(unsigned line, bool high) noexcept;

    int fd_;
    Chip* chip_;
    std::uint32_t generation_;
};

} // namespace dpslave::stand_in
