// SPDX-License-Identifier: Apache-2.0
/// Lists of a GSD file's modules that have as many words as there are tags.
#pragma once

#include "dpslave/dp/personality.hpp"
#include "dpslave/gsd/document.hpp"
#include "dpslave/profile/gsd_device.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace dpslave::profile {

struct ModuleList {
    std::vector<const gsd::Module*> modules; ///< as few as possible
    bool is_only_one = false; ///< no other list, and no module of the file that the device does not take
};

/// Finds a list of modules. `words`: of parameters; nullopt: any number but none, or Demand Data alone if
/// there is no other list. It returns nullopt if there is no list within Max_Module, max_parameters and
/// max_words.
std::optional<ModuleList> list_of_modules(const dp::Personality& personality, const gsd::Document& document,
                                          std::optional<std::size_t> words);

/// Returns the shortest list whose words are just these, in their order and directions, after Demand Data if
/// `demand`; nullopt if there is none. It ignores the limits of the file.
std::optional<std::vector<const gsd::Module*>> list_of_words(const dp::Personality& personality,
                                                             const gsd::Document& document,
                                                             const std::vector<GsdParameter>& words,
                                                             bool demand);

/// Modules of the file with an identifier that is none of the device.
std::vector<const gsd::Module*> not_usable(const dp::Personality& personality, const gsd::Document& document);

/// A list that comes close to it: for the reason why there is none. It is empty if the file has no module.
std::vector<const gsd::Module*> closest_list(const dp::Personality& personality,
                                             const gsd::Document& document, std::size_t words);

} // namespace dpslave::profile
