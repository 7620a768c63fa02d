// SPDX-License-Identifier: Apache-2.0
/// The rows of the table of tools/run bench: what each measured, what it has to keep, and the JSON that all
/// programs of the bench write.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::bench {

/// So many blocks has each row; --quick has one.
inline constexpr std::size_t kBlocks = 21;

/// Between which limits the error of the measurement (A/A) lets a row be judged.
enum class Noise : std::uint8_t {
    not_judged,
    p50, ///< 0.97 to 1.03
    p99, ///< 0.90 to 1.10
};

struct Row {
    std::string id;     ///< "M1"
    std::string metric; ///< what is divided by what
    double limit = 0;
    bool is_least = false; ///< the ratio shall be `limit` at least; else at most
    Noise noise = Noise::not_judged;
    std::vector<double> blocks{}; ///< one ratio of each block, not empty
    std::vector<double> aa{};     ///< the same of two equal arms; empty: there are none

    double ratio() const; ///< median of the blocks
    std::optional<double> aa_ratio() const;
    bool is_kept() const;
    /// A/A is not within its limits, or the machine was too slow for all blocks: nothing is known of the row.
    bool is_noisy() const;
};

double median(std::vector<double> values); ///< not empty

/// Of a program: 0 all rows are kept, 1 a row is broken, 77 the machine is too noisy to say so.
int exit_status(const std::vector<Row>& rows);
/// "kept", "BROKEN", "too noisy".
std::string verdict(const Row& row);

/// `curves` goes beside the rows. Throws if the file cannot be written.
void write_json(const std::filesystem::path& file, const std::vector<Row>& rows,
                const nlohmann::json& curves);

} // namespace dpslave::bench
