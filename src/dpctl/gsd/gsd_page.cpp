// SPDX-License-Identifier: Apache-2.0
#include "gsd_page.hpp"

#include "dpctl/cli/terminal.hpp"

#include "dpslave/io/fd.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace dpslave::dpctl {
namespace {

/// xdg-open ends at once where a browser runs already. Else it may be the browser, and ends with it.
constexpr std::chrono::milliseconds kOpening{3000};

bool is_set(const char* variable)
{
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

std::string host()
{
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "HOST";
    return name.data();
}

/// True: it has not failed within kOpening.
bool waits_well(pid_t child)
{
    const io::Fd ended{static_cast<int>(::syscall(SYS_pidfd_open, child, 0))};
    pollfd poll{ended.get(), POLLIN, 0};
    if (ended && ::poll(&poll, 1, static_cast<int>(kOpening.count())) == 0) return true; // it goes on
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// In a session of its own: the end of this terminal does not end the browser.
bool opened(std::string page)
{
    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};
    if (::posix_spawn_file_actions_init(&files) != 0) return false;
    if (::posix_spawnattr_init(&attributes) != 0) {
        ::posix_spawn_file_actions_destroy(&files);
        return false;
    }
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        ::posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    std::string program = "xdg-open";
    const std::array<char*, 3> words{program.data(), page.data(), nullptr};
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, program.c_str(), &files, &attributes, words.data(), ::environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return error == 0 && waits_well(child);
}

/// What to do with the page where it cannot be opened.
std::vector<std::string> on_another_pc(const std::string& page)
{
    return {"The page is " + page + ".",
            "Copy this file to a PC, and open it there in a browser:", "  scp " + host() + ":" + page + " ."};
}

} // namespace

configurator::Outcome open_page(const std::string& page)
{
    std::error_code failed;
    if (!std::filesystem::is_regular_file(page, failed))
        return {.exit = kNo,
                .refusals = {page + " is not there. Install the package dpslaved-configurator."}};
    const std::string file = std::filesystem::absolute(page, failed).string();
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
        configurator::Outcome outcome{.lines = on_another_pc(file)};
        outcome.lines.insert(outcome.lines.begin(), "There is no desktop here.");
        return outcome;
    }
    if (opened(file)) return {.lines = {"The browser opens " + file + "."}};
    configurator::Outcome outcome{.exit = kNo, .lines = on_another_pc(file)};
    outcome.refusals = {"xdg-open could not open the page."};
    return outcome;
}

} // namespace dpslave::dpctl
