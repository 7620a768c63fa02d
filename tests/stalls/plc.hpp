// SPDX-License-Identifier: Apache-2.0
/// The PLC of one station: it starts the station up and exchanges with it, by telegrams written here (wire
/// reference 4 and 5, HA389815 ch. 6 and 7).
#pragma once

#include "app/bus/bus_station.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dpslave::stalls {

class Plc {
public:
    static constexpr std::uint8_t kAddress = 2;

    /// `parameters`: the layout that it chooses. The station outlives it.
    Plc(app::BusStation& station, std::vector<LayoutEntry> parameters)
        : station_(station), parameters_(std::move(parameters)), wanted_(parameters_.size())
    {}

    /// What it does when the bus comes round to this station.
    void turn(Instant now);

    const std::vector<LayoutEntry>& parameters() const { return parameters_; }
    /// What it sends from the next exchange on.
    void want(std::size_t place, std::uint16_t word) { wanted_[place] = word; }
    void demand(bool is_write, std::uint16_t tag, std::uint16_t word);

    bool exchanges() const { return phase_ == Phase::exchange; }
    /// The last turn had an exchange.
    bool has_exchanged() const { return has_exchanged_; }
    /// It has taken the inputs of the last turn: the reply did not ask for diagnosis.
    bool is_served() const { return is_served_; }
    std::uint16_t input(std::size_t place) const { return inputs_[place]; }
    /// The words that it has sent in this exchange; nothing: none yet.
    const std::optional<std::vector<std::uint16_t>>& sent() const { return sent_; }
    /// Its Chk_Cfg was accepted then.
    Instant started_at() const { return started_at_; }
    /// It has read Stat_Diag in a running exchange, and has not exchanged since.
    bool is_held() const { return is_held_; }

private:
    enum class Phase : std::uint8_t { prm, cfg, diag, exchange };

    bool telegram(Instant now);
    std::optional<std::vector<std::uint8_t>> ask(std::optional<std::uint8_t> dsap,
                                                 const std::vector<std::uint8_t>& data, Instant now);
    void restart();
    bool set_prm(Instant now);
    bool chk_cfg(Instant now);
    bool slave_diag(Instant now);
    void exchange(Instant now);

    app::BusStation& station_;
    std::vector<LayoutEntry> parameters_;
    std::vector<std::uint16_t> wanted_;
    std::array<std::uint8_t, 8> demand_{};
    Phase phase_ = Phase::prm;
    bool has_exchanged_ = false, is_served_ = false, is_held_ = false, asks_for_diagnosis_ = false;
    std::array<std::uint16_t, kMaxParameters> inputs_{};
    std::optional<std::vector<std::uint16_t>> sent_;
    Instant started_at_{};
};

} // namespace dpslave::stalls
