// SPDX-License-Identifier: Apache-2.0
/// Makes the findings about a mapping while it is edited, which are the same as those about its file.
#pragma once

#include "facts.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

struct CodedFinding {
    gsd::Finding finding;
    std::string_view code;         ///< stays the same where the sentence changes
    std::string_view field;        ///< what mends it: a key of a mapping, "list", "name"; empty: not known
    std::optional<std::size_t> at; ///< the parameter it is about: its place in the list
    std::optional<std::uint16_t> tag = {};
};

/// Returns the findings about a draft, and about the file that is made of it if there is one: notes, lengths,
/// what a master's tool says. `file`: none if the draft fits into no telegram. `name`: of the file, without
/// folders; empty: not judged.
std::vector<CodedFinding> coded_findings(const profile::Draft& draft, const gsd::Document* file,
                                         gsd::Reading reading, std::string_view name);
/// `parameters`: of the notes.
void add_notes(std::vector<CodedFinding>& all, const std::vector<profile::Note>& notes,
               const std::vector<profile::GsdParameter>& parameters);
/// Lengths that some masters cannot take.
void add_advice(std::vector<CodedFinding>& all, const gsd::Document& file);
/// Adds what is remarkable about the form of a file. `name` as above.
void add_check(std::vector<CodedFinding>& all, const gsd::Document& file, gsd::Reading reading,
               std::string_view name);
Json facts_of(const std::vector<CodedFinding>& all);

} // namespace dpslave::configurator
