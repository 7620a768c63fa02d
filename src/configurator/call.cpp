// SPDX-License-Identifier: Apache-2.0
// A request of the page: taken apart, passed on, and the outcome as JSON.
#include "device.hpp"
#include "facts.hpp"
#include "mapping.hpp"

#include "dpslave/base/base64.hpp"
#include "dpslave/configurator/configurator.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

/// `field`: the key of the mapping that is wrong; empty: another thing is.
Outcome wrong(std::string sentence, const std::string& field = {})
{
    Outcome outcome{.exit = kUsage, .refusals = {std::move(sentence)}};
    if (!field.empty()) outcome.facts = text_of({{"field", field}});
    return outcome;
}

constexpr std::size_t kMostBase64 = (kMostOctets + 2) / 3 * 4;
constexpr std::string_view kOwnTable = "own table/"; ///< the folder of the table that the request brings

class Request {
public:
    Request(const Json& request, const input::TextSource& source)
        : request_(request),
          source_(source),
          with_table_([this](const std::string& name) -> Result<std::string, Unreadable> {
              return name.starts_with(kOwnTable) ? text("table") : source_(name);
          })
    {}
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

    Outcome answer()
    {
        static constexpr struct {
            std::string_view name;
            Outcome (Request::*function)();
        } kRequests[] = {{"profiles", &Request::profiles},
                         {"tags", &Request::tags},
                         {"samples", &Request::samples},
                         {"make", &Request::make_file},
                         {"preview", &Request::preview},
                         {"check", &Request::check_file},
                         {"show", &Request::show_file},
                         {"import", &Request::import_of_file},
                         {"diff", &Request::diff_files},
                         {"mapping", &Request::write_mapping},
                         {"read_mapping", &Request::read_mapping_file}};
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

    std::optional<std::string> octets(const char* key) const
    {
        const std::string octets = text(key);
        if (!request_.contains(key) || octets.size() > kMostBase64) return std::nullopt;
        const auto file = from_base64(octets);
        if (!file) return std::nullopt;
        return std::string{file->begin(), file->end()};
    }

    Outcome no_file(const std::string& key) const
    {
        if (text(key.c_str()).size() > kMostBase64)
            return {.exit = kNo, .refusals = {"the file is larger than 1 MiB: it is no GSD file."}};
        return wrong('"' + key + "\" has to be a file in base64.");
    }

    bool flag(const char* key) const
    {
        const auto found = request_.find(key);
        return found != request_.end() && found->is_boolean() && found->get<bool>();
    }

    /// Returns the names from `index.txt` that are in `folder` and have `extension`, without both.
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

    /// The files of the page, and the user's own table under a name of its own.
    Files files() const { return {with_table_, "profiles", names_in("profiles/", ".toml")}; }

    std::string table_name() const
    {
        std::string name = text("table_name");
        name.erase(0, name.rfind('/') + 1);
        return name.empty() ? "table.csv" : name;
    }

    std::string table() const
    {
        return text("table").empty() ? std::string{} : std::string{kOwnTable} + table_name();
    }

    Outcome tags()
    {
        Outcome outcome;
        const auto profile = load(files(), text("profile"), table(), outcome);
        if (!profile) return outcome;
        Json all = Json::array();
        for (const drive::Tag* tag : profile->tags.in_table_order()) all.push_back(tag_of(*profile, *tag));
        outcome.facts = text_of({{"tags", all}});
        return outcome;
    }

    Outcome make_file()
    {
        const auto wanted = read_mapping(request_);
        if (!wanted) return wrong(wanted.error().sentence, wanted.error().key);
        return make(files(), *wanted, table(), text("name"));
    }

    /// Does the same as make_file(); but it is no failure if there would be no file.
    Outcome preview()
    {
        Outcome outcome = make_file();
        if (outcome.exit == kNo && outcome.facts != "{}") outcome.exit = kFine;
        return outcome;
    }

    Outcome show_file()
    {
        const auto file = octets("file");
        return file ? show(files(), *file, text("profile"), table()) : no_file("file");
    }

    Outcome import_of_file()
    {
        const auto file = octets("file");
        const auto cfg = profile::read_hex_octets(text("cfg")).value_or(std::vector<std::uint8_t>{});
        return file ? import_file(
                          files(), *file,
                          {.profile = text("profile"), .table = table(), .cfg = cfg, .lossy = flag("lossy")})
                    : no_file("file");
    }

    Outcome diff_files()
    {
        const auto left = octets("file"), right = octets("other");
        if (!left) return no_file("file");
        if (!right) return no_file("other");
        return diff(files(), *left, *right, text("profile"), table());
    }

    Outcome write_mapping()
    {
        const auto mapping = read_mapping(request_);
        if (!mapping) return wrong(mapping.error().sentence, mapping.error().key);
        profile::Mapping whole = *mapping;
        if (!table().empty()) whole.table = profile::OwnTable{table_name(), text("table")};
        Outcome outcome;
        const auto profile = load(files(), whole, "", outcome);
        if (profile) put_mapping_file(outcome, whole, profile->tags);
        return outcome;
    }

    Outcome read_mapping_file()
    {
        const auto file = octets("file");
        if (!file) return no_file("file");
        const std::string name = text("name").empty() ? "mapping" : text("name");
        const auto mapping = profile::load_mapping(
            [&](const std::string&) -> Result<std::string, Unreadable> { return *file; }, name);
        Outcome outcome;
        if (!mapping) {
            refuse(outcome, mapping.error());
            return outcome;
        }
        Json facts;
        add_mapping(facts, *mapping);
        outcome.facts = text_of(facts);
        return outcome;
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
            Json sample{{"name", name}};
            if (mapping)
                add_mapping(sample, *mapping);
            else
                refuse(outcome, mapping.error());
            if (mapping) all.push_back(sample);
        }
        outcome.facts = text_of({{"samples", all}});
        return outcome;
    }

    Outcome check_file()
    {
        const auto file = octets("file");
        if (!file) return no_file("file");
        CheckOptions how{.strict = flag("strict"), .profile = text("profile"), .table = table()};
        if (request_.contains("mapping")) { // the station that it is for has its keys
            const auto mapping = read_mapping(request_);
            if (!mapping) return wrong(mapping.error().sentence, mapping.error().key);
            how.profile = mapping->profile;
            how.keys = mapping->selection.keys();
        }
        return check(files(), *file, text("name"), how);
    }

    static void refuse(Outcome& outcome, const input::Faults& faults)
    {
        outcome.exit = kNo;
        for (const input::Fault& fault : faults) outcome.messages.push_back(to_string(fault));
    }

    const Json& request_;
    const input::TextSource& source_;
    const input::TextSource with_table_;
};

} // namespace

std::string reply_of(const Outcome& outcome)
{
    Json reply{{"exit", outcome.exit},
               {"lines", outcome.lines},
               {"messages", outcome.messages},
               {"refusals", outcome.refusals}};
    if (!outcome.octets.empty()) reply["octets"] = to_base64(bytes_of(outcome.octets));
    reply.update(Json::parse(outcome.facts, nullptr, false));
    return text_of(reply);
}

std::string call(std::string_view request, const input::TextSource& source)
{
    const Json read = Json::parse(request, nullptr, false);
    return reply_of(read.is_object() ? Request{read, source}.answer()
                                     : wrong("the request is no JSON object."));
}

} // namespace dpslave::configurator
