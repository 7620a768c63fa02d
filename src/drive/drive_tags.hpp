// SPDX-License-Identifier: Apache-2.0
/// Keeps what is known about the tags of one drive without asking it, and what a layout asks of them.
#pragma once

#include "parameter_set.hpp"
#include "scale_check.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace dpslave::drive {

/// Those that the layout has, in its order.
std::span<const LayoutEntry> parameters_of(const Layout& layout);

/// Returns the reason that the table gives for a refusal of `transaction`: a drive that refuses because it
/// runs, or is not in configuration mode, sends the same error as for a tag that is read only or a value out
/// of range.
AccessError with_reason(const Transaction& transaction, AccessError error);

class DriveTags {
public:
    /// Takes what `unit` says of tags; its table outlives this.
    explicit DriveTags(const DriveSettings& unit);

    /// The row of the table, or one made for a tag that is in none; valid as long as this.
    const Tag* row(std::uint16_t number);

    /// Returns what is known without asking the drive. The limits of the table are not among it: for cyclic
    /// and Demand Data writes the drive decides, because its own limits may have been set otherwise.
    AccessError verdict(const Tag& row, bool is_write) const;

    /// Returns what is read and written with this layout, the watched tags included.
    ParameterSet parameters(const Layout& layout);
    /// The drive has answered with more decimals than the row gives: refused until the row changes.
    void contradict(std::uint16_t number) { contradicted_.insert(number); }
    /// Keeps the contradictions of `before` if the row is still the same.
    void keep_contradicted(DriveTags& before);
    bool is_contradicted(std::uint16_t number) const { return contradicted_.count(number) != 0; }
    /// The registers that say how the drive gives its values.
    ScaleCheck& scales() { return scales_; }
    const ScaleCheck& scales() const { return scales_; }
    /// Does a parameter of the layout depend on one of them?
    bool depends_on_scales(const Layout& layout);

    const std::vector<std::uint16_t>& watched() const { return watched_; } ///< kMaxWatched at most

private:
    DriveParameter record(std::uint16_t number, std::uint8_t uses);
    Writing output(const Tag& row, std::size_t place) const;

    const TagTable* table_;
    bool only_from_table_;
    bool compare_outputs_;
    bool scale_from_table_;
    bool asks_outputs_;
    std::optional<std::uint8_t> unlisted_decimals_;
    std::vector<std::uint16_t> never_written_;
    std::vector<std::uint16_t> watched_;
    std::set<std::uint16_t> contradicted_;
    std::vector<ScaleRegister> scale_registers_;
    ScaleCheck scales_;
    std::map<std::uint16_t, Tag> unlisted_; ///< rows of tags that are in no table; they stay where they are
};

} // namespace dpslave::drive
