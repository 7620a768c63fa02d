// SPDX-License-Identifier: Apache-2.0
#include "parameter_notes.hpp"

#include <algorithm>
#include <set>

namespace dpslave::profile {
namespace {

void note_access(const Profile& profile, const GsdParameter& word, const std::string& name, Notes& notes)
{
    const drive::Tag* tag = profile.tags.find(word.tag);
    const auto& never = profile.never_written;
    const bool locked = std::find(never.begin(), never.end(), word.tag) != never.end();
    if (writes(word) && locked)
        notes.refuse("never_written",
                     name + " must never be written: the profile " + profile.name + " says so.");
    else if (writes(word) && tag != nullptr && tag->access == drive::Access::read_only)
        notes.refuse("read_only",
                     name + " (" + tag->name +
                         ") is read only, so it cannot be an output: choose it as input, or another one.");
    else if (writes(word) && tag != nullptr && tag->access == drive::Access::unknown)
        notes.warn(
            "access_unknown",
            name + " (" + tag->name +
                ") may be read only: no source says whether it can be written. Try it at the device before the plant relies on it.");
    else if (writes(word) && tag == nullptr && !profile.tags_only_from_table)
        notes.warn("access_unknown",
                   name + " is in no tag table, so it may be read only: look into the manual of the device.");
    if (tag != nullptr && tag->type == drive::TagType::string)
        notes.warn("text_tag", name + " (" + tag->name + ") is a text, which is not transported.");
}

std::string no_identifier_for(const Profile& profile, const GsdParameter& word)
{
    if (reads(word) && writes(word))
        return ": the profile " + profile.name +
               " has no identifier for a parameter that is both read and written: choose it once as input and once as output.";
    return std::string{": the station has no identifier for an "} + (reads(word) ? "input" : "output") +
           ": add one to its identifiers.";
}

} // namespace

bool reads(const GsdParameter& parameter)
{
    return parameter.direction != Direction::out;
}

bool writes(const GsdParameter& parameter)
{
    return parameter.direction != Direction::in;
}

const dp::Identifier* identifier_for(const dp::Personality& personality, const GsdParameter& word)
{
    const auto found = std::find_if(
        personality.identifiers.begin(), personality.identifiers.end(), [&](const dp::Identifier& each) {
            return (each.reads > 0) == reads(word) && (each.writes > 0) == writes(word);
        });
    return found == personality.identifiers.end() ? nullptr : &*found;
}

void note_parameters(const Profile& profile, const dp::Personality& personality,
                     const std::vector<GsdParameter>& words, Notes& notes)
{
    std::set<std::uint16_t> read, written;
    for (std::size_t at = 0; at < words.size(); ++at) {
        const GsdParameter& word = words[at];
        notes.at = at;
        const std::string name = "tag " + std::to_string(word.tag);
        if (identifier_for(personality, word) == nullptr)
            notes.refuse("no_such_direction", name + no_identifier_for(profile, word));
        note_tag(profile, word.tag, name, notes);
        if (reads(word) && !read.insert(word.tag).second)
            notes.refuse("read_twice", name + " is read twice: remove one.");
        if (writes(word) && !written.insert(word.tag).second)
            notes.refuse("written_twice",
                         name + " is written twice, and the two values would conflict: remove one.");
        note_access(profile, word, name, notes);
    }
    notes.at.reset();
}

void note_tag(const Profile& profile, std::uint16_t number, const std::string& name, Notes& notes)
{
    if (profile.personality.prm.list == dp::TagList::none)
        notes.refuse("no_tags", name + ": the device of the profile " + profile.name +
                                    " takes no tags from the master.");
    if (profile.tags.find(number) == nullptr && profile.tags_only_from_table)
        notes.refuse("tag_not_listed", name + " is not in the tag table of the profile " + profile.name +
                                           ", and the profile allows no other: choose one of the table.");
}

} // namespace dpslave::profile
