// SPDX-License-Identifier: Apache-2.0
#include "dpslave/input/wording.hpp"

#include "dpslave/base/edit_distance.hpp"
#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::input {

std::string in_quotes(std::string_view text)
{
    return '"' + std::string{text} + '"';
}

bool has_control_characters(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length =
            std::max<std::size_t>(1, character_length(text)); // what is no UTF-8 was refused when it was read
        if (is_control(text.substr(0, length))) return true;
        text.remove_prefix(length);
    }
    return false;
}

std::string_view nearest(std::string_view wrong, std::span<const std::string> legal)
{
    return nearest(wrong, legal, std::max<std::size_t>(2, wrong.size() / 3));
}

std::string_view nearest(std::string_view wrong, std::span<const std::string> legal, std::size_t most)
{
    constexpr std::size_t longest = 64; // longer than every key and name
    if (wrong.size() > longest) return {};
    std::string_view best;
    std::size_t best_distance = most + 1;
    for (const std::string& candidate : legal) {
        const std::size_t distance = edit_distance(wrong, candidate, most);
        // Something of the word must be kept, or "ab" would be near to every key of two letters.
        if (distance < best_distance && distance < std::max(wrong.size(), candidate.size())) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string listed(std::span<const std::string> legal)
{
    std::string out;
    for (std::size_t i = 0; i < legal.size(); ++i) {
        if (i > 0) out += i + 1 == legal.size() ? " or " : ", ";
        out += in_quotes(legal[i]);
    }
    return out;
}

} // namespace dpslave::input
