// SPDX-License-Identifier: Apache-2.0
#include "rows.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace dpslave::bench {
namespace {

struct Limits {
    double low = 0, high = 0;
};

/// Between which A/A has to be; nothing: it judges nothing.
std::optional<Limits> limits(Noise noise)
{
    switch (noise) {
        case Noise::p50: return Limits{0.97, 1.03};
        case Noise::p99: return Limits{0.90, 1.10};
        case Noise::not_judged: break;
    }
    return std::nullopt;
}

/// Blocks that come of a real machine may be too few; of a simulated clock, or of memory, one is enough.
std::size_t blocks_needed(const Row& row)
{
    return row.aa.empty() ? 1 : kBlocks;
}

nlohmann::json json_of(const Row& row)
{
    const auto aa = row.aa_ratio();
    const auto within = limits(row.noise);
    return {{"id", row.id},
            {"metric", row.metric},
            {"blocks", row.blocks},
            {"ratio", row.ratio()},
            {"aa", row.aa},
            {"aa_ratio", aa ? nlohmann::json(*aa) : nlohmann::json()},
            {"aa_limits", within ? nlohmann::json{within->low, within->high} : nlohmann::json()},
            {"blocks_needed", blocks_needed(row)},
            {"limit", row.limit},
            {"direction", row.is_least ? "min" : "max"}};
}

} // namespace

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double Row::ratio() const
{
    return median(blocks);
}

std::optional<double> Row::aa_ratio() const
{
    if (aa.empty()) return std::nullopt;
    return median(aa);
}

bool Row::is_kept() const
{
    return is_least ? ratio() >= limit : ratio() <= limit;
}

bool Row::is_noisy() const
{
    if (blocks.size() < blocks_needed(*this)) return true;
    const auto error = aa_ratio();
    const auto within = limits(noise);
    return error && within && (*error < within->low || *error > within->high);
}

int exit_status(const std::vector<Row>& rows)
{
    const auto broken = [](const Row& row) { return !row.is_noisy() && !row.is_kept(); };
    if (std::any_of(rows.begin(), rows.end(), broken)) return 1;
    return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.is_noisy(); }) ? 77 : 0;
}

std::string verdict(const Row& row)
{
    if (row.is_noisy()) return "too noisy";
    return row.is_kept() ? "kept" : "BROKEN";
}

void write_json(const std::filesystem::path& file, const std::vector<Row>& rows, const nlohmann::json& curves)
{
    nlohmann::json all = {{"rows", nlohmann::json::array()}, {"curves", curves}};
    for (const Row& row : rows) all["rows"].push_back(json_of(row));
    std::ofstream out{file};
    out << all.dump(1) << '\n';
    if (!out.flush()) throw std::runtime_error{file.string() + " cannot be written"};
}

} // namespace dpslave::bench
