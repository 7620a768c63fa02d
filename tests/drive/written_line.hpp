// SPDX-License-Identifier: Apache-2.0
/// An EI-ASCII line on which comes what the test has written down, each piece in one read. Time passes only
/// here.
#pragma once

#include "dpslave/drive/serial_line.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

namespace dpslave::drive::test {

class WrittenLine : public SerialLine {
public:
    static constexpr std::uint32_t kBaud = 10'000; ///< 1 ms for each character
    Instant time{std::chrono::hours{1}};

    /// So long after now.
    void comes(const std::string& octets, std::chrono::nanoseconds after)
    {
        coming_.emplace(time + after, octets);
    }
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override
    {
        if (timeout.count() < 0) throw std::logic_error{"a read cannot wait for less than no time"};
        if (coming_.empty() || coming_.begin()->first > time + timeout) {
            time += timeout;
            return 0;
        }
        const auto [at, octets] = *coming_.begin();
        coming_.erase(coming_.begin());
        time = std::max(time, at);
        std::copy(octets.begin(), octets.end(), into.begin());
        return octets.size();
    }
    Instant now() const override { return time; }
    void discard() override {}

protected:
    ~WrittenLine() = default;

private:
    std::multimap<Instant, std::string> coming_;
};

} // namespace dpslave::drive::test
