// SPDX-License-Identifier: Apache-2.0
/// Who uses a serial port of this machine, by /proc and as far as the caller may look: for a person's
/// command. The daemon does not ask while it serves: it walks through all processes, and their files are
/// hidden from a service.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dpslave::io {

struct PortUser {
    int pid = 0;
    std::string name; ///< as ps(1) has it, 15 characters at most
    friend bool operator==(const PortUser&, const PortUser&) = default;
};

struct PortUsers {
    std::string port;
    std::vector<PortUser> users; ///< they have it open, or it is their terminal; by pid
    bool is_console = false;     ///< the kernel writes its messages there
    /// Processes of other users, of which only the terminal can be seen.
    std::size_t hidden = 0;

    bool is_shared() const { return is_console || !users.empty(); }
    /// "process 812 (agetty), and it is the console of the kernel"; empty: nobody that can be seen.
    std::string in_words() const;
};

/// `mine`: a process that may have the port, 0: none. A port that is not there has no users. `proc`: /proc,
/// or a tree like it in a test.
PortUsers users_of_port(const std::string& port, int mine = 0, const std::filesystem::path& proc = "/proc");

} // namespace dpslave::io
