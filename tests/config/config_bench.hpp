// SPDX-License-Identifier: Apache-2.0
/// A configuration file in a folder of its own, with profiles and tag tables beside it, and what
/// load_config() makes of it.
#pragma once

#include "profile/files.hpp"
#include "support/paths.hpp"

#include "dpslave/config/config.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace dpslave::test {

inline const std::filesystem::path kSource{source_path()};

/// The lines are counted by the tests below: change nothing in front of what they name.
inline constexpr const char* kGood = R"([bus]
port = "/dev/null-bus"
baud = 187500
direction = "none"

[control]
operator_group = "root"

[[line]]
name = "p3"
port = "/dev/null-p3"
protocol = "ei-ascii"

[[station]]
name = "unwinder"
address = 5
profile = "590"
line = "p3"
unit = "00"
)";

inline constexpr const char* kSecondStation = R"(
[[station]]
name = "winder"
address = 6
profile = "620"
line = "p3"
unit = "01"
)";

class ConfigFile : public testing::Test {
protected:
    ConfigFile()
    {
        for (const auto& file : std::filesystem::directory_iterator{kSource / "config/profiles"})
            folder_.write("profiles/" + file.path().filename().string(), without_assumption(file.path()));
        for (const auto& file : std::filesystem::directory_iterator{kSource / "config/tags"})
            folder_.write("tags/" + file.path().filename().string(), content_of(file.path()));
        folder_.write("tags/empty.csv", "tag,name,type,decimals\n55,SPEED,INT,0\n1200,MOTTO,STRING,\n");
    }

    Result<config::Config, input::Faults> load(std::string_view content) const
    {
        return config::load_config(folder_.write("etc/dpslaved.toml", content), folder_.path() / "profiles");
    }

    config::Config good(std::string_view content) const
    {
        auto config = load(content);
        if (config) return *std::move(config);
        for (const auto& fault : config.error()) ADD_FAILURE() << to_string(fault);
        return {};
    }

    input::Faults bad(std::string_view content) const
    {
        const auto config = load(content);
        EXPECT_FALSE(config);
        return config ? input::Faults{} : config.error();
    }

    /// Copies the profile 590 under another name, with one change.
    void change_profile(const std::string& name, std::string_view from, std::string_view to) const
    {
        std::string text = with(without_assumption(kSource / "config/profiles/590.toml"), from, to);
        if (to.find("\"none\"") != std::string_view::npos) { // then nothing has a source
            text = with(text, "\nmnemonic_source  = \"590+ formula; no source for the 590\"", "");
            text = with(text, "\nmnemonic_assumed = false", "");
        }
        folder_.write("profiles/" + name + ".toml", text);
    }

    /// Every station whose mnemonic rule is assumed is warned of; these tests are about other things.
    static std::string without_assumption(const std::filesystem::path& profile)
    {
        const std::string text = content_of(profile);
        const std::string assumed = "\nmnemonic_assumed = true";
        return text.find(assumed) == std::string::npos ? text
                                                       : with(text, assumed, "\nmnemonic_assumed = false");
    }

    Folder folder_;
};

struct BadChange {
    const char* from;
    const char* to;
    const char* place;    ///< "line:column: "
    const char* sentence; ///< a part of it
};

inline void PrintTo(const BadChange& change, std::ostream* out)
{
    *out << case_name(std::string{change.sentence} + " for " + change.to);
}

} // namespace dpslave::test
