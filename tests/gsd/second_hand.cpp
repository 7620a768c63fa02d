// SPDX-License-Identifier: Apache-2.0
#include "second_hand.hpp"

#include "dpslave/gsd/device.hpp"
#include "dpslave/io/file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace dpslave::test {

profile::Profile load(const std::string& name)
{
    auto profile = profile::load_profile(io::read_regular_file, kSource / "config/profiles", name);
    EXPECT_TRUE(profile) << to_string(profile.error().at(0));
    return profile ? *std::move(profile) : profile::Profile{};
}

std::string made(const profile::Profile& profile, profile::Selection selection)
{
    if (!profile.ident && !selection.ident) selection.ident = kOwnIdent;
    const auto device = profile::device_of(profile, selection);
    EXPECT_TRUE(device) << (device ? "" : device.error().at(0));
    return device ? gsd::write(device->device) : "";
}

std::vector<std::string> findings_of(const gsd::Findings& findings)
{
    std::vector<std::string> out;
    for (const gsd::Finding& finding : findings)
        out.push_back(std::to_string(finding.line) +
                      (finding.severity == gsd::Severity::error ? ": error: " : ": warning: ") +
                      finding.what);
    return out;
}

std::vector<std::string> findings_of(const std::string& content, gsd::Reading reading,
                                     const std::string& file_name)
{
    return findings_of(gsd::check(gsd::parse(content), reading, file_name));
}

std::vector<std::uint16_t> tags(std::uint16_t first, std::size_t count)
{
    std::vector<std::uint16_t> out(count);
    std::iota(out.begin(), out.end(), first);
    return out;
}

} // namespace dpslave::test
