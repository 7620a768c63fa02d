// SPDX-License-Identifier: Apache-2.0
/// Tag tables with what is known of the devices that use them, and the search in them. Pure but for
/// load_tables().
#pragma once

#include "dpslave/profile/profile.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dpslave::dpctl {

struct DeviceOfTable {
    std::string profile;
    std::string device;
};

struct TagFile {
    std::string name; ///< "2400.csv"
    drive::TagTable tags;
    std::vector<DeviceOfTable> devices; ///< of the profiles that use it
    drive::MnemonicRule mnemonics = drive::MnemonicRule::none;
    bool extended_demand = true; ///< no profile says that the devices lack commands 3 and 4
    std::vector<std::uint16_t> never_written;

    /// No tag of a real drive: empty, or the table that only shows the form. A profile that names it has no
    /// public table (HA389815 ch. 7: the tags are those of the product manuals).
    bool is_only_form() const { return tags.all().empty() || name == "example.csv"; }
};

struct TagFiles {
    std::vector<TagFile> files;
    std::vector<std::string> faults; ///< what could not be read, a line each
};

/// Every table of `profiles`/../tags, with the devices of `profiles`.
TagFiles load_tables(const std::filesystem::path& profiles);
/// The table of one profile.
TagFiles load_table_of(const std::filesystem::path& profiles, const std::string& profile);
/// One file, of which no device is known.
TagFiles load_table(const std::filesystem::path& file);

struct TagHit {
    const TagFile* file = nullptr;
    const drive::Tag* tag = nullptr;
};
struct TagHits {
    std::vector<TagHit> hits;
    std::size_t left_out = 0; ///< their names say more than the query
};

/// Numbers alone (270, 0x10E, >10E) are tags. Otherwise every word must occur in name, alias or section, as a
/// part of a word; a number only as a whole word, and behind the word that it stands behind in the query: 4
/// in "segment 4" is no program. Where a name consists of nothing but the query's words, the names that say
/// more are left out unless `all`.
TagHits search(const std::vector<TagFile>& files, const std::vector<std::string>& query, bool all);

} // namespace dpslave::dpctl
