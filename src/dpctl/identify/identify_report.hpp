// SPDX-License-Identifier: Apache-2.0
/// What `dpctl identify` says of a search, and the blocks of the configuration that fit. Pure.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/io/driver_enable.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/report/types.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// How a search ended.
enum class SearchEnd : std::uint8_t {
    complete,
    interrupted,  ///< Ctrl-C
    time_is_over, ///< it took longer than was said
    full,         ///< more units answer than are asked
    failed,       ///< the port
};

struct Identified {
    std::string port;
    SearchEnd end = SearchEnd::complete;
    std::int64_t asked = 0, most = 0;
    std::chrono::seconds took{};
    std::vector<report::Answering> answering{};
    std::int64_t unsure = 0, damaged = 0; ///< of LineSearch
    bool hears_itself = false;
    std::vector<std::string> refused{};   ///< what the port cannot do
    std::vector<std::string> not_asked{}; ///< what the search leaves out by its plan
    io::DriverEnableSettings driver{};
    std::chrono::milliseconds timeout{};
    std::string table{};                      ///< an absolute path; empty: none was named
    std::vector<profile::Profile> profiles{}; ///< of the folder
};

/// What answers, under which rule which tags, in lines; of the daemon's probe, too.
std::string render_answering(const report::Answering& one, Look look);

/// What could not be found out, a sentence each.
std::vector<std::string> not_found_out(const Identified& found);

/// [[line]] and [[station]]; empty where nothing answers. Comments say what is to be filled in.
std::string config_blocks(const Identified& found);

std::string render_identified(const Identified& found, Look look);
Json identified_json(const Identified& found);

} // namespace dpslave::dpctl
