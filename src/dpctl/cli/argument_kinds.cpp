// SPDX-License-Identifier: Apache-2.0
#include "argument_kinds.hpp"

#include "dpslave/base/typed.hpp"

namespace dpslave::dpctl {

std::string installed_profiles()
{
    return DPSLAVE_DATA_FOLDER "/profiles"; // given by CMake
}

void set_up(CLI::App& app, StationOptions& options)
{
    add_station(app, options.station);
}

void add_station(CLI::App& app, std::string& station, const char* help)
{
    CLI::Option* const word = add_text(app, "STATION", station, "", help);
    add_text(app, "-s,--station", station, "STATION", "The same, as an option")->excludes(word);
}

CLI::Option* add_station_option(CLI::App& app, std::string& station, const char* help)
{
    return add_text(app, "-s,--station", station, "STATION", help);
}

void add_tags(CLI::App& app, std::vector<std::string>& tags)
{
    const auto judge = [](const std::string& text) {
        const auto typed = read_tags(text);
        return typed ? std::string{} : typed.error();
    };
    app.add_option("TAG", tags, "Tags of the drive: numbers (55, 0x37, 55-57), or names or parts of them")
        ->type_name("")
        ->check(judge);
}

void add_follow(CLI::App& app, bool& follow)
{
    app.add_flag("-f,--follow", follow, "Continue until Ctrl-C and show each change");
}

CLI::Option* add_output(CLI::App& app, std::string& output, const char* help)
{
    return add_text(app, "-o,--output", output, "FILE", help);
}

void add_tag_spans(CLI::App& app, std::vector<TagSpan>& spans, const char* help)
{
    const auto judge = [](const std::string& text) {
        const auto typed = read_tag_spans(text);
        return typed ? std::string{} : typed.error();
    };
    app.add_option_function<std::string>(
           "--tags",
           [&spans](const std::string& text) {
               if (const auto typed = read_tag_spans(text)) spans = *typed;
           },
           help)
        ->type_name("LIST")
        ->check(judge);
}

void add_profiles(CLI::App& app, ProfilesOption& options, const char* help)
{
    add_text(app, "--profiles", options.profiles, "DIR", help);
}

void add_profile(CLI::App& app, std::string& profile, const char* what_it_does)
{
    add_text(app, "--profile", profile, "NAME", what_it_does);
}

std::vector<std::string> mnemonic_rules()
{
    return {"590plus", "ac", "pno", "none"};
}

} // namespace dpslave::dpctl
