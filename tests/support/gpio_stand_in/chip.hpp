// SPDX-License-Identifier: Apache-2.0
/// The test's hands on a chip that is a file.
#pragma once

#include "chip_file.hpp"

#include <chrono>
#include <filesystem>
#include <string>

namespace dpslave::stand_in {

class ChipFile {
public:
    /// Makes the chip; a file of that name is overwritten.
    explicit ChipFile(std::filesystem::path path, const std::string& label = "stand-in", unsigned lines = 8);
    ~ChipFile();
    ChipFile(const ChipFile&) = delete;
    ChipFile& operator=(const ChipFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    bool high(unsigned line) const { return chip_->line.at(line).level.high != 0; }
    unsigned rises(unsigned line) const { return chip_->line.at(line).level.rises; }
    unsigned falls(unsigned line) const { return chip_->line.at(line).level.falls; }
    unsigned edges(unsigned line) const { return chip_->line.at(line).edges; }
    unsigned requests(unsigned line) const { return chip_->line.at(line).requests; }
    std::string consumer(unsigned line) const { return chip_->line.at(line).consumer.data(); }
    bool is_taken(unsigned line) const;
    /// As a process that died left it.
    void leave(unsigned line, bool high) { chip_->line.at(line).level.high = high ? 1 : 0; }
    /// Another process takes the line, until the end of this object.
    void occupy(unsigned line, const std::string& consumer);
    void remove();    ///< the chip is pulled: what was taken is dead
    void come_back(); ///< another chip of this name is there, its lines low
    void takes(std::chrono::microseconds edge) { chip_->edge_us = static_cast<std::uint32_t>(edge.count()); }
    /// What is written to `port` from now on is judged by this line.
    void watch(unsigned line, const std::filesystem::path& port, unsigned baud);
    const Watch& watched() const { return chip_->watch; }

private:
    std::filesystem::path path_;
    int fd_ = -1;
    Chip* chip_ = nullptr;
};

} // namespace dpslave::stand_in
