// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/log_thread.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/realtime.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

namespace dpslave::io {
namespace {

void await(int fd, short events)
{
    pollfd there{.fd = fd, .events = events, .revents = 0};
    ::poll(&there, 1, -1);
}

/// However long it takes. Returns how many octets were taken before an error, as of a disk that is full or of
/// a reader that has gone.
std::size_t write_all(int fd, std::string_view text)
{
    std::size_t taken = 0;
    while (taken < text.size()) {
        const ssize_t written = ::write(fd, text.data() + taken, text.size() - taken);
        if (written >= 0)
            taken += static_cast<std::size_t>(written);
        else if (errno == EAGAIN) // another one that has the terminal has set O_NONBLOCK
            await(fd, POLLOUT);
        else if (errno != EINTR)
            break;
    }
    return taken;
}

/// A thread that is made meanwhile takes no signal.
class NoSignals {
public:
    NoSignals()
    {
        sigset_t all{};
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    NoSignals(const NoSignals&) = delete;
    NoSignals& operator=(const NoSignals&) = delete;

private:
    sigset_t before_{};
};

} // namespace

/// The mutex is held for moments only, never while something is written.
struct LogThread::Shared {
    explicit Shared(int to) : fd(to) {}
    const int fd;
    EventFd bell;
    std::mutex mutex;
    std::deque<std::string> waiting;
    std::size_t octets = 0;             ///< that wait
    std::atomic<std::size_t> behind{0}; ///< lines that are not written yet, the one in the call too
    std::atomic<const char*> last_line{nullptr};
    std::atomic<std::uint64_t> lost{0};
    std::atomic<bool> ends{false};
    bool is_cut = false; ///< the last line has no end

    std::string take();
    void write(std::string_view line);
    bool is_written(std::chrono::milliseconds limit) const;
};

/// Empty: there is none.
std::string LogThread::Shared::take()
{
    const std::lock_guard lock{mutex};
    if (waiting.empty()) return {};
    std::string one = std::move(waiting.front());
    waiting.pop_front();
    octets -= one.size();
    return one;
}

/// On the thread.
void LogThread::Shared::write(std::string_view line)
{
    if (is_cut && write_all(fd, "\n") == 1) is_cut = false;
    const std::size_t taken = is_cut ? 0 : write_all(fd, line);
    is_cut = is_cut || (taken != 0 && taken < line.size());
    if (taken < line.size()) ++lost;
    --behind;
}

bool LogThread::Shared::is_written(std::chrono::milliseconds limit) const
{
    const Instant end = monotonic_now() + limit;
    while (behind.load() != 0 && monotonic_now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    return behind.load() == 0;
}

LogThread::LogThread(int fd) : shared_(std::make_shared<Shared>(fd))
{
    const NoSignals while_it_is_made;
    std::thread{[shared = shared_] { serve(*shared); }}.detach();
}

LogThread::~LogThread()
{
    finish(kEndWait);
    shared_->ends.store(true);
    shared_->bell.ring();
}

void LogThread::serve(Shared& shared)
{
    name_thread("log");
    while (!shared.ends.load()) {
        await(shared.bell.fd(), POLLIN);
        shared.bell.clear();
        if (const char* const last = shared.last_line.exchange(nullptr)) shared.write(last);
        for (std::string one; !shared.ends.load() && !(one = shared.take()).empty();) shared.write(one);
        unlock_deep_stack(0); // it may wait for a page
    }
}

bool LogThread::put(std::string line)
{
    if (line.empty()) return true;
    {
        const std::lock_guard lock{shared_->mutex};
        if (shared_->octets + line.size() > kMostWaiting) return false;
        shared_->octets += line.size();
        ++shared_->behind;
        shared_->waiting.push_back(std::move(line));
    }
    shared_->bell.ring();
    return true;
}

std::uint64_t LogThread::take_lost()
{
    return shared_->lost.exchange(0);
}

bool LogThread::finish(std::chrono::milliseconds limit)
{
    return shared_->is_written(limit);
}

bool LogThread::say_last(const char* line, std::chrono::milliseconds limit)
{
    ++shared_->behind;
    if (shared_->last_line.exchange(line) != nullptr) --shared_->behind; // the one before is not said
    shared_->bell.ring();
    return shared_->is_written(limit);
}

} // namespace dpslave::io
