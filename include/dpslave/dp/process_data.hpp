// SPDX-License-Identifier: Apache-2.0
/// The cyclic exchange of one slave: outputs as received and in force, inputs live and frozen, Demand Data,
/// Sync, Freeze and Clear. Source: wire reference 4.7 to 4.10.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/queue.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/demand_data.hpp"
#include "dpslave/dp/personality.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace dpslave::dp {

struct Snapshot;

/// What Global_Control says of Sync or of Freeze.
enum class Switch : std::uint8_t { keep, on, off };

/// Demand Data is part of both strings: under Sync its orders come from the outputs in force, under Freeze
/// its reply stands still, as all inputs do. Knows no state and no master; for one thread; allocates nothing.
class ProcessData {
public:
    /// `personality` outlives it.
    explicit ProcessData(const Personality& personality) : personality_(personality), demand_(personality) {}

    /// A layout of its own generation begins at `at`: outputs 0, Stat_Diag if there is something to wait for.
    void begin(const Configuration& configuration, Instant at);
    /// The layout ended: the outputs go to their safe state, reported to the drive side.
    void end();
    /// Of the present layout; generation 0: there is none.
    const Configuration& configuration() const { return config_; }

    // From the master.

    /// The outputs of a Data_Exchange. Precondition: data has the configured length.
    void receive(Bytes data);
    /// A Data_Exchange without data: every output becomes 0 at once, also under Sync.
    void receive_nothing();
    /// Clear_Data or not, as the newest Global_Control says. True: it is the first one after one without.
    bool set_clear(bool clear);
    /// True: Sync or Freeze has become another. On again while on: what came meanwhile is taken.
    bool set_sync(Switch to);
    bool set_freeze(Switch to);
    bool sync() const { return sync_; }
    bool freeze() const { return freeze_; }

    // To the master.

    void append_inputs(ByteBuffer<244>& reply) const;
    /// Those in force: after Sync and Clear.
    void append_outputs(ByteBuffer<244>& reply) const;
    /// Stat_Diag: not every input (and scale) was tried yet, or one has no scale.
    bool stat_diag() const { return stat_diag_; }
    void end_stat_diag();
    /// Stat_Diag has had its time at this moment, even if not every input was tried; kNever = it is over.
    Instant ready_by() const { return ready_by_; }
    /// Precondition: ready_by() has come. True: Stat_Diag may end.
    bool give_up_waiting();

    // The drive side.

    /// Counts only under the present layout's generation. True: Stat_Diag may end.
    bool set_inputs(const InputImage& inputs);
    void set_demand_answer(const DemandAnswer& answer) { demand_.answer(answer); }
    /// Given only when they changed since the last call.
    std::optional<OutputImage> take_outputs();
    std::optional<DemandOrder> take_demand_order() { return demand_.take_order(); }
    /// Each end() once, in order.
    std::optional<LeftDataExchange> take_left() { return left_.pop(); }

    /// Fills its part of the snapshot.
    void fill(Snapshot& seen) const;

private:
    /// One direction of the cyclic exchange, by the parameters of the layout.
    struct Image {
        std::array<std::uint16_t, kMaxParameters> words{};
        DemandRegisters demand{};
    };

    void clear_outputs();
    void activate_received();
    void allow_writing();
    /// Every parameter was tried or had its time, but one has no scale.
    bool holds() const { return stat_diag_ && inputs_.scale_missing; }
    /// Not every scale is known yet, or one of them never will be.
    bool finds_scales() const { return stat_diag_ && personality_.tries_outputs; }

    const Personality& personality_;
    Generation generations_ = 0; ///< layouts so far
    Configuration config_{};
    Image received_{};         ///< D: the outputs as received last
    Image active_{};           ///< N: the outputs that are in force
    bool has_outputs_ = false; ///< received at least once in this layout
    bool may_write_ = false;
    bool outputs_changed_ = false;
    InputImage inputs_{}; ///< of the present layout
    Image frozen_{};
    bool sync_ = false;
    bool freeze_ = false;
    bool clear_ = false; ///< by the newest Global_Control
    bool stat_diag_ = false;
    Instant ready_by_ = kNever;
    DemandData demand_;
    Queue<LeftDataExchange, 8> left_;
    std::uint64_t exchanges_ = 0;
    std::uint64_t ended_ = 0;
    std::uint64_t left_lost_ = 0;
};

} // namespace dpslave::dp
