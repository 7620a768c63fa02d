// SPDX-License-Identifier: Apache-2.0
#include "gsd_file.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>

namespace dpslave::sim {
namespace {

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string without_blanks(std::string_view text)
{
    std::string out;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        if (quoted || !is_blank(c)) out += c;
    }
    return out;
}

/// Returns the place of `c` outside of quotation marks.
std::size_t find_bare(std::string_view text, char c)
{
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') quoted = !quoted;
        if (!quoted && text[i] == c) return i;
    }
    return std::string_view::npos;
}

/// A line without its comment; continued lines are joined.
struct Line {
    std::string text{};
    unsigned number = 0; ///< of the first
};

/// Adds one line of the file. Returns true if the next one continues it.
bool append(std::string_view physical, Line& line, bool& quoted)
{
    std::string& text = line.text;
    const std::size_t from = text.size();
    for (const char c : physical) {
        if (c == '"') quoted = !quoted;
        if (c == ';' && !quoted) break;
        text += c;
    }
    while (text.size() > from && is_blank(text.back())) text.pop_back();
    if (text.size() == from || text.back() != '\\') return false;
    text.pop_back();
    return true;
}

std::vector<Line> lines_of(std::string_view text)
{
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const char end_of_line = text.find('\n') == std::string_view::npos ? '\r' : '\n';
    std::vector<Line> out;
    bool continued = false, quoted = false;
    for (unsigned number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find(end_of_line), text.size());
        if (!continued) {
            out.push_back({{}, number});
            quoted = false;
        }
        continued = append(text.substr(0, end), out.back(), quoted);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

/// Bits of a value, its sign, and its place, of "Unsigned16", "Bit(3)" or "BitArea(4-6)".
struct Type {
    unsigned bits = 0;
    unsigned first_bit = 0;
    bool is_signed = false;
};

std::optional<Type> type_of(const std::string& name)
{
    constexpr std::array<std::pair<std::string_view, Type>, 6> kWhole{{{"unsigned8", {8, 0, false}},
                                                                       {"unsigned16", {16, 0, false}},
                                                                       {"unsigned32", {32, 0, false}},
                                                                       {"signed8", {8, 0, true}},
                                                                       {"signed16", {16, 0, true}},
                                                                       {"signed32", {32, 0, true}}}};
    for (const auto& [known, type] : kWhole)
        if (name == known) return type;
    const std::size_t open = name.find('(');
    if (open == std::string::npos || !name.ends_with(')')) return std::nullopt;
    const std::string word = name.substr(0, open), range = name.substr(open + 1, name.size() - open - 2);
    const std::size_t dash = range.find('-');
    const bool is_area = word == "bitarea" && dash != std::string::npos;
    if (!is_area && word != "bit") return std::nullopt;
    const auto first = gsd_number(is_area ? range.substr(0, dash) : range);
    const auto last = is_area ? gsd_number(range.substr(dash + 1)) : first;
    if (!first || !last) return std::nullopt;
    const auto [low, high] = std::minmax(*first, *last);
    if (low < 0 || high > 7) return std::nullopt;
    return Type{static_cast<unsigned>(high - low + 1), static_cast<unsigned>(low), false};
}

/// "BitArea(4-6) 2 0,1,2,5" into its parts; the range of the values is for tools with a window.
void read_default(std::string_view text, PrmBlock& into)
{
    const std::size_t open = text.find('(');
    const bool has_bits = open != std::string_view::npos && to_lower(text).starts_with("bit");
    const std::size_t end = has_bits ? text.find(')') + 1 : text.find_first_of(" \t");
    const auto type = type_of(to_lower(without_blanks(text.substr(0, end))));
    if (!type) {
        into.fault = fmt::format("'{}' is no type of a parameter that is known", printable(text));
        return;
    }
    const std::string_view rest = end < text.size() ? trimmed(text.substr(end)) : std::string_view{};
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
    const auto value = gsd_number(word);
    const std::int64_t least = type->is_signed ? -(std::int64_t{1} << (type->bits - 1)) : 0;
    const std::int64_t most = (std::int64_t{1} << (type->is_signed ? type->bits - 1 : type->bits)) - 1;
    if (!value || *value < least || *value > most) {
        into.fault = fmt::format("the default '{}' is no number of this type", printable(word));
        return;
    }
    into.octets = type->bits > 8 ? type->bits / 8 : 1;
    into.first_bit = type->first_bit;
    into.mask = static_cast<std::uint32_t>((std::uint64_t{1} << type->bits) - 1);
    into.value = static_cast<std::uint32_t>(*value) & into.mask;
}

class Parser {
public:
    Result<GsdFile, std::string> parse(std::string_view text)
    {
        for (const Line& line : lines_of(text)) {
            const std::string_view bare = trimmed(line.text);
            if (bare.starts_with('#')) {
                in_section_ = same_any_case(bare, "#Profibus_DP");
                found_ = found_ || in_section_;
            } else if (in_section_ && !bare.empty()) {
                take(bare, line.number);
            }
        }
        if (!found_) return Failure{std::string{"there is no line #Profibus_DP: it is no GSD file"}};
        return std::move(file_);
    }

private:
    enum class Block : std::uint8_t { device, module, parameter };

    void take(std::string_view text, unsigned line)
    {
        const std::size_t equals = find_bare(text, '=');
        if (equals == std::string_view::npos) return take_word(text, line);
        const std::string key = without_blanks(text.substr(0, equals));
        const std::string_view value = trimmed(text.substr(equals + 1));
        if (same_any_case(key, "Module")) return open_module(value, line);
        if (same_any_case(key, "ExtUserPrmData")) return open_parameter(value, line);
        const bool of_parameter = same_any_case(key, "Prm_Text_Ref") || same_any_case(key, "Changeable") ||
                                  same_any_case(key, "Visible");
        if (block_ == Block::parameter && of_parameter) return;
        add_entry(key, value, line);
    }

    /// A line without "=": the end of a block, the type of a parameter, the reference number of a module.
    void take_word(std::string_view text, unsigned line)
    {
        if (same_any_case(text, "EndModule") || same_any_case(text, "EndExtUserPrmData")) {
            block_ = Block::device;
        } else if (block_ == Block::parameter && file_.parameters.back().octets == 0) {
            PrmBlock& parameter = file_.parameters.back();
            parameter.fault.clear();
            read_default(text, parameter);
            if (!parameter.fault.empty()) parameter.fault = fmt::format("line {}: {}", line, parameter.fault);
        }
    }

    void add_entry(const std::string& key, std::string_view value, unsigned line)
    {
        GsdEntry entry{key, std::nullopt, without_blanks(value), line};
        const std::size_t open = key.find('(');
        if (open != std::string::npos && key.ends_with(')')) {
            const auto number = gsd_number(std::string_view{key}.substr(open + 1, key.size() - open - 2));
            if (number && *number >= 0 && *number <= 0xFFFF) {
                entry.key.resize(open);
                entry.at = static_cast<unsigned>(*number);
            }
        }
        (block_ == Block::module ? file_.modules.back().entries : file_.entries)
            .all.push_back(std::move(entry));
    }

    void open_module(std::string_view value, unsigned line)
    {
        block_ = Block::module;
        GsdModule& module = file_.modules.emplace_back();
        const std::size_t open = value.find('"');
        const std::size_t close = open == std::string_view::npos ? open : value.find('"', open + 1);
        if (close == std::string_view::npos) {
            module.fault = fmt::format("line {}: the name of the module has no quotation marks", line);
            return;
        }
        module.name = utf8(trimmed(value.substr(open + 1, close - open - 1)));
        const std::string list = without_blanks(value.substr(close + 1));
        if (auto octets = gsd_octets(list); octets && !octets->empty())
            module.identifiers = std::move(*octets);
        else
            module.fault = fmt::format("line {}: '{}' are no identifier octets", line, printable(list));
    }

    void open_parameter(std::string_view value, unsigned line)
    {
        block_ = Block::parameter;
        const auto number = gsd_number(trimmed(value.substr(0, value.find('"'))));
        PrmBlock& parameter = file_.parameters.emplace_back();
        parameter.reference = number.value_or(-1);
        parameter.fault = fmt::format("line {}: the parameter has no type and no default", line);
    }

    GsdFile file_;
    Block block_ = Block::device;
    bool in_section_ = false, found_ = false;
};

} // namespace

const GsdEntry* GsdEntries::find(std::string_view key) const
{
    const auto found = std::find_if(all.rbegin(), all.rend(),
                                    [&](const GsdEntry& entry) { return same_any_case(entry.key, key); });
    return found == all.rend() ? nullptr : &*found;
}

Result<std::uint32_t, std::string> GsdEntries::number(std::string_view key, std::uint32_t most,
                                                      std::uint32_t absent) const
{
    const GsdEntry* const entry = find(key);
    if (entry == nullptr) return absent;
    const auto number = gsd_number(entry->value);
    if (!number || *number < 0 || *number > most)
        return Failure{fmt::format("line {}: {} = {}, but it is a number from 0 to {}", entry->line,
                                   printable(entry->key), printable(entry->value), most)};
    return static_cast<std::uint32_t>(*number);
}

bool GsdEntries::is_on(std::string_view key) const
{
    const GsdEntry* const entry = find(key);
    return entry != nullptr && gsd_number(entry->value) == 1;
}

std::string GsdEntries::text(std::string_view key) const
{
    const GsdEntry* const entry = find(key);
    const std::size_t open = entry == nullptr ? std::string::npos : entry->value.find('"');
    if (open == std::string::npos) return {};
    return utf8(std::string_view{entry->value}.substr(open + 1, entry->value.find('"', open + 1) - open - 1));
}

std::optional<std::int64_t> gsd_number(std::string_view text)
{
    const bool minus = text.starts_with('-');
    if (minus) text.remove_prefix(1);
    const bool is_hex = text.starts_with("0x") || text.starts_with("0X");
    if (is_hex) text.remove_prefix(2);
    std::uint32_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number, is_hex ? 16 : 10);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
    return minus ? -std::int64_t{number} : std::int64_t{number};
}

std::optional<Octets> gsd_octets(std::string_view list)
{
    Octets out;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        const auto number = gsd_number(trimmed(list.substr(0, comma)));
        if (!number || *number < 0 || *number > 0xFF || comma + 1 == list.size()) return std::nullopt;
        out.push_back(static_cast<std::uint8_t>(*number));
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return out;
}

Result<GsdFile, std::string> parse_gsd(std::string_view text)
{
    return Parser{}.parse(text);
}

Result<GsdFile, std::string> load_gsd(const std::string& path)
{
    const std::ifstream file(path, std::ios::binary);
    if (!file) return Failure{fmt::format("{}: cannot be read; give another one with --gsd FILE", path)};
    std::ostringstream text;
    text << file.rdbuf();
    auto read = parse_gsd(text.str());
    if (!read) return Failure{fmt::format("{}: {}", path, read.error())};
    return read;
}

} // namespace dpslave::sim
