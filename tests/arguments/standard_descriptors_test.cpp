// SPDX-License-Identifier: Apache-2.0
// Tests that no file gets the number of a standard descriptor that was closed when the program began (H1).
#include "dpslave/arguments/standard_descriptors.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>

namespace dpslave::test {
namespace {

/// What the descriptor is open on; empty: it is closed.
std::string target(int descriptor)
{
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), error);
}

/// Closes the descriptors of which the bit in `closed` is set, and puts them back at the end.
class Closed {
public:
    explicit Closed(unsigned closed)
    {
        std::fflush(nullptr);
        for (int i = 0; i < 3; ++i) saved_[static_cast<std::size_t>(i)] = ::fcntl(i, F_DUPFD_CLOEXEC, 10);
        for (int i = 0; i < 3; ++i)
            if ((closed >> i & 1U) != 0) ::close(i);
    }
    ~Closed()
    {
        for (int i = 0; i < 3; ++i) {
            ::dup2(saved_[static_cast<std::size_t>(i)], i);
            ::close(saved_[static_cast<std::size_t>(i)]);
        }
    }
    Closed(const Closed&) = delete;
    Closed& operator=(const Closed&) = delete;

private:
    std::array<int, 3> saved_{};
};

TEST(StandardDescriptors, ThatAreClosedAreOpenedOnDevNullAndTheOthersStayAsTheyAre)
{
    for (unsigned closed = 0; closed < 8; ++closed) {
        std::array<std::string, 3> before, after;
        int next = -1;
        bool takes_octets = false;
        {
            const Closed some{closed};
            for (int i = 0; i < 3; ++i) before[static_cast<std::size_t>(i)] = target(i);

            arguments::fill_standard_descriptors();

            for (int i = 0; i < 3; ++i) {
                after[static_cast<std::size_t>(i)] = target(i);
                if ((closed >> i & 1U) != 0 && ::write(i, "x", 1) >= 0) takes_octets = true;
            }
            next = ::open("/dev/null", O_RDWR | O_CLOEXEC); // as a port is opened
            ::close(next);
        }
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(after[i], (closed >> i & 1U) != 0 ? "/dev/null" : before[i]) << closed << ", " << i;
        EXPECT_GT(next, 2) << closed;
        EXPECT_FALSE(takes_octets) << closed << ": the program would believe that it was read";
    }
}

} // namespace
} // namespace dpslave::test
