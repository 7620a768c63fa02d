// SPDX-License-Identifier: Apache-2.0
/// The thread that writes the log. Whatever stands behind it may stop to take octets: a terminal that nobody
/// reads, the journal, a file on a disk that does not answer. Only this thread waits for it.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace dpslave::io {

class LogThread {
public:
    /// Octets that wait to be written at most.
    static constexpr std::size_t kMostWaiting = 16 * 1024;

    /// `fd` is not closed, and outlives the program's last line. Throws std::system_error when the system has
    /// no thread or no descriptor left.
    explicit LogThread(int fd);
    /// Waits for what is to be written as finish(kEndWait) does, and leaves a thread that hangs to itself.
    ~LogThread();
    LogThread(const LogThread&) = delete;
    LogThread& operator=(const LogThread&) = delete;

    /// From any thread, without a wait; with its end. False: there is no room, and the line is lost.
    bool put(std::string line);
    /// Returns how many of them could not be written since the last call: a disk that is full.
    std::uint64_t take_lost();
    /// Waits until everything is written, or has been tried for `limit`. False: not all of it is.
    bool finish(std::chrono::milliseconds limit);
    /// The last line of a program that ends behind it, as finish(). No lock is taken: another thread may
    /// stand still while it has one. `line` lives as long as the program.
    bool say_last(const char* line, std::chrono::milliseconds limit);

    static constexpr std::chrono::milliseconds kLastWait{200}; ///< where all the time of the end is used up
    static constexpr std::chrono::seconds kEndWait{2};         ///< a machine without time writes it, too

private:
    struct Shared;
    static void serve(Shared& shared);
    std::shared_ptr<Shared> shared_; ///< of both threads
};

} // namespace dpslave::io
