// SPDX-License-Identifier: Apache-2.0
#include "lines.hpp"

#include "text.hpp"

#include "dpslave/gsd/device.hpp"

namespace dpslave::gsd {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kUtf16Low = "\xFF\xFE", kUtf16High = "\xFE\xFF";
constexpr std::string_view kUtf32Low{"\xFF\xFE\0\0", 4}, kUtf32High{"\0\0\xFE\xFF", 4};
constexpr std::string_view kEndOfFile = "\x1A";
/// The first word of a type file of COM ET 200, which came before the GSD.
constexpr std::string_view kTypeFile = "Typbeschreibungsdatei";

/// A character outside ASCII, as spelled in the text.
struct Foreign {
    std::size_t length = 1; ///< octets
    bool utf8 = false;
    bool double_quote = false; ///< typographic
};

/// Precondition: text is not empty and begins with an octet from 80h on.
Foreign foreign_at(std::string_view text)
{
    const auto octet = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto follows = [&](std::size_t i) { return (octet(i) & 0xC0U) == 0x80U; };
    if (octet(0) >= 0xC2 && octet(0) <= 0xDF && follows(1)) return {2, true, false};
    if (octet(0) >= 0xE0 && octet(0) <= 0xEF && follows(1) && follows(2)) {
        const bool quote = octet(0) == 0xE2 && octet(1) == 0x80 && octet(2) >= 0x9C && octet(2) <= 0x9F;
        return {3, true, quote};
    }
    if (octet(0) >= 0xF0 && octet(0) <= 0xF4 && follows(1) && follows(2) && follows(3))
        return {4, true, false};
    const bool quote = octet(0) == 0x84 || octet(0) == 0x93 || octet(0) == 0x94; // Windows-1252
    return {1, false, quote};
}

/// Editors of DOS have put some 0x1A after the text: at its end, or in a line of their own.
std::string_view without_end_of_file(std::string_view text)
{
    if (text.ends_with(kEndOfFile)) text = text.substr(0, text.find_last_not_of(kEndOfFile) + 1);
    const auto end = text.find_last_not_of("\x1A\r\n");
    const std::string_view behind = end == std::string_view::npos ? text : text.substr(end + 1);
    const auto line = behind.find('\n');
    if (line == std::string_view::npos || behind.find(kEndOfFile, line) == std::string_view::npos)
        return text;
    return text.substr(0, text.size() - behind.size() + line + 1);
}

class LineReader {
public:
    LineReader(std::string_view content, Remarks& remarks) : rest_(content), remarks_(remarks) {}

    std::vector<LogicalLine> read()
    {
        if (rest_.starts_with(kByteOrderMark)) byte_order_mark();
        rest_ = without_end_of_file(rest_);
        while (!rest_.empty()) physical_line();
        end_logical_line();
        return std::move(lines_);
    }

private:
    /// Its text may have 256 characters, and no text may be continued on the next line.
    static bool is_info_text(std::string_view line)
    {
        return same_any_case(trimmed(line.substr(0, line.find('='))), "Info_Text");
    }

    /// In the first line it hides #Profibus_DP, in a comment it does no harm.
    void byte_order_mark()
    {
        rest_.remove_prefix(kByteOrderMark.size());
        const bool hides = trimmed(rest_.substr(0, rest_.find('\n'))).starts_with('#');
        remark(
            1, hides ? Weight::error : Weight::warning,
            hides
                ? "the file begins with a UTF-8 byte order mark, so its first line is not exactly #Profibus_DP: save it as ISO 8859-1 (ANSI)."
                : "the file begins with a UTF-8 byte order mark: save it as ISO 8859-1 (ANSI).");
    }

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
                   "the last line has no line end, which checkers report: add one.");
            rest_ = {};
        } else {
            rest_.remove_prefix(end + 1);
            if (line.empty() || line.back() != '\r') {
                if (!lf_seen_)
                    remark(number_, Weight::pedantic, "the line ends with LF alone: usual is CR LF.");
                lf_seen_ = true;
            }
        }
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (line.size() > kMaxLine && !is_info_text(line)) {
            const bool is_comment = trimmed(line).starts_with(';');
            remark(number_, Weight::warning,
                   "the line has " + std::to_string(line.size()) +
                       " characters: checkers allow 80. Shorten it, or " +
                       (is_comment ? "write two." : "continue it with \\ after a comma."));
        }
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
            remark(
                number_, Weight::warning,
                "a text is continued on the next line, which the standard does not know: write it in one line.");
        } else if (line.back() != '\\') {
            remark(
                number_, Weight::warning,
                "something follows the \\ that continues the line, if only a blank, a tab or a comment: nothing may follow it. Remove it.");
        }
    }

    /// Returns `line` up to its comment, with plain quotes.
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
                     "the line has a control character, which is no text: remove it.");
            code += static_cast<char>(c);
            ++i;
        }
        return code;
    }

    void judge(const Foreign& foreign)
    {
        if (foreign.double_quote)
            once(quotes_seen_at_, "typographic quotes are none for a tool: write plain ones (\").");
        else if (foreign.utf8)
            once(
                utf8_seen_, Weight::warning,
                "a character is coded in UTF-8: in 8-bit text it is several others. Save the file as ISO 8859-1 (ANSI).");
    }

    /// In a comment only what can stop a tool counts.
    void comment(std::string_view text)
    {
        for (const char each : text) {
            const auto c = static_cast<unsigned char>(each);
            if (c == 0 || c == 0x1A)
                once(control_seen_, Weight::error,
                     "the line has a control character, which is no text: remove it.");
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
    bool lf_seen_ = false, utf8_seen_ = false, control_seen_ = false;
    unsigned quotes_seen_at_ = 0;
};

/// Most of its lines: an editor may have added one with LF.
bool ends_with_cr_alone(std::string_view content)
{
    std::size_t alone = 0, with_lf = 0;
    for (std::size_t i = 0; i < content.size(); ++i) {
        if (content[i] == '\n') ++with_lf;
        if (content[i] == '\r' && (i + 1 == content.size() || content[i + 1] != '\n')) ++alone;
    }
    return alone > 1 && alone > 4 * with_lf;
}

} // namespace

std::string unreadable(std::string_view content)
{
    if (content.starts_with(kUtf32Low) || content.starts_with(kUtf32High))
        return "the file is UTF-32 (Unicode) text, and a GSD file is 8-bit text: open it in an editor and save it as ISO 8859-1 (ANSI).";
    const bool is_utf16 = content.size() > 1 && (content[0] == '\0') != (content[1] == '\0');
    if (content.starts_with(kUtf16Low) || content.starts_with(kUtf16High) || is_utf16)
        return "the file is UTF-16 (Unicode) text, and a GSD file is 8-bit text: open it in an editor and save it as ISO 8859-1 (ANSI).";
    if (ends_with_cr_alone(content))
        return "the lines end with CR alone, and those of a GSD file with CR LF: open the file in an editor and save it with CR LF (Windows) line ends.";
    if (content.substr(std::min(content.find_first_not_of(" \t\r\n"), content.size())).starts_with(kTypeFile))
        return "this is a type file of COM ET 200, not a GSD file: use the GSD file of the device.";
    return {};
}

std::vector<LogicalLine> logical_lines(std::string_view content, Remarks& remarks)
{
    return LineReader{content, remarks}.read();
}

} // namespace dpslave::gsd
