// SPDX-License-Identifier: Apache-2.0
#include "top_state.hpp"

#include "dpctl/cli/tables.hpp"

#include "dpslave/base/letters.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kWordsOfAPage = 8;

/// A station by its name and address, a tag by its name and number. The empty filter lets everything through.
bool lets_through(std::string_view filter, std::string_view name, std::int64_t number)
{
    return contains_any_case(name, filter) || std::to_string(number) == filter;
}

const report::StationIo* words_of(const report::GetIoReply& io, std::string_view station)
{
    for (const report::StationIo& one : io.stations)
        if (one.name == station) return &one;
    return nullptr;
}

bool is_same_place(const report::Word& a, const report::Word& b)
{
    return a.direction == b.direction && a.octet == b.octet && a.tag == b.tag;
}

} // namespace

void TopState::add(Sighting sighting, const report::GetEventsReply& events)
{
    before_ = std::move(now_);
    has_before_ = has_now_;
    now_ = std::move(sighting);
    has_now_ = true;
    turnaround_.add(now_.at, now_.counters);
    for (const report::Event& one : events.events) {
        const std::string count = one.count > 1 ? " (" + std::to_string(one.count) + " times)" : "";
        PastEvent event{one.number, now_.unix_seconds - one.age_ms / 1000, one.text + count};
        const auto known = std::find_if(events_.begin(), events_.end(),
                                        [&](const PastEvent& e) { return e.number == event.number; });
        if (known == events_.end())
            events_.push_back(std::move(event));
        else if (known->text != event.text) // its age is not so exact that the same time would come out again
            *known = std::move(event);
    }
    while (events_.size() > kMostEvents) events_.pop_front();
}

std::vector<const report::Station*> TopState::stations() const
{
    std::vector<const report::Station*> all;
    for (const report::Station& one : now_.status.stations) {
        if (words_of(now_.io, one.name) == nullptr) continue; // another one was named
        if (lets_through(filter_, one.name, one.address) || !words(one.name).empty()) all.push_back(&one);
    }
    return all;
}

std::size_t TopState::selected() const
{
    const auto all = stations();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto* one) { return one->name == selected_; });
    return found == all.end() ? 0 : static_cast<std::size_t>(found - all.begin());
}

std::vector<const report::Word*> TopState::words(std::string_view station) const
{
    std::vector<const report::Word*> all;
    const report::StationIo* const io = words_of(now_.io, station);
    if (io == nullptr) return all;
    const bool whole = lets_through(filter_, station, io->address);
    for (const report::Word& one : io->words)
        if (whole || lets_through(filter_, one.name.value_or(""), one.tag)) all.push_back(&one);
    return all;
}

std::size_t TopState::first_word() const
{
    const auto all = stations();
    const std::size_t count = all.empty() ? 0 : words(all[selected()]->name).size();
    return std::min(first_word_, count > 0 ? count - 1 : 0);
}

bool TopState::has_changed(const report::Station& station) const
{
    if (!has_before_) return false;
    for (const report::Station& old : before_.status.stations)
        if (old.name == station.name)
            return state_text(old) != state_text(station) || old.master != station.master ||
                   link_text(old.drive) != link_text(station.drive);
    return true;
}

bool TopState::has_changed(std::string_view station, const report::Word& word) const
{
    const report::StationIo* const old = has_before_ ? words_of(before_.io, station) : nullptr;
    if (old == nullptr) return has_before_;
    for (const report::Word& one : old->words)
        if (is_same_place(one, word))
            return one.value != word.value || one.raw != word.raw || one.state != word.state;
    return true;
}

/// Stays at the ends.
void TopState::select(std::ptrdiff_t further)
{
    const auto all = stations();
    if (all.empty()) return;
    const auto last = static_cast<std::ptrdiff_t>(all.size()) - 1;
    const auto wanted =
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(selected()) + further, 0, last);
    const std::string& name = all[static_cast<std::size_t>(wanted)]->name;
    if (name != selected_) first_word_ = 0;
    selected_ = name;
}

void TopState::on_filter_key(const Key& key)
{
    using Kind = Key::Kind;
    if (key.kind == Kind::enter) types_filter_ = false;
    if (key.kind == Kind::escape) types_filter_ = false;
    if (key.kind == Kind::escape || key.kind == Kind::clear) filter_.clear();
    if (key.kind == Kind::backspace) {
        while (!filter_.empty() && (static_cast<unsigned char>(filter_.back()) & 0xC0U) == 0x80U)
            filter_.pop_back(); // the further octets of one character
        if (!filter_.empty()) filter_.pop_back();
    }
    if (key.kind == Kind::character && filter_.size() + key.text.size() <= kLongestFilter)
        filter_ += key.text;
    first_word_ = 0;
}

bool TopState::on_key(const Key& key)
{
    using Kind = Key::Kind;
    switch (key.kind) {
        case Kind::up: select(-1); return true;
        case Kind::down: select(1); return true;
        case Kind::page_down: first_word_ = first_word() + kWordsOfAPage; return true;
        case Kind::page_up: first_word_ = first_word() - std::min(first_word(), kWordsOfAPage); return true;
        default: break;
    }
    if (types_filter_) {
        on_filter_key(key);
        return true;
    }
    if (key.kind == Kind::escape) filter_.clear();
    if (key.kind != Kind::character) return true;
    if (key.text == "/") types_filter_ = true;
    return key.text != "q" && key.text != "Q";
}

} // namespace dpslave::dpctl
