// SPDX-License-Identifier: Apache-2.0
#include "tag_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

namespace dpslave::sim {
namespace {

using Fields = std::vector<std::string>;

/// The limit is what an instrument of the 2000 series can show, and more.
constexpr std::int32_t kMostCounts = 9'999'999;

/// Splits a line into its fields; quotes hide commas, a doubled quote is a quote. It returns nullopt if a
/// quote is not closed.
std::optional<Fields> fields_of(std::string_view line)
{
    Fields fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += c;
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    if (quoted) return std::nullopt;
    return fields;
}

std::optional<std::int32_t> decimal_counts(std::string_view text, unsigned decimals)
{
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    std::string digits;
    unsigned after = 0;
    bool point = false;
    for (const char c : text) {
        if (c == '.' && !point) {
            point = true;
        } else if (c >= '0' && c <= '9') {
            if (point && after == decimals) {
                if (c != '0') return std::nullopt;
                continue;
            }
            after += point ? 1U : 0U;
            digits += c;
        } else {
            return std::nullopt;
        }
    }
    if (digits.empty() || digits.size() > 9) return std::nullopt;
    digits.append(decimals - after, '0');
    std::int64_t counts = 0;
    for (const char c : digits) counts = counts * 10 + (c - '0');
    return static_cast<std::int32_t>(negative ? -counts : counts);
}

std::optional<std::int32_t> hex_word(std::string_view text)
{
    if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
    if (text.starts_with(">")) text.remove_prefix(1);
    std::uint16_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.empty() || error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::int32_t> plain_number(std::string_view text, std::int32_t most)
{
    std::int32_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || stop != text.data() + text.size() || value < 0 ||
        value > most)
        return std::nullopt;
    return value;
}

/// "0=Stop;1=Run" or "bit0=Ready;bit1=Run".
std::optional<std::vector<SimLabel>> labels_of(std::string_view text)
{
    std::vector<SimLabel> labels;
    while (!text.empty()) {
        const auto end = std::min(text.find(';'), text.size());
        std::string_view part = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const bool is_bit = part.starts_with("bit");
        if (is_bit) part.remove_prefix(3);
        const auto equal = part.find('=');
        if (equal == std::string_view::npos || equal + 1 == part.size()) return std::nullopt;
        const auto number = plain_number(part.substr(0, equal), is_bit ? 15 : 65535);
        if (!number) return std::nullopt;
        if (!is_bit)
            labels.push_back({static_cast<std::uint16_t>(*number), std::string{part.substr(equal + 1)}});
    }
    return labels;
}

std::optional<std::int32_t> counts_of_text(const SimTag& tag, std::string_view text)
{
    return tag.type == TagKind::word ? hex_word(text) : decimal_counts(text, tag.decimals);
}

/// One line of the file, asked for by column name.
class Row {
public:
    Row(const std::map<std::string, std::size_t>& columns, const Fields& fields)
        : columns_(columns), fields_(fields)
    {}
    std::string operator[](const std::string& column) const
    {
        const auto found = columns_.find(column);
        return found == columns_.end() || found->second >= fields_.size() ? std::string{}
                                                                          : fields_[found->second];
    }

private:
    const std::map<std::string, std::size_t>& columns_;
    const Fields& fields_;
};

/// Empty = good, else what is wrong.
std::string read_kind(const Row& row, SimTag& tag)
{
    const std::string type = row["type"];
    constexpr std::array<std::pair<std::string_view, TagKind>, 7> kKinds{{{"", TagKind::word},
                                                                          {"INT", TagKind::number},
                                                                          {"REAL", TagKind::number},
                                                                          {"WORD", TagKind::word},
                                                                          {"BOOL", TagKind::boolean},
                                                                          {"ENUM", TagKind::enumeration},
                                                                          {"STRING", TagKind::string}}};
    const auto* const kind =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.first == type; });
    if (kind == kKinds.end())
        return fmt::format("type '{}' is none of INT, REAL, WORD, BOOL, ENUM, STRING", type);
    tag.type = kind->second;
    tag.has_type = !type.empty();

    const std::string decimals = row["decimals"];
    tag.follows_display = decimals == "display" && tag.type == TagKind::number;
    tag.is_real = type == "REAL" || tag.follows_display;
    if (tag.type == TagKind::number && row["notes"].find("time type") != std::string::npos)
        tag.ms_per_count = tag.name.find("in minutes") != std::string::npos ? 60'000 : 1'000;
    const auto count = decimals.empty() || decimals == "display" ? std::optional<std::int32_t>{0}
                                                                 : plain_number(decimals, 4);
    if (!count) return fmt::format("decimals '{}' is not 0 to 4, nor display", decimals);
    if (tag.type == TagKind::number)
        tag.decimals = tag.follows_display ? kDisplayDecimals : static_cast<unsigned>(*count);

    const std::string access = row["access"];
    if (access == "ro")
        tag.access = TagAccess::read_only;
    else if (access == "wo")
        tag.access = TagAccess::write_only;
    else if (!access.empty() && access != "rw")
        return fmt::format("access '{}' is none of ro, rw, wo", access);

    tag.mnemonic = row["mnemonic"];
    if (!tag.mnemonic.empty() && tag.mnemonic.size() != 2)
        return fmt::format("mnemonic '{}' must have two characters", tag.mnemonic);
    const auto labels = labels_of(row["values"]);
    if (!labels) return fmt::format("values '{}' must be value=label;... or bitN=label;...", row["values"]);
    tag.labels = *labels;
    return {};
}

std::string read_limits(const Row& row, SimTag& tag)
{
    switch (tag.type) {
        case TagKind::number: tag.min = -32768, tag.max = 32767; break;
        case TagKind::word: tag.max = 0xFFFF; break;
        case TagKind::boolean: tag.max = 1; break;
        case TagKind::enumeration: tag.max = 255; break;
        case TagKind::string: return {};
    }
    std::int32_t lowest = -32768, highest = tag.type == TagKind::number ? 65535 : tag.max;
    if (tag.follows_display) { // a floating point value inside; the word is only one way to read it
        tag.min = lowest = -kMostCounts;
        tag.max = highest = kMostCounts;
    }
    for (const auto& [column, limit] : {std::pair{"min", &tag.min}, std::pair{"max", &tag.max}}) {
        const std::string text = row[column];
        if (text.empty()) continue;
        const auto counts = counts_of_text(tag, text);
        if (!counts || *counts < lowest || *counts > highest)
            return fmt::format("{} '{}' does not fit into the 16 bits of this type with {} decimals", column,
                               text, tag.decimals);
        *limit = *counts;
    }
    if (tag.min > tag.max) return fmt::format("min '{}' is above max '{}'", row["min"], row["max"]);
    if (!tag.follows_display && tag.max > 32767 && tag.min < 0)
        return "min below 0 and max above 32767 do not fit into one 16-bit word";
    return {};
}

std::string read_start(const Row& row, SimTag& tag)
{
    const std::string text = row["start"];
    if (text.empty()) {
        tag.start.counts = tag.type == TagKind::string ? 0 : std::clamp(0, tag.min, tag.max);
        return {};
    }
    const auto value = value_of_text(tag, text);
    if (!value) return fmt::format("start '{}' is no value of this tag within its limits", text);
    tag.start = *value;
    tag.has_start = true;
    return {};
}

std::string read_row(const Row& row, SimTag& tag)
{
    const auto number = plain_number(row["tag"], 65535);
    if (!number) return fmt::format("tag '{}' is no number from 0 to 65535", row["tag"]);
    tag.number = static_cast<std::uint16_t>(*number);
    tag.name = row["name"];
    for (const auto read : {read_kind, read_limits, read_start})
        if (std::string wrong = read(row, tag); !wrong.empty()) return wrong;
    return {};
}

/// Sorted by tag; lines of one tag (a second name for it) give one parameter: the first line that says its
/// type counts, else the first.
std::vector<SimTag> sorted(std::vector<SimTag> tags)
{
    std::stable_sort(tags.begin(), tags.end(), [](const SimTag& a, const SimTag& b) {
        return a.number != b.number ? a.number < b.number : a.has_type && !b.has_type;
    });
    const auto last = std::unique(tags.begin(), tags.end(),
                                  [](const SimTag& a, const SimTag& b) { return a.number == b.number; });
    tags.erase(last, tags.end());
    return tags;
}

} // namespace

std::int32_t rescaled(std::int32_t counts, unsigned from, unsigned to)
{
    std::int64_t value = counts;
    for (; from < to; ++from) value *= 10;
    std::int64_t divisor = 1;
    for (; from > to; --from) divisor *= 10;
    const std::int64_t half = divisor / 2;
    value = (value < 0 ? value - half : value + half) / divisor;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, INT32_MIN, INT32_MAX));
}

std::string displayed(const SimTag& tag, const SimValue& value)
{
    if (tag.type == TagKind::string) return value.text;
    if (tag.type == TagKind::word) return fmt::format(">{:04X}", value.counts & 0xFFFF);
    if (tag.type != TagKind::number) {
        for (const SimLabel& label : tag.labels)
            if (label.number == value.counts) return fmt::format("{} ({})", value.counts, label.text);
        return fmt::format("{}", value.counts);
    }
    std::int32_t scale = 1;
    for (unsigned i = 0; i < tag.decimals; ++i) scale *= 10;
    const std::int32_t magnitude = value.counts < 0 ? -value.counts : value.counts;
    const std::string_view sign = value.counts < 0 ? "-" : "";
    if (tag.decimals == 0) return fmt::format("{}{}", sign, magnitude);
    return fmt::format("{}{}.{:0{}}", sign, magnitude / scale, magnitude % scale, tag.decimals);
}

std::optional<SimValue> value_of_text(const SimTag& tag, std::string_view text)
{
    if (tag.type == TagKind::string) return SimValue{0, std::string{text}};
    for (const SimLabel& label : tag.labels)
        if (label.text == text) return SimValue{label.number, {}};
    const auto counts =
        text.starts_with('>') || text.starts_with("0x") ? hex_word(text) : counts_of_text(tag, text);
    if (!counts || *counts < tag.min || *counts > tag.max) return std::nullopt;
    return SimValue{*counts, {}};
}

Result<std::vector<SimTag>, std::string> parse_tags(std::string_view text, std::string_view file)
{
    std::map<std::string, std::size_t> columns;
    std::vector<SimTag> tags;
    for (unsigned line_number = 1; !text.empty(); ++line_number) {
        const auto end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        if (line.empty()) continue;
        const auto wrong = [&](std::string_view sentence) {
            return fmt::format("{}:{}: {}", file, line_number, sentence);
        };
        const auto fields = fields_of(line);
        if (!fields) return Failure{wrong("a quotation mark is not closed")};
        if (columns.empty()) {
            for (std::size_t i = 0; i < fields->size(); ++i)
                if (!columns.emplace((*fields)[i], i).second && !(*fields)[i].empty())
                    return Failure{wrong(fmt::format("column '{}' is there twice", (*fields)[i]))};
            if (!columns.contains("tag"))
                return Failure{wrong("the first line names the columns, and 'tag' is not among them")};
            continue;
        }
        if (fields->size() > columns.size())
            return Failure{wrong(fmt::format("{} fields, but the first line names {} columns", fields->size(),
                                             columns.size()))};
        SimTag tag;
        if (const std::string sentence = read_row(Row{columns, *fields}, tag); !sentence.empty())
            return Failure{wrong(sentence)};
        tags.push_back(std::move(tag));
    }
    if (tags.empty()) return Failure{fmt::format("{}: there is no tag in it", file)};
    return sorted(std::move(tags));
}

Result<std::vector<SimTag>, std::string> load_tags(const std::string& path)
{
    const std::ifstream file(path, std::ios::binary);
    if (!file) return Failure{fmt::format("{}: cannot be read; give another one with --table FILE", path)};
    std::ostringstream text;
    text << file.rdbuf();
    return parse_tags(text.str(), path);
}

} // namespace dpslave::sim
