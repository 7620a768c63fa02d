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

/// The request of Global_Control for Sync or for Freeze.
enum class Switch : std::uint8_t { keep, on, off };

/// Demand Data is part of both strings: under Sync its orders come from the outputs in force, under Freeze
/// its reply does not change, as all inputs do not. Knows no state and no master; for one thread; allocates
/// nothing.
class ProcessData {
public:
    /// `personality` outlives it.
    explicit ProcessData(const Personality& personality) : personality_(personality), demand_(personality) {}

    /// A layout of its own generation begins at `at`: outputs 0, Stat_Diag if there is something to wait for.
    void begin(const Configuration& configuration, Instant at);
    /// The layout ended: the outputs go to their safe state, reported to the drive side.
    void end();
    /// The configuration of the present layout; generation 0: there is none.
    const Configuration& configuration() const { return config_; }

    // From the master.

    /// The outputs of a Data_Exchange. Precondition: data has the configured length.
    void receive(Bytes data, Instant when);
    /// A Data_Exchange without data: every output becomes 0 at once, also under Sync.
    void receive_nothing(Instant at);
    /// Clear_Data or not, as the newest Global_Control says. Returns true if it is the first one after one
    /// without.
    bool set_clear(bool clear);
    /// Returns true if the state of Sync or Freeze has changed. A repeated "on" takes the values that came
    /// meanwhile.
    bool set_sync(Switch to);
    bool set_freeze(Switch to);
    bool sync() const { return sync_; }
    bool freeze() const { return freeze_; }

    // To the master.

    void append_inputs(ByteBuffer<244>& reply) const;
    /// Those in force: after Sync and Clear.
    void append_outputs(ByteBuffer<244>& reply) const;
    /// Stat_Diag: not every parameter was tried yet, or one of them holds the start.
    bool stat_diag() const { return stat_diag_; }
    /// It ends; or it begins again until every input has been read anew: the outputs stay as they are, and a
    /// frozen image is released. Returns true if there was one.
    bool set_stat_diag(bool on);
    /// Stat_Diag has had its time at this moment, even if not every input was tried; kNever = it is over. A
    /// drive that answers is waited for all the same (C2).
    Instant ready_by() const { return ready_by_; }
    /// Gives up waiting for the drive; true means that Stat_Diag may end. Precondition: ready_by() has come.
    bool give_up_waiting();
    /// Returns when outputs that wait for the end of Stat_Diag are too old to be written then; kNever: none
    /// wait.
    Instant outputs_old_at() const { return may_be_held() ? outputs_old_at_ : kNever; }
    /// Drops the waiting outputs, so that nothing is written before the next Data_Exchange. Precondition:
    /// outputs_old_at() has come.
    void forget_waiting_outputs() { outputs_old_at_ = kNever; }

    // The drive side.

    /// The meaning of an image of inputs for Stat_Diag.
    enum class Readiness : std::uint8_t {
        as_before,
        ready,      ///< it may end
        drive_gone, ///< it has to begin (row A4)
    };
    /// Counts only under the present layout's generation.
    Readiness set_inputs(const InputImage& inputs);
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
    /// An exchange that has begun is held no more, also when it waits for its drive (row A4).
    StartHold hold() const { return stat_diag_ && starts_ ? inputs_.hold : StartHold::none; }
    /// Not everything that could hold the start was tried yet, or something holds it.
    bool may_be_held() const { return stat_diag_ && personality_.tries_outputs; }

    const Personality& personality_;
    Generation generations_ = 0; ///< layouts so far
    Configuration config_{};
    Image received_{};         ///< D: the outputs as received last
    Image active_{};           ///< N: the outputs that are in force
    bool has_outputs_ = false; ///< received at least once in this layout
    bool may_write_ = false;
    bool in_force_ = false; ///< N was received in this layout, not only D
    Instant outputs_old_at_ = kNever;
    bool outputs_changed_ = false;
    InputImage inputs_{};        ///< of the present layout
    bool drive_answers_ = false; ///< by the newest image, of whatever layout
    Image frozen_{};
    bool sync_ = false;
    bool freeze_ = false;
    bool clear_ = false; ///< by the newest Global_Control
    bool stat_diag_ = false;
    bool starts_ = false; ///< Stat_Diag is that of the start
    Instant ready_by_ = kNever;
    DemandData demand_;
    Queue<LeftDataExchange, 8> left_;
    std::uint64_t exchanges_ = 0;
    std::uint64_t ended_ = 0;
    std::uint64_t left_lost_ = 0;
};

} // namespace dpslave::dp
