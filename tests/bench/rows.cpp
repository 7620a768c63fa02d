// SPDX-License-Identifier: Apache-2.0
#include "rows.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace dpslave::bench {
namespace {

const char* kind(Noise noise)
{
    return noise == Noise::p50 ? "p50" : "p99";
}

nlohmann::json json_of(const Row& row)
{
    const auto aa = row.aa_ratio();
    return {{"id", row.id},
            {"metric", row.metric},
            {"blocks", row.blocks},
            {"ratio", row.ratio()},
            {"aa", row.aa},
            {"aa_ratio", aa ? nlohmann::json(*aa) : nlohmann::json()},
            {"aa_kind", row.noise == Noise::not_judged ? nlohmann::json() : nlohmann::json(kind(row.noise))},
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
    const auto error = aa_ratio();
    if (!error) return false; // of a simulated clock, or of memory
    if (blocks.size() < kBlocks) return true;
    if (noise == Noise::not_judged) return false;
    return noise == Noise::p50 ? *error < 0.97 || *error > 1.03 : *error < 0.90 || *error > 1.10;
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
