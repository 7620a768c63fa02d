// SPDX-License-Identifier: Apache-2.0
// A request of the page: taken apart, passed on, and the outcome as JSON.
#include "facts.hpp"

#include "dpslave/configurator/configurator.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

Outcome wrong(std::string sentence)
{
    return {.exit = kUsage, .refusals = {std::move(sentence)}};
}

class Request {
public:
    Request(const Json& request, const toml::TextSource& source) : request_(request), source_(source) {}

    Outcome answer()
    {
        static constexpr struct {
            std::string_view name;
            Outcome (Request::*function)();
        } kRequests[] = {{"profiles", &Request::profiles},
                         {"samples", &Request::samples},
                         {"check", &Request::check_file}};
        const std::string wanted = text("do");
        for (const auto& [name, function] : kRequests)
            if (name == wanted) return (this->*function)();
        return wrong("\"do\" is \"" + wanted + "\": this request is not answered.");
    }

private:
    std::string text(const char* key) const
    {
        const auto found = request_.find(key);
        return found != request_.end() && found->is_string() ? found->get<std::string>() : std::string{};
    }

    bool flag(const char* key) const
    {
        const auto found = request_.find(key);
        return found != request_.end() && found->is_boolean() && found->get<bool>();
    }

    /// Of `index.txt`, those in `folder` with `extension`, without both.
    std::vector<std::string> names_in(std::string_view folder, std::string_view extension) const
    {
        std::vector<std::string> names;
        const auto index = source_("index.txt");
        if (!index) return names;
        std::string_view rest = *index;
        while (!rest.empty()) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
            if (line.size() <= folder.size() + extension.size()) continue;
            if (line.starts_with(folder) && line.ends_with(extension))
                names.emplace_back(
                    line.substr(folder.size(), line.size() - folder.size() - extension.size()));
        }
        return names;
    }

    Outcome profiles()
    {
        Outcome outcome;
        Json all = Json::array();
        for (const std::string& name : names_in("profiles/", ".toml")) {
            const auto profile = profile::load_profile(source_, "profiles", name);
            if (profile)
                all.push_back(profile_of(*profile));
            else
                refuse(outcome, profile.error());
        }
        outcome.facts = text_of({{"profiles", all}});
        return outcome;
    }

    Outcome samples()
    {
        Outcome outcome;
        Json all = Json::array();
        for (const std::string& name : names_in("mappings/", ".toml")) {
            const auto mapping = profile::load_mapping(source_, "mappings/" + name + ".toml");
            if (mapping)
                all.push_back({{"name", name}, {"mapping", mapping_of(*mapping)}});
            else
                refuse(outcome, mapping.error());
        }
        outcome.facts = text_of({{"samples", all}});
        return outcome;
    }

    Outcome check_file()
    {
        const auto file = octets_of_base64(text("file"));
        if (!request_.contains("file") || !file) return wrong("\"file\" has to be a file in base64.");
        return check(*file, text("name"), flag("strict"));
    }

    static void refuse(Outcome& outcome, const toml::Faults& faults)
    {
        outcome.exit = kNo;
        for (const toml::Fault& fault : faults) outcome.messages.push_back(to_string(fault));
    }

    const Json& request_;
    const toml::TextSource& source_;
};

} // namespace

std::string call(std::string_view request, const toml::TextSource& source)
{
    const Json read = Json::parse(request, nullptr, false);
    const Outcome outcome =
        read.is_object() ? Request{read, source}.answer() : wrong("the request is no JSON object.");
    Json reply{{"exit", outcome.exit},
               {"lines", outcome.lines},
               {"messages", outcome.messages},
               {"refusals", outcome.refusals}};
    if (!outcome.octets.empty()) reply["octets"] = base64(outcome.octets);
    reply.update(Json::parse(outcome.facts, nullptr, false));
    return text_of(reply);
}

} // namespace dpslave::configurator
