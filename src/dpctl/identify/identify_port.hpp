// SPDX-License-Identifier: Apache-2.0
/// The serial port of `dpctl identify`: opened anew for each question, so that an answer that comes late
/// belongs to nobody.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/drive/line_search.hpp"
#include "dpslave/io/driver_enable.hpp"

#include <chrono>
#include <map>
#include <set>
#include <string>

namespace dpslave::dpctl {

class IdentifyPort {
public:
    IdentifyPort(std::string path, io::DriverEnableSettings driver, std::chrono::milliseconds timeout)
        : path_(std::move(path)), driver_(std::move(driver)), timeout_(timeout)
    {}

    /// One question. A rate or format that the port cannot do counts as silence, see refused(). The error is
    /// a sentence: the port cannot be used at all, or not any more.
    Result<drive::Sight, std::string> ask(const drive::SearchQuestion& question);

    bool was_open() const { return was_open_; }
    bool hears_itself() const { return hears_itself_; } ///< a question came back
    std::set<std::string> refused() const;              ///< sentences about what the port cannot do

private:
    struct Asked {
        drive::Sight sight;
        bool has_echo = false;
    };
    Result<Asked, std::string> ask_ei(const drive::SearchQuestion& question) const;
    Result<Asked, std::string> ask_modbus(const drive::SearchQuestion& question) const;

    std::string path_;
    io::DriverEnableSettings driver_;
    std::chrono::milliseconds timeout_;
    bool was_open_ = false, hears_itself_ = false;
    std::map<std::string, std::uint32_t> refused_; ///< the sentence, and the rate that was the first
};

/// Why `path` cannot be used and what to do: a sentence. `why`: of io::PortSettings::save().
std::string port_sentence(const std::string& path, const std::error_code& why);

} // namespace dpslave::dpctl
