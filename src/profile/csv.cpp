// SPDX-License-Identifier: Apache-2.0
#include "csv.hpp"

#include "dpslave/base/printable.hpp"

namespace dpslave::profile {
namespace {

std::string trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return std::string{text.substr(first, text.find_last_not_of(" \t") - first + 1)};
}

class Reader {
public:
    Reader(std::string_view content, const std::string& file, input::Faults& faults)
        : rest_(content), file_(file), faults_(faults)
    {}

    std::vector<Row> rows()
    {
        std::vector<Row> out;
        while (!rest_.empty() && faults_.size() <= input::kMaxFaults) {
            Row row = read_row();
            const bool empty = row.cells.size() == 1 && row.cells[0].text.empty();
            row.good = row_is_good_;
            if (!row.good || !empty) out.push_back(std::move(row));
        }
        return out;
    }

private:
    bool at_end_of_line() const
    {
        return rest_.empty() || rest_.starts_with('\n') || rest_.starts_with("\r\n");
    }

    Row read_row()
    {
        row_is_good_ = true;
        const char* const begin = rest_.data();
        Row row{line_, true, {}, {}};
        for (;;) {
            row.cells.push_back(read_cell());
            if (at_end_of_line()) break;
            take(); // the comma
        }
        row.written = {begin, static_cast<std::size_t>(rest_.data() - begin)};
        if (rest_.starts_with('\r')) take();
        if (!rest_.empty()) take();
        return row;
    }

    Cell read_cell()
    {
        Cell cell{{}, line_, column_};
        std::string blanks;
        while (rest_.starts_with(' ') || rest_.starts_with('\t')) blanks += take();
        if (rest_.starts_with('"')) {
            cell.column = column_;
            read_quoted(cell);
            return cell;
        }
        std::string text = std::move(blanks);
        while (!at_end_of_line() && !rest_.starts_with(',')) {
            if (rest_.starts_with('"'))
                fault("a quote within a cell: put the whole cell in quotes and write this quote twice.");
            text += take();
        }
        cell.text = trimmed(text);
        return cell;
    }

    void read_quoted(Cell& cell)
    {
        const unsigned opened_line = line_;
        const unsigned opened_column = column_;
        take();
        for (;;) {
            if (rest_.empty()) {
                fault_at(opened_line, opened_column,
                         "this quote is never closed: end the cell with a quote.");
                return;
            }
            if (rest_.starts_with("\"\"")) {
                take();
                cell.text += take();
            } else if (rest_.starts_with('"')) {
                take();
                break;
            } else {
                cell.text += take();
            }
        }
        while (rest_.starts_with(' ') || rest_.starts_with('\t')) take();
        if (at_end_of_line() || rest_.starts_with(',')) return;
        fault(
            "text after the closing quote: end the cell with a comma here, or write a quote within it twice.");
        while (!at_end_of_line() && !rest_.starts_with(',')) take();
    }

    /// The next character, which is counted; a wrong one is a fault.
    std::string_view take()
    {
        const std::size_t length = character_length(rest_);
        const std::string_view character = rest_.substr(0, length > 0 ? length : 1);
        const bool ends_line = character == "\n" || rest_.starts_with("\r\n");
        if (is_control(character) && !ends_line && character != "\t")
            fault("a control character: write plain text only, and save the table as UTF-8.");
        rest_.remove_prefix(character.size());
        ++column_;
        if (character == "\n") {
            ++line_;
            column_ = 1;
        }
        return character;
    }

    void fault(const char* what) { fault_at(line_, column_, what); }
    void fault_at(unsigned line, unsigned column, const char* what)
    {
        // One fault a row: what follows in it would only be its echo.
        if (row_is_good_) faults_.push_back({file_, line, column, what});
        row_is_good_ = false;
    }

    std::string_view rest_;
    const std::string& file_;
    input::Faults& faults_;
    unsigned line_ = 1;
    unsigned column_ = 1;
    bool row_is_good_ = true;
};

} // namespace

std::vector<Row> read_csv(std::string_view content, const std::string& file, input::Faults& faults)
{
    return Reader{content, file, faults}.rows();
}

std::string csv_cell(std::string_view text)
{
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && !text.starts_with(' ') &&
                          !text.ends_with(' ');
    if (is_plain) return std::string{text};
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string{"\"\""} : std::string{c};
    return out + '"';
}

} // namespace dpslave::profile
