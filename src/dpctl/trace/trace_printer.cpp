// SPDX-License-Identifier: Apache-2.0
#include "trace_printer.hpp"

#include "dpslave/base/printable.hpp"

#include <utility>

namespace dpslave::dpctl {

void Printer::flush()
{
    if (file_ != nullptr) file_->flush();
    terminal_.out << std::flush;
}

void Printer::expect_bus()
{
    if (file_ != nullptr) file_->add_bus();
}

TraceFilter Printer::filter_of(std::string_view note) const
{
    TraceFilter filter = filter_;
    filter.bad = filter.bad && note != kCause;
    return filter;
}

void Printer::print_json(Json json, std::string_view note)
{
    if (!note.empty()) json["note"] = printable(note);
    session_.print_line(json);
}

void Printer::print(const LineEntry& entry, UnixOffset offset, std::string_view note)
{
    const std::string words = words_of(entry);
    const auto before = std::exchange(before_, entry.last);
    if (!passes(filter_of(note), entry, words)) return;
    if (file_ != nullptr) return file_->add(entry, offset, note);
    if (session_.json()) return print_json(json_of(entry, words, offset), note);
    terminal_.out << line_of(entry, words, offset, before);
    if (!note.empty()) terminal_.out << "  (" << printable(note) << ')';
    terminal_.out << '\n';
}

void Printer::print(const trace::Entry& entry, UnixOffset offset, std::string_view note)
{
    const TraceWords words = words_of(entry);
    const auto before = std::exchange(before_, entry.last);
    auto decoded = decoder_ != nullptr ? decoder_->decode(entry) : std::nullopt; // it learns from each
    has_stopped_ = stop_ && note != kBefore && stop_->holds(entry, words);
    if (!has_stopped_ && !passes(filter_of(note), entry, words)) return;
    if (file_ != nullptr) return file_->add(entry, words, offset, note);
    if (session_.json()) {
        Json json = json_of(entry, words, offset);
        if (!has_rate_) json["at_ns"] = json["last_ns"] = json["uncertainty_ns"] = json["baud"] = nullptr;
        if (decoder_ != nullptr) json["decoded"] = decoded ? decoded_json(*decoded) : Json(nullptr);
        return print_json(std::move(json), note);
    }
    terminal_.out << line_of(entry, words, offset, before);
    if (!note.empty()) terminal_.out << "  (" << printable(note) << ')';
    terminal_.out << '\n';
    if (const auto exact = decoder_ != nullptr ? how_exact(entry) : std::nullopt) {
        if (!decoded) decoded.emplace();
        decoded->lines.insert(decoded->lines.begin(), {"time", *exact});
    }
    if (decoded) terminal_.out << render_details(*decoded, kIndent, terminal_.look());
}

} // namespace dpslave::dpctl
