// SPDX-License-Identifier: Apache-2.0
#include "lamps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

namespace {

/// The lamps of one thread: those of one chip, or of one kind where the text names no chip.
std::string key_of(const std::filesystem::path& sysfs, const std::string& sink)
{
    return sysfs.string() + ' ' + sink.substr(0, sink.rfind(':'));
}

} // namespace

Lamps::~Lamps()
{
    end(kEnd);
    for (auto& [key, chip] : chips_) chip.job.leave();
}

void Lamps::exchange(const config::Config& config)
{
    Members before = std::exchange(lamps_, {});
    for (auto& [key, chip] : chips_) {
        before.insert(before.end(), chip.gone.begin(), chip.gone.end()); // not closed yet
        chip.gone.clear();
        chip.lamps.clear();
    }
    names_.clear();
    languages_.clear();
    conditions_.assign(config.stations.size(), {});
    for (std::size_t i = 0; i < config.stations.size(); ++i) {
        const config::StationConfig& station = config.stations[i];
        names_.push_back(station.name);
        languages_.push_back(station.profile->leds);
        for (const config::LedConfig& led : station.leds) {
            const auto known = std::find_if(before.begin(), before.end(), [&](const auto& lamp) {
                return lamp->sink == led.sink && lamp->sysfs == config.sysfs;
            });
            std::shared_ptr<Lamp>& lamp = lamps_.emplace_back();
            if (known != before.end()) {
                lamp = *known;
                before.erase(known);
            } else {
                lamp = std::make_shared<Lamp>();
                lamp->sink = led.sink;
                lamp->sysfs = config.sysfs;
                lamp->chip = key_of(config.sysfs, led.sink);
            }
            lamp->station = i;
            lamp->name = led.lamp;
            lamp->pattern = {};
            chips_[lamp->chip].lamps.push_back(lamp);
        }
    }
    for (const auto& lamp : before) chips_[lamp->chip].gone.push_back(lamp);
    for (std::size_t i = 0; i < languages_.size(); ++i) set(i, {});
}

void Lamps::set(std::size_t station, const led::Condition& condition)
{
    conditions_[station] = condition;
    for (const led::Lamp& shown : led::lamps(languages_[station], condition))
        for (const auto& lamp : lamps_)
            if (lamp->station == station && lamp->name == shown.name) lamp->pattern = shown.pattern;
}

bool Lamps::is_due(const Lamp& lamp, Instant now)
{
    return now >= lamp.next_try && lamp.shown != led::lit(lamp.pattern, now);
}

void Lamps::show(Instant now)
{
    for (auto& [key, chip] : chips_) {
        if (!chip.job.is_idle()) continue;
        chip.busy_since.reset();
        std::vector<Order> orders;
        for (const auto& lamp : chip.lamps)
            if (is_due(*lamp, now)) orders.push_back({lamp, led::lit(lamp->pattern, now)});
        if (!orders.empty() || !chip.gone.empty()) start(chip, orders, now);
    }
}

/// False: it still has other orders, or there is no thread for it.
bool Lamps::start(Chip& chip, const std::vector<Order>& orders, Instant now)
{
    // Lamps that go are darkened first: their lines may be wanted under other names. The work keeps all
    // lamps of the chip, so that none is closed by the main thread while the chip hangs.
    const bool is_started = chip.job.start(
        [open = open_, clock = clock_, gone = chip.gone, kept = chip.lamps, orders]() -> SideJob::Then {
            for (const auto& lamp : gone) lamp->led.reset();
            std::vector<Outcome> outcomes;
            for (const Order& order : orders) {
                Outcome& outcome = outcomes.emplace_back(Outcome{.lamp = order.lamp, .began = clock()});
                carry_out(open, order, outcome);
                outcome.ended = clock();
            }
            return [outcomes] {
                for (const Outcome& one : outcomes) note(one);
            };
        });
    if (!is_started) return false;
    for (const Order& order : orders) order.lamp->shown = order.lit;
    chip.gone.clear();
    chip.busy_since = now;
    return true;
}

/// On the thread of the chip. A lamp that fails is closed: to open it again says best what is wrong.
void Lamps::carry_out(const Open& open, const Order& order, Outcome& outcome)
{
    Lamp& lamp = *order.lamp;
    if (!lamp.led) {
        auto opened = open(lamp.sink, lamp.sysfs);
        if (!opened) {
            outcome.why = opened.error();
            return;
        }
        lamp.led = std::move(*opened);
        if (!order.lit) return; // it is dark
    }
    if (lamp.led->set(order.lit)) return;
    lamp.led.reset();
    outcome.why = fmt::format("LED {}: it cannot be switched any more", lamp.sink);
}

void Lamps::note(const Outcome& outcome)
{
    Lamp& lamp = *outcome.lamp;
    const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(outcome.ended - outcome.began);
    lamp.trouble.reset();
    if (outcome.why.empty() && took <= kSlow) return;
    lamp.trouble = !outcome.why.empty()
                       ? outcome.why
                       : fmt::format("LED {}: its chip took {} ms to switch it", lamp.sink, took.count());
    lamp.shown.reset(); // it is switched again, whatever it is to show
    constexpr std::chrono::seconds kFirstPause{1};
    const bool is_first = lamp.pause.count() == 0 || outcome.began - lamp.next_try > kLongestPause;
    lamp.pause = is_first ? kFirstPause : std::min(2 * lamp.pause, kLongestPause);
    lamp.next_try = outcome.ended + lamp.pause;
}

Instant Lamps::next_change(Instant now) const
{
    constexpr std::chrono::milliseconds kSoon{5};
    Instant next = kNever;
    for (const auto& lamp : lamps_) {
        next = std::min(next, led::next_change(lamp->pattern, now));
        // An order is on its way and the next one is due: a chip that works is ready at once.
        const auto busy_since = chips_.at(lamp->chip).busy_since;
        if (busy_since && now - *busy_since < kSlow && is_due(*lamp, now)) next = std::min(next, now + kSoon);
    }
    return next;
}

std::optional<std::string> Lamps::trouble_of(const Lamp& lamp, Instant now) const
{
    const auto busy_since = chips_.at(lamp.chip).busy_since;
    if (!busy_since || now - *busy_since < kStalled) return lamp.trouble;
    return fmt::format("LED {}: its chip has not answered for {} s: check its bus and its supply", lamp.sink,
                       std::chrono::duration_cast<std::chrono::seconds>(now - *busy_since).count());
}

std::optional<std::string> Lamps::trouble(std::size_t station, const std::string& lamp, Instant now) const
{
    for (const auto& one : lamps_)
        if (one->station == station && one->name == lamp) return trouble_of(*one, now);
    return std::nullopt;
}

std::vector<std::pair<std::size_t, Sentence>> Lamps::take_news(Instant now)
{
    std::vector<std::pair<std::size_t, Sentence>> news;
    for (const auto& lamp : lamps_) {
        const auto trouble = trouble_of(*lamp, now);
        if (trouble.has_value() == lamp->is_told) continue;
        lamp->is_told = trouble.has_value();
        const std::string name = names_[lamp->station] + ": the lamp " + lamp->name;
        if (trouble)
            news.emplace_back(
                lamp->station,
                Sentence{.is_warning = true, .text = name + " does not show its pattern: " + *trouble});
        else
            news.emplace_back(lamp->station,
                              Sentence{.is_warning = false, .text = name + " shows its pattern now"});
    }
    return news;
}

std::vector<std::string> Lamps::end(std::chrono::milliseconds limit)
{
    const auto until = std::chrono::steady_clock::now() + limit;
    const auto left = [until] {
        return std::chrono::floor<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    };
    lamps_.clear();
    for (auto& [key, chip] : chips_)
        for (auto& lamp : std::exchange(chip.lamps, {})) chip.gone.push_back(std::move(lamp));
    show(clock_()); // all chips at the same time
    std::vector<std::string> hanging;
    for (auto& [key, chip] : chips_) {
        bool is_closed = chip.job.wait(left());
        if (is_closed && !chip.gone.empty()) is_closed = start(chip, {}, clock_()) && chip.job.wait(left());
        if (!is_closed) hanging.push_back(key.substr(key.find(' ') + 1));
        chip.gone.clear();
    }
    return hanging;
}

} // namespace dpslave::app
