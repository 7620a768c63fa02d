// SPDX-License-Identifier: Apache-2.0
/// Recognises which device a GSD file is for, by what the file says: before anybody is asked.
#pragma once

#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/document.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

struct Recognised {
    /// The profiles that the file may be for, by name; if there is one, the device is known. They are without
    /// the rows of their tag tables.
    std::vector<profile::Profile> profiles = {};
    /// True if nothing but the vendor indicates them: a person has to say which it is.
    bool is_guess = false;
};

/// First what our own files carry in a comment, then Ident_Number with Model_Name, then one of them, then the
/// vendor. If there are several, those remain that accept what a master sends for the file.
Recognised recognise(const Files& files, std::string_view file, const gsd::Document& document);

/// "590", or "584s or 590".
std::string names_of(const std::vector<profile::Profile>& profiles);

/// The keys of a station with this file: the file's ident where the profile has none.
profile::StationKeys keys_for(const profile::Profile& profile, const gsd::Document& document,
                              const profile::StationKeys& said);

} // namespace dpslave::configurator
