// SPDX-License-Identifier: Apache-2.0
/// The lamps of all stations: the LED language gives the pattern, the sinks switch the lamps. Main thread
/// only. It never waits for a lamp: each chip has a thread beside it, which opens, switches and closes its
/// lamps. A chip that hangs or fails costs only its own lamps.
#pragma once

#include "app/job/side_job.hpp"
#include "presence_words.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/io/led_sink.hpp"
#include "dpslave/led/pattern.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::app {

class Lamps {
public:
    /// As io::open_led_sink(). Called on the threads of the chips.
    using Open = std::function<decltype(io::open_led_sink)>;
    using Clock = Instant (*)();
    explicit Lamps(Open open = io::open_led_sink, Clock clock = io::monotonic_now)
        : open_(std::move(open)), clock_(clock)
    {}
    /// As end(); what hangs is left to the end of the process.
    ~Lamps();
    Lamps(const Lamps&) = delete;
    Lamps& operator=(const Lamps&) = delete;

    /// From now on those that the configuration names. A lamp that was there before, under whatever name,
    /// goes on without an interruption. The others are opened, or darkened and closed, with the next show().
    void exchange(const config::Config& config);

    /// What is the case at this station from now on.
    void set(std::size_t station, const led::Condition& condition);
    /// Has every lamp switched as its pattern says at `now`. A lamp that failed or was slow is left alone for
    /// 1 s, then 2, 4 and so on up to kLongestPause, and tried again.
    void show(Instant now);
    /// When show() is needed next.
    Instant next_change(Instant now) const;

    const led::Condition& condition(std::size_t station) const { return conditions_[station]; }
    /// Why this lamp does not show its pattern, a sentence; nothing: it does, it has not been opened yet, or
    /// none is configured.
    std::optional<std::string> trouble(std::size_t station, const std::string& lamp, Instant now) const;
    /// Lamps that have got a trouble or lost it since the last call: the number of the station, and a
    /// sentence.
    std::vector<std::pair<std::size_t, Sentence>> take_news(Instant now);

    /// Darkens and closes every lamp; waits for that at most until `limit` is over. The result: the chips
    /// that do not answer. Their lamps are left as they are.
    std::vector<std::string> end(std::chrono::milliseconds limit);

    static constexpr std::chrono::seconds kLongestPause{30};
    static constexpr std::chrono::milliseconds kSlow{500}; ///< a switching that takes longer
    static constexpr std::chrono::seconds kStalled{2};     ///< a chip that is silent for longer
    static constexpr std::chrono::milliseconds kEnd{500};  ///< for what a stop waits

private:
    struct Lamp {
        std::string sink;
        std::filesystem::path sysfs;
        std::string chip; ///< the key of its chip
        /// Of the chip's thread while that has an order. None: it is to be opened.
        std::unique_ptr<io::LedSink> led;
        // Of the main thread:
        std::size_t station = 0;
        std::string name;
        led::Pattern pattern;
        std::optional<bool> shown; ///< as ordered last; nothing: not known
        Instant next_try{};
        std::chrono::seconds pause{0}; ///< the last one
        std::optional<std::string> trouble;
        bool is_told = false; ///< the trouble
    };
    using Members = std::vector<std::shared_ptr<Lamp>>;
    struct Chip {
        Members lamps, gone;                 ///< `gone`: to be closed
        std::optional<Instant> busy_since{}; ///< with an order, as show() has seen last
        SideJob job{"lamps", "the lamps"};
    };
    struct Order {
        std::shared_ptr<Lamp> lamp;
        bool lit = false;
    };
    struct Outcome {
        std::shared_ptr<Lamp> lamp;
        Instant began{}, ended{};
        std::string why{}; ///< it could not be switched; empty: it was
    };

    static bool is_due(const Lamp& lamp, Instant now);
    static void carry_out(const Open& open, const Order& order, Outcome& outcome);
    static void note(const Outcome& outcome);
    std::optional<std::string> trouble_of(const Lamp& lamp, Instant now) const;
    bool start(Chip& chip, const std::vector<Order>& orders, Instant now);

    Open open_;
    Clock clock_;
    std::vector<std::string> names_; ///< of the stations
    std::vector<led::Language> languages_;
    std::vector<led::Condition> conditions_;
    Members lamps_;
    std::map<std::string, Chip> chips_; ///< each one that was ever named, with its thread
};

} // namespace dpslave::app
