// SPDX-License-Identifier: Apache-2.0
#include "nesting.hpp"

#include <array>

namespace dpslave::toml {
namespace {

class Walk {
public:
    explicit Walk(std::string_view text) : rest_(text) {}

    std::optional<Place> find()
    {
        while (!rest_.empty()) {
            if (rest_[0] == '#')
                skip_comment();
            else if (rest_[0] == '"' || rest_[0] == '\'')
                skip_text();
            else if (is_too_deep(rest_[0]))
                return at_;
            else
                take(1);
        }
        return std::nullopt;
    }

private:
    bool is_too_deep(char c)
    {
        switch (c) {
            case '[':
            case '{': dots_ = 0; return ++depth_ > kMaxNesting;
            case ']':
            case '}': depth_ -= depth_ > 0 ? 1 : 0; break;
            case '.': return ++dots_ >= kMaxNesting;
            case '=':
            case ',':
            case '\n': dots_ = 0; break;
            default: break;
        }
        return false;
    }

    void skip_comment()
    {
        while (!rest_.empty() && rest_[0] != '\n') take(1);
    }

    /// A text of one line ends with it also where its quote is missing: the parser will say so.
    void skip_text()
    {
        const char quote = rest_[0];
        const std::array<char, 3> three{quote, quote, quote};
        const std::string_view long_mark{three.data(), three.size()};
        const bool is_long = rest_.starts_with(long_mark);
        const std::string_view end = is_long ? long_mark : long_mark.substr(0, 1);
        take(end.size());
        while (!rest_.empty() && !rest_.starts_with(end)) {
            if (!is_long && rest_[0] == '\n') return;
            take(quote == '"' && rest_[0] == '\\' && rest_.size() > 1 ? 2 : 1);
        }
        if (!rest_.empty()) take(end.size());
    }

    void take(std::size_t count)
    {
        for (const char c : rest_.substr(0, count)) {
            ++at_.column;
            if (c == '\n') at_ = {at_.line + 1, 1};
        }
        rest_.remove_prefix(count);
    }

    std::string_view rest_;
    Place at_{1, 1};
    unsigned depth_ = 0;
    unsigned dots_ = 0; ///< of the key that is being read
};

} // namespace

std::optional<Place> too_deep(std::string_view text)
{
    return Walk{text}.find();
}

} // namespace dpslave::toml
