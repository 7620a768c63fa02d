// SPDX-License-Identifier: Apache-2.0
#include "keys.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using Kind = Key::Kind;

constexpr char kEscape = '\x1B';
constexpr std::size_t kLongestSequence = 16;

/// A key and how many octets it had; none: it is not whole yet.
struct Found {
    std::size_t octets = 0;
    Key key{};
};

Kind kind_of_sequence(std::string_view sequence)
{
    const char last = sequence.back();
    if (last == 'A') return Kind::up;
    if (last == 'B') return Kind::down;
    if (last == '~' && sequence.starts_with("\x1B[5")) return Kind::page_up;
    if (last == '~' && sequence.starts_with("\x1B[6")) return Kind::page_down;
    return Kind::unknown;
}

/// `octets` begins with ESC [ or ESC O. A sequence ends with an octet from @ to ~.
Found control_sequence(std::string_view octets)
{
    for (std::size_t at = 2; at < octets.size(); ++at) {
        const bool is_last = octets[at] >= '@' && octets[at] <= '~';
        const bool is_inside = octets[at] >= ' ' && octets[at] < '@';
        if (is_last) return {at + 1, {kind_of_sequence(octets.substr(0, at + 1)), {}}};
        if (!is_inside || at + 1 >= kLongestSequence) return {at, {}};
    }
    return {};
}

Kind kind_of_control(char octet)
{
    switch (octet) {
        case '\r':
        case '\n': return Kind::enter;
        case '\b':
        case '\x7F': return Kind::backspace;
        case '\x15': return Kind::clear;
        default: return Kind::unknown;
    }
}

/// Whether `octets` may be the beginning of a character whose end has not come.
bool may_continue(std::string_view octets)
{
    const auto first = static_cast<unsigned char>(octets[0]);
    const std::size_t wanted = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 1;
    return first < 0xF5 && octets.size() < wanted &&
           std::all_of(octets.begin() + 1, octets.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; });
}

Found first_key(std::string_view octets)
{
    if (octets[0] == kEscape) {
        if (octets.size() > 1 && (octets[1] == '[' || octets[1] == 'O')) return control_sequence(octets);
        return {1, {Kind::escape, {}}};
    }
    const std::size_t length = character_length(octets);
    if (length == 0) return may_continue(octets) ? Found{} : Found{1, {}};
    const std::string_view character = octets.substr(0, length);
    if (is_control(character)) return {length, {kind_of_control(octets[0]), {}}};
    return {length, {Kind::character, std::string{character}}};
}

} // namespace

std::vector<Key> KeyReader::read(std::string_view octets)
{
    std::vector<Key> keys;
    pending_ += octets;
    std::string_view rest = pending_;
    while (!rest.empty()) {
        Found found = first_key(rest);
        if (found.octets == 0) break;
        keys.push_back(std::move(found.key));
        rest.remove_prefix(found.octets);
    }
    pending_ = std::string{rest};
    return keys;
}

} // namespace dpslave::dpctl
