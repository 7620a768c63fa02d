// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/port_users.hpp"

#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

/// Returns nothing where there is no such device.
std::optional<dev_t> device_of(const fs::path& path)
{
    struct stat there {};
    if (::stat(path.c_str(), &there) != 0 || !S_ISCHR(there.st_mode)) return std::nullopt;
    return there.st_rdev;
}

std::string line_of(const fs::path& file)
{
    std::string line;
    std::ifstream in{file};
    std::getline(in, line);
    return line;
}

struct ProcessStat {
    bool is_of_kernel = false;
    unsigned long terminal = 0; ///< the controlling one
};
/// As proc(5) has it: ppid and tty_nr, the fourth and the seventh field of stat.
ProcessStat stat_of(const fs::path& process)
{
    constexpr long kKernelThreads = 2; // kthreadd has no files, and is the parent of all that have none
    const std::string line = line_of(process / "stat");
    const auto name_ends = line.rfind(')'); // a name may have spaces and parentheses
    if (name_ends == std::string::npos) return {};
    std::istringstream rest{line.substr(name_ends + 1)};
    std::string state;
    long parent = 0, group = 0, session = 0, terminal = 0;
    rest >> state >> parent >> group >> session >> terminal;
    if (!rest) return {};
    return {.is_of_kernel = parent == kKernelThreads, .terminal = static_cast<unsigned long>(terminal)};
}

/// The minor number is split: its low octet is the lowest, the others are above the major number.
unsigned long terminal_number(dev_t device)
{
    const unsigned long minor_number = minor(device);
    return (minor_number & 0xFFU) | (static_cast<unsigned long>(major(device)) << 8U) |
           ((minor_number & ~0xFFUL) << 12U);
}

/// A file of a process is the other end of this pty, as a simulated line has it.
bool is_other_end(const fs::path& process, const fs::path& file, dev_t device)
{
    constexpr unsigned kFirst = 136, kLast = 143; // the major numbers of ptys (devices.txt of Linux)
    if (major(device) < kFirst || major(device) > kLast) return false;
    const unsigned long index = (major(device) - kFirst) * 256UL + minor(device);
    std::ifstream info{process / "fdinfo" / file.filename()};
    for (std::string line; std::getline(info, line);)
        if (line == "tty-index:\t" + std::to_string(index)) return true;
    return false;
}

/// Returns nothing where this user may not look. Who has made the pty is no other user of it.
std::optional<bool> has_open(const fs::path& process, dev_t device)
{
    std::error_code error;
    fs::directory_iterator files{process / "fd", error};
    if (error == std::errc::permission_denied) return std::nullopt;
    bool is_open = false;
    for (; !error && files != fs::directory_iterator{}; files.increment(error)) {
        is_open = is_open || device_of(files->path()) == device;
        if (is_other_end(process, files->path(), device)) return false;
    }
    return is_open;
}

/// "ttyS0 -W- (EC p a) 4:64": a console of the kernel with its device.
bool is_console(const fs::path& proc, dev_t device)
{
    const std::string wanted = std::to_string(major(device)) + ":" + std::to_string(minor(device));
    std::ifstream consoles{proc / "consoles"};
    for (std::string line; std::getline(consoles, line);) {
        const auto number = line.find_last_of(' ');
        if (number != std::string::npos && line.substr(number + 1) == wanted) return true;
    }
    return false;
}

std::optional<int> pid_of(const fs::path& folder)
{
    const std::string name = folder.filename().string();
    const bool is_number =
        !name.empty() && name.size() < 10 &&
        std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
    return is_number ? std::optional{std::stoi(name)} : std::nullopt;
}

} // namespace

PortUsers users_of_port(const std::string& port, int mine, const fs::path& proc)
{
    PortUsers found{.port = port, .users = {}};
    const auto device = device_of(port);
    if (!device) return found;
    found.is_console = is_console(proc, *device);
    std::error_code error;
    for (fs::directory_iterator all{proc, error}; !error && all != fs::directory_iterator{};
         all.increment(error)) {
        const auto pid = pid_of(all->path());
        if (!pid || *pid == mine || *pid == ::getpid()) continue;
        const ProcessStat stat = stat_of(all->path());
        if (stat.is_of_kernel) continue;
        const auto is_open = has_open(all->path(), *device);
        if (is_open.value_or(false) || stat.terminal == terminal_number(*device))
            found.users.push_back({.pid = *pid, .name = line_of(all->path() / "comm")});
        else if (!is_open)
            ++found.hidden;
    }
    std::sort(found.users.begin(), found.users.end(),
              [](const PortUser& a, const PortUser& b) { return a.pid < b.pid; });
    return found;
}

std::string PortUsers::in_words() const
{
    std::string words;
    for (const PortUser& one : users)
        words +=
            (words.empty() ? "process " : ", process ") + std::to_string(one.pid) + " (" + one.name + ')';
    if (is_console)
        words += words.empty() ? "it is the console of the kernel" : ", and it is the console of the kernel";
    return words;
}

} // namespace dpslave::io
