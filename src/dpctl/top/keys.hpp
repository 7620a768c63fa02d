// SPDX-License-Identifier: Apache-2.0
/// What was typed, from the octets that a terminal sends for it. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

struct Key {
    enum class Kind : std::uint8_t {
        character, ///< `text` has it in UTF-8; it is no control character
        enter,
        escape,
        backspace,
        clear, ///< Ctrl-U: the whole line away
        up,
        down,
        page_up,
        page_down,
        unknown, ///< a sequence or a control character without a meaning here
    };
    Kind kind = Kind::unknown;
    std::string text{};

    friend bool operator==(const Key&, const Key&) = default;
};

/// Sequences of a VT100 and of xterm (ECMA-48, 5.4; xterm ctlseqs, "PC-Style Function Keys").
class KeyReader {
public:
    /// The keys in what one read has brought. A character or sequence that is not whole waits for the next
    /// call, at most 16 octets. An ESC at the end is the key Esc: a terminal sends the octets of a sequence
    /// together.
    std::vector<Key> read(std::string_view octets);

private:
    std::string pending_;
};

} // namespace dpslave::dpctl
