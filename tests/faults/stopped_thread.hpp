// SPDX-License-Identifier: Apache-2.0
/// One thread of another process that stands still, as a debugger makes it, while the others go on.
#pragma once

#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace dpslave::test {

/// The thread of this name; throws if there is none.
inline pid_t thread_of(pid_t process, const std::string& name)
{
    for (const auto& one :
         std::filesystem::directory_iterator{"/proc/" + std::to_string(process) + "/task"}) {
        std::string its_name;
        std::ifstream{one.path() / "comm"} >> its_name;
        if (its_name == name) return std::stoi(one.path().filename());
    }
    throw std::runtime_error("there is no thread " + name);
}

/// It goes on when this object ends.
class StoppedThread {
public:
    /// `is_process`: it is the first thread of its process, whose end is waited for elsewhere.
    explicit StoppedThread(pid_t thread, bool is_process = false) : thread_(thread), is_process_(is_process)
    {
        if (::ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) != 0 ||
            ::ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr) != 0 ||
            ::waitpid(thread_, nullptr, __WALL) != thread_)
            throw std::system_error{errno, std::system_category(), "ptrace"};
    }
    ~StoppedThread()
    {
        // One that has died with its process keeps it until somebody has taken note.
        if (::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr) != 0 && !is_process_)
            ::waitpid(thread_, nullptr, __WALL | WNOHANG);
    }
    StoppedThread(const StoppedThread&) = delete;
    StoppedThread& operator=(const StoppedThread&) = delete;

private:
    pid_t thread_;
    bool is_process_;
};

} // namespace dpslave::test
