// SPDX-License-Identifier: Apache-2.0
/// The files of the incidents: N.incident, and counts.json. Every function may block for as long as the disk
/// does: never on the main thread, never on the bus thread.
#pragma once

#include "book.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/report/incident.hpp"
#include "dpslave/trace/ring.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

/// What a folder has.
struct FoundIncidents {
    std::vector<Incident> kept;
    std::uint64_t next_number = 1;   ///< higher than any number in it
    std::vector<std::string> faults; ///< a sentence each: files that are skipped, or the folder itself
};
/// Makes the folder if need be. Unfinished files of a run before are removed.
FoundIncidents find_incidents(const std::filesystem::path& folder);

/// A piece of the time line of the ring.
struct Stretch {
    Instant from{}, at{}, to{}; ///< `at`: the moment of the incident
};
/// The ring of a drive line, which stands while it is read.
struct LineRing {
    std::string name;
    const trace::Ring* ring = nullptr;
};
/// Octets of records before and behind the moment, in a file: what is nearest to it is kept. The drive lines
/// share theirs.
inline constexpr std::size_t kMostBefore = 512 * 1024, kMostBehind = 256 * 1024;
inline constexpr std::size_t kMostOfLinesBefore = 128 * 1024, kMostOfLinesBehind = 64 * 1024;
/// The records of the bus, then those of each line behind a record with its name. The failure is a sentence.
std::optional<std::string> write_incident(const std::filesystem::path& folder,
                                          const report::IncidentHead& head, const trace::Ring& bus,
                                          const std::vector<LineRing>& lines, const Stretch& stretch);
std::optional<std::string> write_counts(const std::filesystem::path& folder,
                                        const report::IncidentCounts& counts);
void remove_incident(const std::filesystem::path& folder, std::uint64_t number);

/// A part of a file.
struct IncidentPiece {
    std::vector<std::uint8_t> octets;
    std::uint64_t size = 0; ///< of the whole file
};
inline constexpr std::size_t kMostInAPiece = 48 * 1024;
/// From octet `offset` on. The failure is a clause.
Result<IncidentPiece, std::string> read_piece(const std::filesystem::path& folder, std::uint64_t number,
                                              std::uint64_t offset);

} // namespace dpslave::app
