// SPDX-License-Identifier: Apache-2.0
/// An open file descriptor that closes itself: one owner, moved but never copied.
#pragma once

#include <utility>

namespace dpslave::io {

class Fd {
public:
    Fd() = default;
    /// Takes over `fd`; a negative number (the result of a call that failed) owns nothing.
    explicit Fd(int fd) noexcept : fd_(fd) {}
    Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Fd& operator=(Fd&& other) noexcept
    {
        if (this != &other) {
            reset();
            fd_ = std::exchange(other.fd_, -1);
        }
        return *this;
    }
    Fd(const Fd&) = delete;
    Fd& operator=(const Fd&) = delete;
    ~Fd() { reset(); }

    int get() const noexcept { return fd_; }
    explicit operator bool() const noexcept { return fd_ >= 0; }

    /// Closes now. errno stays as it was.
    void reset() noexcept;

private:
    int fd_ = -1;
};

} // namespace dpslave::io
