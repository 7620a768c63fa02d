// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/document.hpp"

#include "keywords.hpp"
#include "lines.hpp"
#include "text.hpp"

#include "dpslave/base/edit_distance.hpp"

#include <algorithm>

namespace dpslave::gsd {
namespace {

constexpr std::string_view kSection = "#Profibus_DP";
constexpr std::size_t kSlips = 3; ///< letters that differ, and it is still meant

/// `keyword(index) = value` taken apart. The index may be anything; only a number is kept.
Entry entry_of(const LogicalLine& line, Remarks& remarks)
{
    Entry entry;
    entry.line = line.number;
    const std::string_view text = line.text;
    const auto equals = text.find('=');
    const auto quote = text.find('"');
    if (equals == std::string_view::npos || quote < equals || trimmed(text.substr(0, equals)).empty()) {
        entry.value = std::string{trimmed(text)};
        return entry;
    }
    std::string_view name = trimmed(text.substr(0, equals));
    entry.value = std::string{trimmed(text.substr(equals + 1))};
    if (const auto open = name.find('('); open != std::string_view::npos) {
        const auto close = name.find(')', open);
        const std::string_view inside = trimmed(name.substr(open + 1, close - open - 1));
        entry.index = parse_number(inside);
        if (!parse_signed(inside) || close == std::string_view::npos) // the text of a signed value
            remarks.push_back(
                {line.number, Weight::error, in_quotes(name) + " has no number between ( and ): write one."});
        name = trimmed(name.substr(0, open));
    }
    entry.keyword = std::string{name};
    return entry;
}

class Parser {
public:
    Document parse(std::string_view content)
    {
        if (std::string why = unreadable(content); !why.empty()) {
            not_read(1, std::move(why));
            return std::move(document_);
        }
        const std::vector<LogicalLine> lines = logical_lines(content, document_.remarks);
        auto line = lines.begin();
        for (; line != lines.end() && !same_any_case(line->text, kSection); ++line) before_section(*line);
        if (line == lines.end()) {
            no_section(lines);
            return std::move(document_);
        }
        document_.has_section = true;
        if (line->text != kSection)
            remark(line->number, Weight::pedantic, "the standard spells this line #Profibus_DP.");
        for (++line; line != lines.end() && line->text.front() != '#'; ++line) take(*line);
        if (open_) unclosed("the end of the section");
        for (const Block& block : document_.blocks)
            if (block.kind == "Module") module(block);
        return std::move(document_);
    }

private:
    void remark(unsigned line, Weight weight, std::string what)
    {
        document_.remarks.push_back({line, weight, std::move(what)});
    }

    void not_read(unsigned line, std::string what)
    {
        document_.not_read = {line, Weight::error, what};
        remark(line, Weight::error, std::move(what));
    }

    void no_section(const std::vector<LogicalLine>& lines)
    {
        const auto like_it = std::find_if(lines.begin(), lines.end(), [](const LogicalLine& one) {
            return edit_distance(to_lower(one.text), to_lower(kSection), kSlips) <= kSlips;
        });
        if (like_it == lines.end()) return not_read(0, "there is no line #Profibus_DP: this is no GSD file.");
        not_read(like_it->number,
                 in_quotes(like_it->text) + ": the line that begins a GSD file is #Profibus_DP.");
    }

    void before_section(const LogicalLine& line)
    {
        Remarks ignored;
        const Entry entry = entry_of(line, ignored);
        if (find_keyword(entry.keyword) != nullptr)
            remark(line.number, Weight::error,
                   in_quotes(entry.keyword) +
                       " comes before #Profibus_DP, where tools do not read it: move it below.");
    }

    void take(const LogicalLine& line)
    {
        Entry entry = entry_of(line, document_.remarks);
        const std::string_view word = entry.keyword.empty() ? std::string_view{entry.value} : entry.keyword;
        if (const BlockKind* kind = find_closing(word)) return close(*kind, line.number);
        if (const BlockKind* kind = find_opening(word)) {
            if (open_) unclosed("line " + std::to_string(line.number));
            open_ = Block{std::string{kind->opens},
                          entry.keyword.empty() ? std::string{} : std::move(entry.value),
                          line.number,
                          {}};
            return;
        }
        if (open_ && open_->kind == "Module" && belongs_to_unit(entry))
            unclosed(in_quotes(entry.keyword) + " in line " + std::to_string(line.number));
        if (open_)
            open_->body.push_back(std::move(entry));
        else if (!entry.keyword.empty())
            document_.keywords.push_back(std::move(entry));
        else
            document_.remarks.push_back(
                {line.number, Weight::warning, // common in the field
                 in_quotes(entry.value) +
                     " is neither Keyword = value nor part of a module: " + mend(entry.value),
                 true});
    }

    static std::string mend(const std::string& text)
    {
        const std::string_view nearest = nearest_keyword(text);
        return nearest.empty() ? "remove it, or add what is missing."
                               : "the standard spells it " + in_quotes(nearest) + '.';
    }

    static bool belongs_to_unit(const Entry& entry)
    {
        const Keyword* keyword = find_keyword(entry.keyword);
        return keyword != nullptr && (keyword->places & kModule) == 0;
    }

    void close(const BlockKind& kind, unsigned line)
    {
        if (!open_)
            return remark(line, Weight::error,
                          std::string{kind.closes} + " without a " + std::string{kind.opens} +
                              " before it: remove it, or look for the line that is missing.");
        if (open_->kind != kind.opens)
            return remark(line, Weight::error,
                          std::string{kind.closes} + " inside the " + open_->kind + " of line " +
                              std::to_string(open_->line) + ": remove it.");
        document_.blocks.push_back(std::move(*open_));
        open_.reset();
    }

    void unclosed(const std::string& before)
    {
        const std::string closes{find_opening(open_->kind)->closes};
        remark(open_->line, Weight::error,
               open_->kind + (open_->head.empty() ? "" : ' ' + open_->head) + " has no " + closes +
                   ": write " + closes + " before " + before + '.');
        document_.blocks.push_back(std::move(*open_));
        open_.reset();
    }

    void module(const Block& block)
    {
        Module module;
        module.line = block.line;
        std::string_view octets = block.head;
        if (const auto name = parse_quoted(block.head)) {
            module.name = name->text;
            octets = name->rest;
        } else {
            remark(block.line, Weight::error,
                   "the module has no name in quotes: write Module = \"name\" 0x50 and the like.");
            if (const auto blank = octets.find_first_of(" \t"); blank != std::string_view::npos)
                octets = trimmed(octets.substr(blank));
        }
        if (const auto identifiers = parse_octets(octets))
            module.identifiers = *identifiers;
        else
            remark(block.line, Weight::error,
                   "the module's identifiers " + in_quotes(octets) +
                       " are no octets: write them as 0x50 or 80, with commas between.");
        DataArea area;
        for (const Entry& entry : block.body) {
            if (area.has(entry.keyword, entry.value)) continue;
            if (same_any_case(entry.keyword, "Preset")) module.preset = parse_number(entry.value) == 1U;
            if (!entry.keyword.empty()) continue;
            if (!module.reference && parse_number(entry.value))
                module.reference = parse_number(entry.value);
            else
                remark(entry.line, Weight::error,
                       in_quotes(entry.value) +
                           " is neither the module's reference number nor Keyword = value: " +
                           mend(entry.value));
        }
        if (area.is_open())
            remark(block.line, Weight::warning,
                   "the module has Data_Area_Beg without Data_Area_End: add it.");
        document_.modules.push_back(std::move(module));
    }

    Document document_;
    std::optional<Block> open_;
};

} // namespace

const Entry* Document::find(std::string_view keyword) const
{
    const auto found = std::find_if(keywords.rbegin(), keywords.rend(), [&](const Entry& entry) {
        return same_any_case(entry.keyword, keyword);
    });
    return found == keywords.rend() ? nullptr : &*found;
}

std::optional<std::uint32_t> Document::number(std::string_view keyword) const
{
    const Entry* entry = find(keyword);
    if (entry == nullptr) return std::nullopt;
    return parse_number(entry->value);
}

std::string Document::text(std::string_view keyword) const
{
    const Entry* entry = find(keyword);
    if (entry == nullptr) return {};
    const auto found = parse_quoted(entry->value);
    return found ? found->text : std::string{};
}

std::vector<std::uint8_t> Document::octets(std::string_view keyword) const
{
    const Entry* entry = find(keyword);
    if (entry == nullptr) return {};
    return parse_octets(entry->value).value_or(std::vector<std::uint8_t>{});
}

Document parse(std::string_view content)
{
    return Parser{}.parse(content);
}

} // namespace dpslave::gsd
