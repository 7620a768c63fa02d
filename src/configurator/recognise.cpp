// SPDX-License-Identifier: Apache-2.0
#include "recognise.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/gsd/device.hpp"
#include "dpslave/profile/gsd_judge.hpp"

#include <algorithm>
#include <functional>

namespace dpslave::configurator {
namespace {

/// Its words in small letters, "590+" as "590plus".
std::vector<std::string> words_of(std::string_view text)
{
    std::vector<std::string> words(1);
    for (const char c : to_lower(text))
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
            words.back() += c;
        else if (c == '+')
            words.back() += "plus";
        else
            words.emplace_back();
    std::erase(words, "");
    return words;
}

/// "EUROTHERM" and "EUROTHERM CONTROLS" may be one vendor: they share a word.
bool may_be_same_vendor(const std::string& a, const std::string& b)
{
    const std::vector<std::string> ours = words_of(b), theirs = words_of(a);
    return std::find_first_of(theirs.begin(), theirs.end(), ours.begin(), ours.end()) != theirs.end();
}

/// The profile that the comment of a file made here names; empty: there is none.
std::string named_in_comment(std::string_view file)
{
    constexpr std::string_view kBefore = "; Made for the profile ", kBehind = " of dpslaved";
    const auto at = file.find(kBefore);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = file.substr(at + kBefore.size());
    const auto end = rest.find(kBehind);
    return end == std::string_view::npos ? std::string{} : std::string{rest.substr(0, end)};
}

class Recogniser {
public:
    Recogniser(const Files& files, const gsd::Document& document) : document_(document)
    {
        const input::TextSource without_tags =
            [&](const std::string& name) -> Result<std::string, Unreadable> {
            if (name.ends_with(".csv"))
                return std::string{"tag,name,type\n"}; // no row matters here, and there are many
            return files.source(name);
        };
        for (const std::string& name : files.names)
            if (auto profile = profile::load_profile(without_tags, files.profiles, name))
                all_.push_back(*std::move(profile));
    }

    Recognised recognise(const std::string& in_comment)
    {
        if (document_.text("Model_Name").find("T630") != std::string::npos)
            return {}; // it has no profile
        const auto is_named = [&](const auto& profile) { return profile.name == in_comment; };
        if (auto one = those(is_named); !one.empty()) return {std::move(one)};

        using Profile = profile::Profile;
        const auto ident = [&](const Profile& p) {
            return p.ident && document_.number("Ident_Number") == *p.ident;
        };
        const auto model = [&](const Profile& p) {
            return document_.text("Model_Name") == gsd::latin1(p.gsd.model);
        };
        const auto word = [&](const Profile& p) {
            const auto words = words_of(document_.text("Model_Name"));
            return std::find(words.begin(), words.end(), p.name) != words.end();
        };
        const auto open = [&](const Profile& p) {
            return !p.ident && may_be_same_vendor(document_.text("Vendor_Name"), gsd::latin1(p.gsd.vendor));
        };
        const std::function<bool(const Profile&)> steps[] = {
            [&](const Profile& p) { return ident(p) && model(p); },
            [&](const Profile& p) { return ident(p) && word(p); },
            [&](const Profile& p) { return !p.ident && model(p); },
            [&](const Profile& p) { return open(p) && word(p); },
            ident,
        };
        for (const auto& step : steps)
            if (auto found = those(step); !found.empty()) return {narrowed(std::move(found))};
        if (auto found = those(model); !found.empty())
            return {std::move(found), true}; // the ident is another
        std::vector<Profile> of_vendor = those(open);
        std::vector<Profile> takers = taking(of_vendor);
        return {takers.empty() ? std::move(of_vendor) : std::move(takers), true};
    }

private:
    template <class Is>
    std::vector<profile::Profile> those(const Is& is) const
    {
        std::vector<profile::Profile> out;
        std::copy_if(all_.begin(), all_.end(), std::back_inserter(out), is);
        return out;
    }

    std::vector<profile::Profile> taking(const std::vector<profile::Profile>& some) const
    {
        std::vector<profile::Profile> out;
        for (const profile::Profile& profile : some)
            if (!profile::judge_file(personality_of(profile, keys_for(profile, document_, {})), document_)
                     .refused)
                out.push_back(profile);
        return out;
    }

    std::vector<profile::Profile> narrowed(std::vector<profile::Profile> some) const
    {
        if (some.size() < 2) return some;
        auto takers = taking(some);
        return takers.empty() ? some : takers;
    }

    const gsd::Document& document_;
    std::vector<profile::Profile> all_;
};

} // namespace

Recognised recognise(const Files& files, std::string_view file, const gsd::Document& document)
{
    return Recogniser{files, document}.recognise(named_in_comment(file));
}

std::string names_of(const std::vector<profile::Profile>& profiles)
{
    std::string all;
    for (std::size_t i = 0; i < profiles.size(); ++i)
        all += (i == 0 ? "" : i + 1 == profiles.size() ? " or " : ", ") + profiles[i].name;
    return all;
}

profile::StationKeys keys_for(const profile::Profile& profile, const gsd::Document& document,
                              const profile::StationKeys& said)
{
    profile::StationKeys keys = said;
    const auto ident = document.number("Ident_Number");
    if (!keys.ident && !profile.ident && ident && *ident > 0 && *ident <= 0xFFFF)
        keys.ident = static_cast<std::uint16_t>(*ident);
    return keys;
}

} // namespace dpslave::configurator
