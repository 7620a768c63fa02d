// SPDX-License-Identifier: Apache-2.0
#include "prescan.hpp"

#include <array>

namespace dpslave::input {
namespace {

using Why = Unparsed::Why;

class Walk {
public:
    explicit Walk(std::string_view text) : rest_(text) {}

    std::optional<Unparsed> find()
    {
        if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
        while (!rest_.empty() && !found_) {
            const char c = rest_[0];
            if (c == '#')
                skip_comment();
            else if ((c == '"' || c == '\'') && !is_behind())
                skip_text();
            else if (c == '[' && begins_table() && !is_header())
                found_ = Unparsed{at_, Why::no_name};
            else if (closes_another(c))
                found_ = Unparsed{at_, Why::closes_another};
            else if (begins_second_number(c))
                found_ = Unparsed{at_, Why::second_number};
            else if (is_too_deep(c))
                found_ = Unparsed{at_, Why::nesting};
            else if (!is_ascii(c))
                found_ = Unparsed{at_, Why::not_ascii};
            else {
                go_on(c);
                take(1);
            }
        }
        return found_;
    }

private:
    /// Says where a key is allowed, where a value is allowed, and what follows the beginning of a number or
    /// of another value.
    enum class Part { key, value, behind_number, behind };

    /// No quote begins a text here: toml++ reads a number or a date up to its end, with everything in it.
    bool is_behind() const { return part_ == Part::behind_number || part_ == Part::behind; }

    static constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

    /// TOML has none of them, not even in comments and texts.
    static bool is_control(char c)
    {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == '\x7F';
    }

    static bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

    bool begins_table() const { return begins_line_ && open_.empty(); }

    /// A bracket where a brace is open, or where nothing is; or the other way round.
    bool closes_another(char c) const
    {
        if (c == '}') return open_.empty() || open_.back() != '{';
        return c == ']' && (open_.empty() || open_.back() == '{');
    }

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    /// Returns whether `c` comes after a number and a blank. TOML would allow it for a date and its time; no
    /// key of ours is one.
    bool begins_second_number(char c) const
    {
        return part_ == Part::behind_number && before_ == ' ' && is_digit(c);
    }

    /// Sets which part of the text follows `c`.
    void go_on(char c)
    {
        const bool was_behind = is_behind();
        switch (c) {
            case '=': part_ = was_behind ? part_ : Part::value; break;
            case ',': part_ = !open_.empty() && open_.back() == '[' ? Part::value : Part::key; break;
            case '[':
                open_ += begins_table() || open_ == "t" ? 't' : '[';
                if (!was_behind) part_ = open_.back() == 't' ? Part::key : Part::value;
                break;
            case '{':
                open_ += '{';
                if (!was_behind) part_ = Part::key;
                break;
            case ']':
            case '}':
                open_.pop_back();
                part_ = Part::behind;
                break;
            case '\n':
                if (open_.empty()) part_ = Part::key;
                break;
            case ' ':
            case '\t':
            case '\r': break;
            default:
                if (part_ == Part::value) part_ = is_digit(c) ? Part::behind_number : Part::behind;
        }
    }

    /// Returns whether the parser reads this as the head of a table: a key after "[" or "[[", or something
    /// that it refuses itself. It assumes that a key is there.
    bool is_header() const
    {
        constexpr std::string_view kBlanks = " \t";
        std::size_t next = rest_.find_first_not_of(kBlanks, 1);
        if (next < rest_.size() && rest_[next] == '[') {
            if (next > 1) return true; // "[ [", which is refused
            next = rest_.find_first_not_of(kBlanks, 2);
        }
        if (next == std::string_view::npos) return true; // the end, which is refused
        const char c = rest_[next];
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view{"_-\"']"}.find(c) != std::string_view::npos;
    }

    bool is_too_deep(char c)
    {
        switch (c) {
            case '[':
            case '{': dots_ = 0; return open_.size() >= kMaxNesting;
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
        if (part_ == Part::value) part_ = Part::behind;
        const char quote = rest_[0];
        const std::array<char, 3> three{quote, quote, quote};
        const std::string_view long_mark{three.data(), three.size()};
        const bool is_long = rest_.starts_with(long_mark);
        const std::string_view end = is_long ? long_mark : long_mark.substr(0, 1);
        take(end.size());
        while (!rest_.empty() && !rest_.starts_with(end)) {
            if (!is_long && rest_[0] == '\n') return;
            if (is_long && quote == '"' && rest_[0] == '\\' && !continues_in_ascii()) {
                found_ = Unparsed{at_, Why::not_ascii_after_backslash};
                return;
            }
            take(quote == '"' && rest_[0] == '\\' && rest_.size() > 1 ? 2 : 1);
        }
        if (!rest_.empty()) take(end.size());
    }

    /// Returns whether ASCII follows the backslash at the end of a line, which removes the white space after
    /// it.
    bool continues_in_ascii() const
    {
        const auto next = rest_.find_first_not_of(" \t\r\n", 1);
        return next == std::string_view::npos || is_ascii(rest_[next]);
    }

    void take(std::size_t count)
    {
        before_ = rest_[count - 1];
        for (const char c : rest_.substr(0, count)) {
            if (is_control(c) && !found_) found_ = Unparsed{at_, Why::control};
            ++at_.column;
            begins_line_ = c == '\n' || (begins_line_ && (c == ' ' || c == '\t' || c == '\r'));
            if (c == '\n') at_ = {at_.line + 1, 1};
        }
        rest_.remove_prefix(count);
    }

    std::string_view rest_;
    char before_ = '\0';      ///< the last octet that was read
    bool begins_line_ = true; ///< since the begin of the line there are only blanks
    Place at_{1, 1};
    std::optional<Unparsed> found_;
    Part part_ = Part::key;
    std::string open_;  ///< the brackets and braces around this place, 't' for those of a table's head
    unsigned dots_ = 0; ///< of the key that is being read
};

} // namespace

std::optional<Unparsed> prescan(std::string_view text)
{
    return Walk{text}.find();
}

std::string text(Unparsed::Why why)
{
    switch (why) {
        case Unparsed::Why::nesting:
            return "tables, lists or dotted keys are nested deeper than " + std::to_string(kMaxNesting) +
                   " levels.";
        case Unparsed::Why::control: return "this is a control character, which no text may have: remove it.";
        case Unparsed::Why::not_ascii:
            return "only texts in quotes and comments may have this character: write it in quotes, or remove it.";
        case Unparsed::Why::no_name: return "the name of a table has to follow this bracket.";
        case Unparsed::Why::closes_another:
            return "nothing of this kind is open here: remove it, or close with the sign that fits.";
        case Unparsed::Why::second_number:
            return "a second number follows the value: remove one of them, or put a comma between them.";
        case Unparsed::Why::not_ascii_after_backslash:
            return "after this backslash only an ASCII character may follow: put the text on one line.";
    }
    return "";
}

} // namespace dpslave::input
