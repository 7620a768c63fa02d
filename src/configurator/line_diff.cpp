// SPDX-License-Identifier: Apache-2.0
#include "line_diff.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dpslave::configurator {
namespace {

using Texts = std::vector<std::string_view>;

/// Pairs of lines that are compared at most: 16 MB and some 10 ms.
constexpr std::size_t kMostPairs = 4'000'000;

Texts lines_of(std::string_view text)
{
    Texts lines;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
    }
    return lines;
}

class Comparison {
public:
    Comparison(Texts left, Texts right) : left_(std::move(left)), right_(std::move(right)) {}

    std::vector<Line> lines()
    {
        while (i_ < left_.size() && i_ < right_.size() && left_[i_] == right_[i_]) {
            add(i_ + 1, j_ + 1, left_[i_]);
            ++i_;
            ++j_;
        }
        std::size_t tail = 0;
        while (tail < left_.size() - i_ && tail < right_.size() - j_ &&
               left_[left_.size() - 1 - tail] == right_[right_.size() - 1 - tail])
            ++tail;
        middle(left_.size() - tail, right_.size() - tail);
        for (; tail > 0; --tail, ++i_, ++j_) add(i_ + 1, j_ + 1, left_[i_]);
        return std::move(lines_);
    }

private:
    void add(std::size_t left, std::size_t right, std::string_view text)
    {
        lines_.push_back({static_cast<unsigned>(left), static_cast<unsigned>(right), text});
    }

    /// Finds from i_ and j_ to both ends the longest common sequence, filled in from the end.
    void middle(std::size_t left_end, std::size_t right_end)
    {
        const std::size_t rows = left_end - i_, columns = right_end - j_;
        const std::size_t first_left = i_, first_right = j_;
        const bool fits = rows == 0 || columns <= kMostPairs / rows;
        std::vector<std::uint32_t> common(fits ? (rows + 1) * (columns + 1) : 0);
        const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
            return common[(i - first_left) * (columns + 1) + (j - first_right)];
        };
        if (fits)
            for (std::size_t i = left_end; i-- > first_left;)
                for (std::size_t j = right_end; j-- > first_right;)
                    at(i, j) =
                        left_[i] == right_[j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
        while (i_ < left_end || j_ < right_end) {
            if (fits && i_ < left_end && j_ < right_end && left_[i_] == right_[j_]) {
                add(i_ + 1, j_ + 1, left_[i_]);
                ++i_;
                ++j_;
            } else if (i_ < left_end && (!fits || j_ == right_end || at(i_ + 1, j_) >= at(i_, j_ + 1))) {
                add(i_ + 1, 0, left_[i_]);
                ++i_;
            } else {
                add(0, j_ + 1, right_[j_]);
                ++j_;
            }
        }
    }

    Texts left_, right_;
    std::size_t i_ = 0, j_ = 0; ///< lines that are consumed
    std::vector<Line> lines_;
};

} // namespace

std::vector<Line> compare_lines(std::string_view left, std::string_view right)
{
    return Comparison{lines_of(left), lines_of(right)}.lines();
}

} // namespace dpslave::configurator
