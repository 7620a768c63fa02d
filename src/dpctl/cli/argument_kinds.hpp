// SPDX-License-Identifier: Apache-2.0
/// Arguments and options that several commands have.
#pragma once

#include "profiles_option.hpp"

#include "dpslave/arguments/options.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dpslave::dpctl {

using arguments::add_choice, arguments::add_list, arguments::add_number, arguments::add_rate,
    arguments::add_text, arguments::add_time, arguments::Between;

/// The options of a command that only names a station.
struct StationOptions {
    std::string station; ///< name or address; empty = all
};
void set_up(CLI::App& app, StationOptions& options);

/// STATION as a word of its own, or --station. `help`: what it means.
void add_station(CLI::App& app, std::string& station, const char* help = "Name or address; without it: all");
/// --station alone: of a command whose words are something else.
CLI::Option* add_station_option(CLI::App& app, std::string& station,
                                const char* help = "Name or address; required if there are several");
/// TAG..., judged. read_tags() reads each word.
void add_tags(CLI::App& app, std::vector<std::string>& tags);
void add_follow(CLI::App& app, bool& follow);
/// --output FILE.
CLI::Option* add_output(CLI::App& app, std::string& output, const char* help);
/// --tags LIST: numbers and ranges.
void add_tag_spans(CLI::App& app, std::vector<TagSpan>& spans, const char* help);

/// --profiles DIR.
void add_profiles(CLI::App& app, ProfilesOption& options,
                  const char* help = "Folder of the device profiles; the tag tables are in ../tags");
/// --profile NAME.
void add_profile(CLI::App& app, std::string& profile, const char* what_it_does);

/// The rules of the mnemonics that can be named.
std::vector<std::string> mnemonic_rules();

} // namespace dpslave::dpctl
