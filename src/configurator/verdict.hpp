// SPDX-License-Identifier: Apache-2.0
/// Says what the station would do with a GSD file, as sentences and facts.
#pragma once

#include "coded_finding.hpp"
#include "plant_keys.hpp"

#include "dpslave/gsd/check.hpp"
#include "dpslave/profile/gsd_judge.hpp"

#include <string>
#include <vector>

namespace dpslave::configurator {

/// A file as judged for one device.
struct Judged {
    profile::FileVerdict verdict;
    /// The draft with what the profile says of the parameters, as warnings: the slave accepts them. It is
    /// empty if the tags are open or the file is refused.
    profile::Draft draft = {};
    PlantKeys plant_keys = {}; ///< of a refused file: with which keys it would be taken, if it is the plant's
};

/// Judges the file as a station of `profile` with `keys`, whose ident is that of the file if neither has one.
Judged judge_as(const profile::Profile& profile, const profile::StationKeys& keys,
                const gsd::Document& document,
                const std::optional<std::vector<const gsd::Module*>>& modules = {});

/// "tags_at and identifiers"; empty: it has neither.
std::string names_of(const profile::StationKeys& keys);
/// Returns for a refused file why, and what to do.
std::string refusal_words(const Judged& judged);

/// "fits with 3 words: A, B, C", with what the master's project has to say.
std::string fits(const profile::FileVerdict& verdict);
/// Returns the findings of the check: the notes, and the refusal with its line.
std::vector<CodedFinding> coded_findings(const Judged& judged);
Json facts_of(const profile::FileVerdict& verdict);
/// code, telegram, octet, expected, got: as the daemon has them.
Json facts_of(const profile::Refused& refused);

} // namespace dpslave::configurator
