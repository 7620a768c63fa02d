// SPDX-License-Identifier: Apache-2.0
/// Programs as on a terminal: started, given lines, read line by line, ended.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace dpslave::test {

/// How long something may take that normally takes a moment: the machine may be slow and loaded.
inline constexpr std::chrono::seconds kLimit{60};

/// The output of a program, line by line; written by one thread, awaited by another.
class Transcript {
public:
    void add(std::string line);
    void close(); ///< nothing more will come

    /// Index of the first line from `from` on that holds `text`. Waits for it, at most `limit`, and not
    /// beyond the end of the transcript.
    std::optional<std::size_t> await(std::string_view text, std::size_t from,
                                     std::chrono::nanoseconds limit) const;

    std::vector<std::string> lines(std::size_t from = 0) const;
    std::size_t size() const;

private:
    std::optional<std::size_t> find(std::string_view text, std::size_t from) const;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::vector<std::string> lines_;
    bool closed_ = false;
};

/// A position in a transcript: each expectation goes on behind the last one.
class Reader {
public:
    explicit Reader(const Transcript& transcript) : transcript_(transcript) {}

    /// Waits for the next line that holds `text`; the position is then behind it.
    ::testing::AssertionResult says(std::string_view text, std::chrono::nanoseconds limit = kLimit);
    void skip() { at_ = transcript_.size(); }           ///< the position goes behind all output until now
    std::size_t how_often(std::string_view text) const; ///< behind the position, until now

private:
    const Transcript& transcript_;
    std::size_t at_ = 0;
};

using Environment = std::map<std::string, std::string>;

/// A running program. It is killed when this object or the test ends, whichever is first; after a failed test
/// all that it said is shown.
class Process {
public:
    /// `command`: path and arguments. `environment` is added to that of the test. Throws if it cannot be
    /// started.
    explicit Process(std::vector<std::string> command, const Environment& environment = {});
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send_line(std::string_view line); ///< on its standard input; nothing happens if it is gone

    ::testing::AssertionResult says(std::string_view text, std::chrono::nanoseconds limit = kLimit)
    {
        return said_.says(text, limit);
    }
    void skip() { said_.skip(); }
    std::size_t how_often(std::string_view text) const { return said_.how_often(text); }
    bool ever_said(std::string_view text) const { return Reader{transcript_}.how_often(text) > 0; }

    pid_t pid() const { return pid_; }
    const Transcript& transcript() const { return transcript_; } ///< standard output and standard error

    /// Its exit status when it ends by itself within `limit`; 128 + N after signal N; nothing: it still runs.
    std::optional<int> wait(std::chrono::nanoseconds limit = kLimit);
    void send(int signal); ///< one that it does not end by; nothing happens if it is gone
    /// Sends it a signal, by which it should end, and waits.
    std::optional<int> end(int signal = SIGTERM);

private:
    void listen(int out, int err);

    std::string name_;
    Transcript transcript_;
    Reader said_{transcript_};
    pid_t pid_ = -1;
    int pidfd_ = -1;
    int input_ = -1;
    std::optional<int> status_;
    std::string out_, err_; ///< of the listener until it has ended
    std::thread listener_;

    friend struct Outcome run(std::vector<std::string> command, const Environment& environment);
};

/// A program that was run to its end.
struct Outcome {
    int status = -1; ///< -1: it did not end in time
    std::string out, err;
};
/// Runs a program that ends by itself.
Outcome run(std::vector<std::string> command, const Environment& environment = {});

/// For what gives no sign when it happens: asks again and again until it holds.
template <class Holds>
::testing::AssertionResult eventually(Holds holds, std::chrono::nanoseconds limit = kLimit)
{
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end)
            return ::testing::AssertionFailure() << "it did not come true in time";
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    return ::testing::AssertionSuccess();
}

} // namespace dpslave::test
