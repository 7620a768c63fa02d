// SPDX-License-Identifier: Apache-2.0
/// The other end of the cable: a pty whose master the test holds.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/io/fd.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

namespace dpslave::io {

class Pty {
public:
    Pty() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
    {
        char name[64] = {};
        if (!master_ || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
            ::ptsname_r(master_.get(), name, sizeof name) != 0)
            throw std::system_error{errno, std::system_category(), "pty"};
        path_ = name;
    }

    const std::string& path() const { return path_; }
    int fd() const { return master_.get(); }
    std::uint32_t rate() const; ///< bit/s that the slave end is set to
    void hang_up() { master_.reset(); }

    void send(const std::vector<std::uint8_t>& octets)
    {
        if (::write(fd(), octets.data(), octets.size()) != static_cast<ssize_t>(octets.size()))
            throw std::system_error{errno, std::system_category(), "pty write"};
    }

    /// All that has come up to now.
    std::vector<std::uint8_t> received()
    {
        std::vector<std::uint8_t> all;
        std::uint8_t part[4096];
        for (ssize_t got = 0; (got = ::read(fd(), part, sizeof part)) > 0;)
            all.insert(all.end(), part, part + got);
        return all;
    }

private:
    Fd master_;
    std::string path_;
};

} // namespace dpslave::io
