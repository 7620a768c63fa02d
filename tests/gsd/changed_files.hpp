// SPDX-License-Identifier: Apache-2.0
/// Files of a plant, for the judge: good ones, with the changes that a plant, a tool or a typist may have
/// made, and what a master sends for them, by the reader of dpsim.
#pragma once

#include "dpsim/master/gsd_station.hpp"

#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/profile/profile.hpp"

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace dpslave::test {

class ChangedFiles {
public:
    explicit ChangedFiles(std::uint32_t seed) : random_(seed) {}

    /// A good file for this profile, with up to two changes. kOwnIdent where the profile leaves it open.
    std::string next(const profile::Profile& profile);

    std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }
    bool one_in(std::size_t n) { return below(n) == 0; }

private:
    profile::Selection selection_for(const profile::Profile& profile); ///< that the profile takes
    std::string change(const std::string& text);
    std::string with_user(const std::string& text);
    std::string with_modules(const std::string& text);
    std::string identifier();

    std::mt19937 random_;
};

/// What a master sends that takes all that the file offers. Nothing: the file contradicts itself.
std::optional<sim::GsdTelegrams> telegrams_of(const std::string& text,
                                              const std::vector<std::string>& modules);

/// Tags 1, 2, 3 ... where the file leaves them open: as many as `count`, from octet `tags_at` of
/// User_Prm_Data.
void type_tags(sim::GsdTelegrams& telegrams, std::size_t tags_at, std::size_t count);

} // namespace dpslave::test
