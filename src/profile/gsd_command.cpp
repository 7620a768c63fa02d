// SPDX-License-Identifier: Apache-2.0
#include "gsd_command.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

class Command {
public:
    explicit Command(const std::string& profile) : text_("dpctl gsd make --profile " + profile) {}

    void option(std::string_view name, const std::string& value)
    {
        if (!value.empty()) text_ += " --" + std::string{name} + ' ' + value;
    }

    void quoted(std::string_view name, const std::optional<std::string>& value, const std::string& fallback)
    {
        if (value && *value != fallback) option(name, '"' + gsd::latin1(*value) + '"');
    }

    void parameters(const std::vector<GsdParameter>& words)
    {
        const auto is_before = [](const GsdParameter& a, const GsdParameter& b) {
            return a.direction < b.direction;
        };
        if (!std::is_sorted(words.begin(), words.end(), is_before)) {
            std::string list;
            for (const GsdParameter& word : words) list += (list.empty() ? "" : ",") + to_string(word);
            return option("order", list);
        }
        for (const Direction direction : {Direction::in, Direction::out, Direction::in_out}) {
            std::string tags;
            for (const GsdParameter& word : words)
                if (word.direction == direction) tags += (tags.empty() ? "" : ",") + std::to_string(word.tag);
            option(profile::text(direction), tags);
        }
    }

    void flag(std::string_view name) { text_ += " --" + std::string{name}; }
    std::string text() { return std::move(text_); }

private:
    std::string text_;
};

} // namespace

std::string hex_of(std::uint16_t word)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    return {'0', 'x', digits[word >> 12], digits[word >> 8 & 15], digits[word >> 4 & 15], digits[word & 15]};
}

std::string make_command(const Profile& profile, const Selection& selection,
                         const std::optional<std::vector<GsdParameter>>& words,
                         const std::string& description)
{
    if (!selection.modules.empty() || selection.lengths != PlantLengths{}) // no option says them
        return "dpctl gsd make --mapping FILE";
    Command command{profile.name};
    const bool has_own = !profile.gsd.in_tags.empty() || !profile.gsd.out_tags.empty();
    if (words && words->empty() && has_own)
        command.option("order", "none");
    else if (words)
        command.parameters(*words);
    if (selection.tags) {
        std::string tags;
        for (const std::uint16_t tag : *selection.tags)
            tags += (tags.empty() ? "" : ",") + std::to_string(tag);
        command.option("tags", tags);
    }
    if (selection.demand) command.flag("demand");
    if (selection.tags_at) command.option("tags-at", std::to_string(*selection.tags_at));
    std::string identifiers;
    for (const dp::Identifier& one : selection.identifiers)
        identifiers += (identifiers.empty() ? "" : ",") + profile::to_string(one);
    if (!identifiers.empty()) command.option("identifiers", '"' + identifiers + '"');
    if (selection.ident && selection.ident != profile.ident)
        command.option("ident", hex_of(*selection.ident));
    if (selection.max_tsdr) command.option("max-tsdr", std::to_string(*selection.max_tsdr));
    command.quoted("model", selection.model, profile.gsd.model);
    command.quoted("description", selection.description, description);
    return command.text();
}

} // namespace dpslave::profile
