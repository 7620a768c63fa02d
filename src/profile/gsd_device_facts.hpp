// SPDX-License-Identifier: Apache-2.0
/// Writes the facts of a GSD about the device itself: who made it, its rates, what it can do.
#pragma once

#include "dpslave/profile/gsd_device.hpp"

namespace dpslave::profile {

/// Notes of a draft, about one parameter or about none.
class Notes {
public:
    explicit Notes(std::vector<Note>& notes) : notes_(notes) {}

    void refuse(std::string_view code, std::string sentence)
    {
        notes_.push_back({true, code, std::move(sentence), at, field});
    }
    void warn(std::string_view code, std::string sentence)
    {
        notes_.push_back({false, code, std::move(sentence), at, field});
    }
    /// Converts to the character set of a GSD; a note names characters that do not exist there.
    std::string text_of(std::string_view what, const std::string& text, std::size_t longest);

    std::optional<std::size_t> at; ///< the parameter that they are about
    std::string_view field;        ///< the key of a mapping that mends them; empty: the list of parameters

private:
    std::vector<Note>& notes_;
};

/// `description`: where the selection says none.
void add_facts(const Profile& profile, const Selection& selection, const std::string& description,
               gsd::Device& device, Notes& notes);

} // namespace dpslave::profile
