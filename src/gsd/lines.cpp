// SPDX-License-Identifier: Apache-2.0
#include "lines.hpp"

#include "text.hpp"

#include "dpslave/gsd/device.hpp"

namespace dpslave::gsd {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A character outside ASCII as it stands in the text.
struct Foreign {
    std::size_t length = 1; ///< octets
    bool utf8 = false;
    bool double_quote = false; ///< typographic
    bool latin1 = false;
};

/// Precondition: text is not empty and begins with an octet from 80h on.
Foreign foreign_at(std::string_view text)
{
    const auto octet = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto follows = [&](std::size_t i) { return (octet(i) & 0xC0U) == 0x80U; };
    if (octet(0) >= 0xC2 && octet(0) <= 0xDF && follows(1)) return {2, true, false, false};
    if (octet(0) >= 0xE0 && octet(0) <= 0xEF && follows(1) && follows(2)) {
        const bool quote = octet(0) == 0xE2 && octet(1) == 0x80 && octet(2) >= 0x9C && octet(2) <= 0x9F;
        return {3, true, quote, false};
    }
    if (octet(0) >= 0xF0 && octet(0) <= 0xF4 && follows(1) && follows(2) && follows(3))
        return {4, true, false, false};
    const bool quote = octet(0) == 0x84 || octet(0) == 0x93 || octet(0) == 0x94; // Windows-1252
    return {1, false, quote, octet(0) >= 0xA0};
}

class LineReader {
public:
    LineReader(std::string_view content, Remarks& remarks) : rest_(content), remarks_(remarks) {}

    std::vector<LogicalLine> read()
    {
        if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
            remark(1, Weight::error,
                   "the file begins with a UTF-8 byte order mark, before which tools do not find "
                   "#Profibus_DP: save it as ISO 8859-1 (ANSI).");
            rest_.remove_prefix(kByteOrderMark.size());
        }
        while (!rest_.empty()) physical_line();
        end_logical_line();
        return std::move(lines_);
    }

private:
    void remark(unsigned line, Weight weight, std::string what)
    {
        remarks_.push_back({line, weight, std::move(what)});
    }

    void physical_line()
    {
        ++number_;
        const auto end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        if (end == std::string_view::npos) {
            remark(number_, Weight::warning,
                   "the last line has no line end: some tools lose it. Add an empty line.");
            rest_ = {};
        } else {
            rest_.remove_prefix(end + 1);
            if (line.empty() || line.back() != '\r') {
                if (!lf_seen_)
                    remark(number_, Weight::pedantic,
                           "the line ends with LF alone: the tools' files have CR LF.");
                lf_seen_ = true;
            }
        }
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (line.size() > kMaxLine)
            remark(
                number_, Weight::warning,
                "the line has " + std::to_string(line.size()) +
                    " characters: the standard allows 80. Shorten it, or continue it with \\ after a comma.");
        take(line);
    }

    /// Code goes to the logical line, the comment goes nowhere.
    void take(std::string_view line)
    {
        const std::string code = code_of(line);
        const std::string_view text = trimmed(code);
        if (text_.empty()) started_ = number_;
        const bool continued = !text.empty() && text.back() == '\\';
        continued_ = continued;
        text_ += continued ? trimmed(text.substr(0, text.size() - 1)) : text;
        if (!continued) {
            end_logical_line();
        } else if (in_string_) {
            remark(number_, Weight::warning,
                   "a text is continued on the next line, which the standard does not know: write it in one "
                   "line.");
        } else if (line.back() != '\\') {
            remark(number_, Weight::warning,
                   "something stands behind the \\ that continues the line, if only a blank, a tab or a "
                   "comment: "
                   "many tools end the line here. Remove it.");
        }
    }

    /// `line` up to its comment, with plain quotes.
    std::string code_of(std::string_view line)
    {
        std::string code;
        for (std::size_t i = 0; i < line.size();) {
            const auto c = static_cast<unsigned char>(line[i]);
            if (c >= 0x80) {
                const Foreign foreign = foreign_at(line.substr(i));
                judge(foreign);
                if (foreign.double_quote) {
                    in_string_ = !in_string_;
                    code += '"';
                } else {
                    code += line.substr(i, foreign.length);
                }
                i += foreign.length;
                continue;
            }
            if (c == ';' && !in_string_) {
                comment(line.substr(i));
                break;
            }
            if (c == '"') in_string_ = !in_string_;
            if ((c < 0x20 && c != '\t') || c == 0x7F)
                once(control_seen_, Weight::error,
                     "the line has a control character, which ends the file for some tools: remove it.");
            code += static_cast<char>(c);
            ++i;
        }
        return code;
    }

    void judge(const Foreign& foreign)
    {
        if (foreign.double_quote)
            once(quotes_seen_at_, "typographic quotes: no tool reads such a text. Write plain ones (\").");
        else if (foreign.utf8)
            once(utf8_seen_, Weight::warning,
                 "a character is coded in UTF-8: tools show two others in its place. Save the file as ISO "
                 "8859-1 (ANSI).");
        else if (!foreign.latin1)
            once(windows_seen_, Weight::warning,
                 "a character is none of ISO 8859-1 (one of Windows alone): replace it by a plain one.");
    }

    /// In a comment only what can stop a tool counts.
    void comment(std::string_view text)
    {
        for (const char each : text) {
            const auto c = static_cast<unsigned char>(each);
            if (c == 0 || c == 0x1A)
                once(control_seen_, Weight::error,
                     "the line has a control character, which ends the file for some tools: remove it.");
        }
    }

    void once(bool& seen, Weight weight, std::string_view what)
    {
        if (!seen) remark(number_, weight, std::string{what});
        seen = true;
    }
    /// Once a line: each of them is a text that is lost.
    void once(unsigned& seen_at, std::string_view what)
    {
        if (seen_at != number_) remark(number_, Weight::error, std::string{what});
        seen_at = number_;
    }

    void end_logical_line()
    {
        if (in_string_) {
            remark(started_, Weight::error, "the text has no closing quote: add it.");
            text_ += '"';
            in_string_ = false;
        }
        if (continued_)
            remark(started_, Weight::error,
                   "the last line is continued, but there is none after it: remove the \\.");
        continued_ = false;
        if (!text_.empty()) lines_.push_back({std::move(text_), started_});
        text_.clear();
    }

    std::string_view rest_;
    Remarks& remarks_;
    std::vector<LogicalLine> lines_;
    std::string text_; ///< of the logical line so far
    unsigned number_ = 0, started_ = 0;
    bool in_string_ = false, continued_ = false;
    bool lf_seen_ = false, utf8_seen_ = false, windows_seen_ = false, control_seen_ = false;
    unsigned quotes_seen_at_ = 0;
};

} // namespace

std::vector<LogicalLine> logical_lines(std::string_view content, Remarks& remarks)
{
    return LineReader{content, remarks}.read();
}

} // namespace dpslave::gsd
