// SPDX-License-Identifier: Apache-2.0
#include "tag_row.hpp"

#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::profile {
namespace {

using drive::Access;
using drive::Label;
using drive::Tag;
using drive::TagType;
using drive::WritableWhen;

/// In column decimals this word means: as many as the instrument's display has.
constexpr std::string_view kFollowsDisplay = "display";

/// The drive's last error (EI-ASCII reference, section 4). "ee" is a parameter: tag 518 of an AC drive.
constexpr std::string_view kErrorMnemonic = "EE";

/// A complete text as an unsigned number; nullopt if it is anything else or above `max`.
std::optional<std::uint32_t> number_of(std::string_view text, int base, std::uint32_t max)
{
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    if (error != std::errc{} || end != text.data() + text.size() || number > max) return std::nullopt;
    return number;
}

/// "1A2B" or "0x1A2B".
std::optional<std::uint32_t> word_of(std::string_view text)
{
    if (text.starts_with("0x") || text.starts_with("0X")) text.remove_prefix(2);
    return number_of(text, 16, 0xFFFF);
}

/// Reads "-327.68" with 2 decimals as -32768; returns nullopt if it is no such number.
std::optional<std::int32_t> counts_of(std::string_view text, std::size_t decimals)
{
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    const auto point = text.find('.');
    const std::string_view whole = text.substr(0, point);
    std::string_view fraction = point == std::string_view::npos ? std::string_view{} : text.substr(point + 1);
    while (fraction.size() > decimals && fraction.ends_with('0')) fraction.remove_suffix(1);
    if (whole.empty() || fraction.size() > decimals || whole.size() + decimals > 9) return std::nullopt;

    std::string digits{whole};
    digits.append(fraction).append(decimals - fraction.size(), '0');
    const auto number = number_of(digits, 10, 999'999'999);
    if (!number) return std::nullopt;
    return negative ? -static_cast<std::int32_t>(*number) : static_cast<std::int32_t>(*number);
}

class RowReader {
public:
    RowReader(const Row& row, const Columns& columns, const std::string& file, input::Faults& faults)
        : row_(row), columns_(columns), file_(file), faults_(faults)
    {}

    std::optional<Tag> read()
    {
        Tag tag;
        tag.number = static_cast<std::uint16_t>(number(kTag, 0xFFFF).value_or(0));
        if (!given(kTag)) fault(kTag, "the tag number is missing: every row needs one.");
        tag.name = text(kName);
        if (input::has_control_characters(tag.name))
            fault(kName,
                  "the name contains a control character or a line break: write plain text on one line.");
        tag.section = text(kSection);
        tag.notes = text(kNotes);
        tag.type = type();
        tag.follows_display = text(kDecimals) == kFollowsDisplay;
        tag.is_real = text(kType) == "REAL" || tag.follows_display; // its decimals are those of a single
        if (!tag.follows_display) tag.decimals = static_cast<std::uint8_t>(number(kDecimals, 4).value_or(0));
        tag.decimals_known = tag.type != TagType::number || (given(kDecimals) && !tag.follows_display);
        tag.confirmed = yes_or_no(
            kConfirmed, true,
            "write yes, or no for a row that a survey made and that has not been compared with the drive's manual.");
        tag.once = yes_or_no(kOnce, false, "write yes for a parameter of which each write counts, or no.");
        if ((tag.decimals > 0 || tag.follows_display) && tag.type != TagType::number)
            fault(kDecimals, "only INT and REAL have decimals: leave the cell empty, or change the type.");
        tag.access = access();
        tag.when = when();
        tag.mnemonic = mnemonic();
        modbus_register(tag);
        if (!good_) return std::nullopt; // limits and labels have no meaning without their type
        limits(tag);
        labels(tag);
        return good_ ? std::optional{std::move(tag)} : std::nullopt;
    }

private:
    std::string_view text(Column column) const { return columns_.text(row_, column); }
    bool given(Column column) const { return !text(column).empty(); }

    void fault(Column column, std::string what)
    {
        const input::Place at = columns_.place(row_, column);
        faults_.push_back({file_, at.line, at.column, std::move(what)});
        good_ = false;
    }

    /// Adds `what` after the name of the column and the text of the cell.
    void refuse(Column column, std::string_view what)
    {
        fault(column, std::string{kColumnNames[column]} + " " + input::in_quotes(text(column)) + ": " +
                          std::string{what});
    }

    std::optional<std::uint32_t> number(Column column, std::uint32_t max)
    {
        if (!given(column)) return std::nullopt;
        const auto value = number_of(text(column), 10, max);
        const char* const end = column == kDecimals ? ", or display." : ".";
        if (!value) refuse(column, "write a decimal number from 0 to " + std::to_string(max) + end);
        return value;
    }

    TagType type()
    {
        const std::string_view word = text(kType);
        if (word.empty() || word == "INT" || word == "REAL") return TagType::number;
        if (word == "WORD") return TagType::word;
        if (word == "BOOL") return TagType::boolean;
        if (word == "ENUM") return TagType::enumeration;
        if (word == "STRING") return TagType::string;
        refuse(kType, "write INT, WORD, BOOL, ENUM, REAL or STRING.");
        return TagType::number;
    }

    Access access()
    {
        const std::string_view word = text(kAccess);
        if (word == "ro") return Access::read_only;
        if (word == "rw") return Access::read_write;
        if (word == "wo") return Access::write_only;
        if (!word.empty()) refuse(kAccess, "write ro, rw or wo, or leave it empty if not known.");
        return Access::unknown;
    }

    bool yes_or_no(Column column, bool if_empty, std::string_view advice)
    {
        const std::string_view word = text(column);
        if (word.empty()) return if_empty;
        if (word != "yes" && word != "no") refuse(column, advice);
        return word == "yes";
    }

    WritableWhen when()
    {
        const std::string_view word = text(kWhen);
        for (const WritableWhen one : {WritableWhen::stopped, WritableWhen::configuration})
            if (word == drive::text(one)) return one;
        if (!word.empty()) refuse(kWhen, "write stopped or configuration, or leave it empty if not known.");
        return WritableWhen::not_said;
    }

    /// In the IEEE area a number is a single, a whole number is in the first register, a time in both as ms.
    void modbus_register(Tag& tag)
    {
        constexpr std::uint16_t ieee_area = 0x8000;
        const auto reg = number(kRegister, 0xFFFF);
        if (!reg) return;
        tag.modbus_register = static_cast<std::uint16_t>(*reg);
        if (*reg >= ieee_area && *reg % 2 != 0)
            fault(
                kRegister,
                "register " + input::in_quotes(text(kRegister)) +
                    " is odd: in the IEEE area (32768 and above) a tag has two registers and begins at an even one, 32768 + 2 x tag.");
        const bool is_whole = tag.type == TagType::number && !tag.is_real;
        if (*reg >= ieee_area && (tag.type == TagType::string || is_whole))
            fault(
                kRegister,
                "register " + input::in_quotes(text(kRegister)) +
                    " is in the IEEE area (32768 and above), which has singles: write type REAL if this is one, otherwise the register of the normal area.");
    }

    std::string mnemonic()
    {
        const std::string_view word = text(kMnemonic);
        const bool printable =
            std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c < '\x7F'; });
        if (!word.empty() && (word.size() != 2 || !printable))
            refuse(kMnemonic, "write two printable characters, or none for the profile's rule.");
        if (word == kErrorMnemonic)
            fault(
                kMnemonic,
                "mnemonic \"EE\" is the drive's last error on an EI-ASCII line, no parameter: write the one of the tag, or leave it empty for the profile's rule.");
        return std::string{word};
    }

    /// A value as the table writes it for this type, in counts.
    static std::optional<std::int32_t> value_of(const Tag& tag, std::string_view word)
    {
        std::optional<std::uint32_t> value;
        switch (tag.type) {
            case TagType::number: return counts_of(word, tag.decimals);
            case TagType::word: value = word_of(word); break;
            case TagType::boolean: value = number_of(word, 10, 1); break;
            case TagType::enumeration: value = number_of(word, 10, 255); break;
            case TagType::string: break;
        }
        return value ? std::optional{static_cast<std::int32_t>(*value)} : std::nullopt;
    }

    static std::string wanted(const Tag& tag)
    {
        switch (tag.type) {
            case TagType::number:
                return tag.decimals == 0
                           ? "write a whole number, or say in column decimals how many it has"
                           : "write a number with at most " + std::to_string(tag.decimals) + " decimals";
            case TagType::word: return "write a hexadecimal number from 0 to FFFF";
            case TagType::boolean: return "write 0 or 1";
            case TagType::enumeration: return "write a number from 0 to 255";
            case TagType::string: break;
        }
        return "a STRING has none, leave the cell empty";
    }

    std::optional<std::int32_t> limit(const Tag& tag, Column column)
    {
        if (!given(column)) return std::nullopt;
        const auto value = value_of(tag, text(column));
        if (!value)
            fault(column, std::string{kColumnNames[column]} + " " + input::in_quotes(text(column)) + ": " +
                              wanted(tag) + ".");
        return value;
    }

    void limits(Tag& tag)
    {
        for (const Column column : {kMin, kMax})
            if (tag.follows_display && given(column))
                fault(
                    column,
                    std::string{kColumnNames[column]} + " " + input::in_quotes(text(column)) +
                        ": a value whose decimals follow the display has no fixed limits here, leave the cell empty.");
        if (tag.follows_display) return;
        tag.min = limit(tag, kMin);
        tag.max = limit(tag, kMax);
        if (tag.min && tag.max && *tag.min > *tag.max)
            fault(kMin, "min " + input::in_quotes(text(kMin)) + " is above max " +
                            input::in_quotes(text(kMax)) + ": swap them.");
        if (tag.type != TagType::number) return;
        tag.is_unsigned = tag.min && *tag.min >= 0 && tag.max && *tag.max > 32767;
        const std::int32_t lowest = tag.is_unsigned ? 0 : -32768;
        const std::int32_t highest = tag.is_unsigned ? 65535 : 32767;
        const std::string range = " does not fit in 16 bits: with these decimals " + std::to_string(lowest) +
                                  " to " + std::to_string(highest) + " counts do" +
                                  (tag.is_unsigned ? "." : ", and up to 65535 only with a min of 0 or more.");
        if (tag.min && (*tag.min < lowest || *tag.min > highest))
            fault(kMin, "min " + input::in_quotes(text(kMin)) + range);
        if (tag.max && (*tag.max < lowest || *tag.max > highest))
            fault(kMax, "max " + input::in_quotes(text(kMax)) + range);
    }

    void labels(Tag& tag)
    {
        std::string_view rest = text(kValues);
        while (!rest.empty()) {
            const auto end = rest.find(';');
            const std::string_view item = rest.substr(0, end);
            rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
            if (item.find_first_not_of(' ') == std::string_view::npos) continue;
            const auto label = label_of(tag, item);
            if (!label) return;
            const auto same = [&](const Label& other) {
                return other.is_bit == label->is_bit && other.number == label->number;
            };
            if (std::any_of(tag.labels.begin(), tag.labels.end(), same)) {
                fault(kValues, "values: " + input::in_quotes(item) +
                                   " names the same value again: keep one of the two.");
                return;
            }
            tag.labels.push_back(*label);
        }
    }

    std::optional<Label> label_of(const Tag& tag, std::string_view item)
    {
        const auto strip = [](std::string_view part) {
            while (part.starts_with(' ')) part.remove_prefix(1);
            while (part.ends_with(' ')) part.remove_suffix(1);
            return part;
        };
        const auto equals = item.find('=');
        const std::string_view left = strip(item.substr(0, equals));
        const std::string_view right =
            equals == std::string_view::npos ? std::string_view{} : strip(item.substr(equals + 1));
        if (left.empty() || right.empty()) {
            fault(kValues, "values: " + input::in_quotes(item) +
                               ": write value=label or bitN=label, with ; between two.");
            return std::nullopt;
        }
        Label label{left.starts_with("bit"), 0, std::string{right}};
        if (label.is_bit) {
            const auto bit = number_of(left.substr(3), 10, 15);
            const bool has_bits = tag.type == TagType::word || tag.type == TagType::number;
            if (!bit || !has_bits) {
                fault(kValues,
                      "values: " + input::in_quotes(item) +
                          (has_bits ? ": bits go from bit0 to bit15." : ": only WORD and INT have bits."));
                return std::nullopt;
            }
            label.number = static_cast<std::uint16_t>(*bit);
            return label;
        }
        const auto value = value_of(tag, left);
        if (!value || *value < -32768 || *value > 65535) {
            fault(kValues, "values: " + input::in_quotes(item) + ": before the = " + wanted(tag) + ".");
            return std::nullopt;
        }
        label.number = static_cast<std::uint16_t>(*value);
        return label;
    }

    const Row& row_;
    const Columns& columns_;
    const std::string& file_;
    input::Faults& faults_;
    bool good_ = true;
};

bool same_labels(const std::vector<Label>& left, const std::vector<Label>& right)
{
    return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                      [](const Label& a, const Label& b) {
                          return a.is_bit == b.is_bit && a.number == b.number && a.text == b.text;
                      });
}

} // namespace

std::string_view nearly_a_column(std::string_view name)
{
    static const std::vector<std::string> names{kColumnNames.begin(), kColumnNames.end()};
    if (std::find(names.begin(), names.end(), name) != names.end()) return {};
    std::string letters;
    for (const char c : name) {
        const bool is_large = c >= 'A' && c <= 'Z';
        if (is_large || (c >= 'a' && c <= 'z')) letters += static_cast<char>(is_large ? c - 'A' + 'a' : c);
    }
    for (const std::string& legal : names) { // "decimal places", "mnemonics"
        const std::string_view stem{legal.data(), legal.size() - (legal.back() == 's' ? 1 : 0)};
        if (stem.size() >= 6 && letters.starts_with(stem)) return legal;
    }
    return input::nearest(letters, names, letters.size() > 5 ? 2 : letters.size() > 2 ? 1 : 0);
}

std::string_view Columns::text(const Row& row, Column column) const
{
    const std::size_t cell = index[column];
    return cell < row.cells.size() ? std::string_view{row.cells[cell].text} : std::string_view{};
}

input::Place Columns::place(const Row& row, Column column) const
{
    const std::size_t cell = index[column];
    return cell < row.cells.size() ? input::Place{row.cells[cell].line, row.cells[cell].column}
                                   : input::Place{row.line, 0};
}

std::optional<Tag> read_tag(const Row& row, const Columns& columns, const std::string& file,
                            input::Faults& faults)
{
    return RowReader{row, columns, file, faults}.read();
}

bool is_name_only(const Row& row, const Columns& columns)
{
    constexpr std::array says_more{kType,     kDecimals, kMin,    kMax,       kAccess, kWhen,
                                   kMnemonic, kRegister, kValues, kConfirmed, kOnce};
    return std::all_of(says_more.begin(), says_more.end(),
                       [&](Column column) { return columns.text(row, column).empty(); });
}

std::optional<Column> contradiction(const Tag& known, const Tag& tag, const Row& row, const Columns& columns)
{
    const auto given = [&](Column column) { return !columns.text(row, column).empty(); };
    if (given(kType) && (known.type != tag.type || known.is_real != tag.is_real)) return kType;
    if (given(kDecimals) && (known.decimals != tag.decimals || known.follows_display != tag.follows_display))
        return kDecimals;
    if (given(kMin) && known.min != tag.min) return kMin;
    if (given(kMax) && known.max != tag.max) return kMax;
    if (given(kOnce) && known.once != tag.once) return kOnce;
    if (given(kConfirmed) && known.confirmed != tag.confirmed) return kConfirmed;
    if (given(kAccess) && known.access != tag.access) return kAccess;
    if (given(kWhen) && known.when != tag.when) return kWhen;
    if (given(kMnemonic) && known.mnemonic != tag.mnemonic) return kMnemonic;
    if (given(kRegister) && known.modbus_register != tag.modbus_register) return kRegister;
    if (given(kValues) && !same_labels(known.labels, tag.labels)) return kValues;
    return std::nullopt;
}

} // namespace dpslave::profile
