// SPDX-License-Identifier: Apache-2.0
/// Decides which transaction of a drive line comes next, for all the drives on it. Pure: layouts, outputs,
/// orders, results and the time come in; transactions, inputs and answers go out as values.
#pragma once

#include "dpslave/base/histogram.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/tag.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace dpslave::drive {

/// Tags that a unit may have read beside those that the master chose.
inline constexpr std::size_t kMaxWatched = 8;

/// When the outputs go to 0 after the loss of the master: each is written 0 after this time until it is
/// proven to be there, and writing stops; none = writing stops and nothing is zeroed (X-46; RIDE THROUGH of
/// HA463561U002).
using ZeroAfter = std::optional<std::chrono::nanoseconds>;

/// The beginning of an answer of a drive, for display; ends with NUL.
using AnswerText = std::array<char, 12>;
AnswerText answer_text(std::string_view text);

/// What a chosen tag that the drive denies does to the start.
enum class DeniedHold : std::uint8_t {
    never,
    where_all, ///< it is held where every chosen tag is denied
    where_one,
};

/// What the master sees of a drive that is gone.
enum class WhenLost : std::uint8_t {
    silent,    ///< the station leaves the bus until the drive is back
    diagnosis, ///< it asks for diagnosis (Stat_Diag) until every input has been read again
    hold,      ///< nothing: the inputs keep their values
};

/// When a drive that is lost is gone: `after` has passed since, and four further questions had no valid
/// answer. With hold nothing is decided.
struct LossRule {
    WhenLost when = WhenLost::hold;
    std::chrono::nanoseconds after = std::chrono::seconds{2};
    friend bool operator==(const LossRule&, const LossRule&) = default;
};

/// How far a drive is from being gone or back.
enum class DrivePresence : std::uint8_t {
    awaited,   ///< it has not answered since the start
    here,      ///< also while it is lost and not gone
    gone,      ///< until it answers
    returning, ///< with silent: it answers, and the station does not appear yet
};

/// A register in which the instrument says how it gives its values: the station says it, too.
struct ScaleRegister {
    std::uint16_t tag = 0;
    std::uint16_t expected = 0; ///< by the station
    bool only_display = false;  ///< it concerns the tags that follow the display; else every floating value
    friend bool operator==(const ScaleRegister&, const ScaleRegister&) = default;
};

/// One that says otherwise.
struct ScaleFault {
    std::uint16_t tag = 0, word = 0, expected = 0;
    friend bool operator==(const ScaleFault&, const ScaleFault&) = default;
};

/// One drive of the line.
struct DriveSettings {
    UnitAddress address{};
    const TagTable* tags = nullptr;    ///< outlives the poller
    bool tags_only_from_table = false; ///< unlisted_tags = "refuse"
    /// Numbers come as text that does not show their decimals (EI-ASCII): what the table does not say has to
    /// be found out, outputs included, before the exchange begins.
    bool scale_from_table = false;
    std::optional<std::uint8_t> unlisted_decimals; ///< with scale_from_table: of numbers that are in no table
    /// Read before the exchange and after a loss. What one contradicts is not trusted: X-54, as X-49.
    std::vector<ScaleRegister> scale_registers{};
    bool unscaled_holds = true; ///< false: unscaled_tags = "zero", the exchange begins all the same
    DeniedHold denied_holds = DeniedHold::never; ///< not never: outputs are read once before the exchange
    std::chrono::nanoseconds output_refresh = std::chrono::seconds{1}; ///< 0 = every cycle
    ZeroAfter zero_after = std::chrono::nanoseconds{0};
    /// Each output is also read cyclically, unless its tag is write-only, and a standing word is written
    /// again only where the drive shows another one: the front panel is overridden and no memory is worn. A
    /// word that was refused is tried again after 1 s, then more seldom up to every 10 s; one that was
    /// accepted and not kept up to every minute. output_refresh is not used. Row C-019.
    bool compare_outputs = false;
    std::vector<std::uint16_t> never_written; ///< tags that count as read only, whatever the table says
    /// Read once a round; 250 ms apart where nothing is read for the master. kMaxWatched at most.
    std::vector<std::uint16_t> watched;
    int retries = 2;
    LossRule loss;
    /// With silent: each output is set to 0 before the station appears again, whatever zero_after says.
    bool zeroes_on_return = false;
    /// Between two questions to a drive of which is to be decided whether it is gone or back.
    std::chrono::nanoseconds decides_every = std::chrono::milliseconds{200};
    /// While nothing else is asked; and between two probes of lost drives of the line, of which the one that
    /// has waited longest is the next: the time after which no answer to the last probe can come.
    std::chrono::nanoseconds probe_interval = std::chrono::seconds{1};
    friend bool operator==(const DriveSettings&, const DriveSettings&) = default;
};

/// Who asked for a transaction. output: a write, or a read that shows what became of compared outputs; watch:
/// a read that serves watched tags only.
/// survey: a read that nothing follows from but its answer. scale: a read of a ScaleRegister.
enum class Purpose : std::uint8_t { input, output, safe_state, demand, operate, watch, probe, survey, scale };

/// The next thing to do on the line. Handed to a Backend, its outcome to Poller::done().
struct Transaction {
    enum class Kind : std::uint8_t { read, write, probe };
    Kind kind = Kind::probe;
    Purpose purpose = Purpose::probe;
    std::size_t unit = 0;                 ///< index of the drive in the settings
    const Tag* tag = nullptr;             ///< first tag of a read; valid until done()
    std::uint16_t count = 1;              ///< tags of a block
    std::span<const std::uint16_t> words; ///< of a write, `count` of them; valid until done()
    bool once = false;                    ///< of a write: Backend::write_once()
    std::uint32_t order = 0;              ///< of operate and survey: the number of the order
};

/// The outcome of a transaction. `words` holds `count` words after a read without error.
struct Outcome {
    AccessError error = AccessError::none;
    std::span<const std::uint16_t> words;
    std::string_view answer{};  ///< of a read: what the drive has said (Backend::last_answer())
    std::string_view trouble{}; ///< of a survey: why there is none (Backend::last_trouble())
    bool sent = true;           ///< of a write: Backend::has_sent()
    bool may_be_older = false;  ///< of a read: Backend::may_be_older()
    unsigned questions = 1;     ///< Backend::questions()
};

/// An output whose safe state is not proven yet.
struct ZeroLeft {
    std::uint16_t tag = 0;
    bool is_written = false; ///< the drive has taken the 0, and it was not read back yet
    friend bool operator==(const ZeroLeft&, const ZeroLeft&) = default;
};

/// A watched tag as it was read last. untried: not yet.
struct Watched {
    std::uint16_t tag = 0;
    std::uint16_t word = 0;
    WordState state = WordState::untried;
    bool repeated = false; ///< see DriveSnapshot
};

/// State of one drive for `dpctl`, as a plain value. reads and writes count what the drive did, refusals what
/// it refused or did not understand, silences what it did not answer (or not so that it can be believed),
/// losses how often it was given up.
struct DriveSnapshot {
    bool known = false; ///< false until the first answer or the first loss
    bool answers = false;
    Generation generation = 0;
    std::array<std::uint16_t, kMaxParameters> words{}; ///< inputs as read, outputs as last written
    /// stale from the first access on that was not answered well, or while the drive is silent, until one is.
    std::array<WordState, kMaxParameters> states{};
    /// Why, of the last access; none where it worked. With stale: no_answer, deferred or not_understood.
    std::array<AccessError, kMaxParameters> errors{};
    /// Stale, but its retries are not used up: neither lamps nor NETWORK STATE change for it.
    std::array<bool, kMaxParameters> repeated{};
    std::array<Watched, kMaxWatched> watched{};            ///< in the order of DriveSettings::watched
    std::array<AnswerText, kMaxParameters> answer_texts{}; ///< behind no_scale, contradicted, invalid_tag
    std::array<Instant, kMaxParameters> updated_at{};      ///< last success; default = never
    std::chrono::nanoseconds cycle{}; ///< the last whole round over this unit's parameters
    Histogram refresh_ms;             ///< all of them since the start, in ms, rounded up
    std::uint64_t reads = 0, writes = 0, silences = 0, refusals = 0, losses = 0;
    std::uint64_t not_understood = 0; ///< those of the refusals that say so: noise towards the drive
    /// Writes of Demand Data that were never made: too many waited, or they no longer stood when the drive
    /// was lost or did not understand them.
    std::uint64_t orders_dropped = 0;
    AnswerCounts heard; ///< filled in by the owner of the back-end
    DrivePresence presence = DrivePresence::awaited;
    bool away = false;            ///< the station is not on the bus for it (WhenLost::silent)
    std::uint32_t departures = 0; ///< how often it was found gone
    /// The first tag that could not be set to 0 when the drive came back; 0 = none.
    std::uint16_t not_zeroed = 0;
    std::optional<ScaleFault> scale_fault; ///< why tags of the layout are unscaled (X-54)
    /// The master is lost and outputs stand until then (RIDE THROUGH); kNever = for ever. Nothing: none do.
    std::optional<Instant> ride_ends;
};

/// An order of `dpctl` for one drive: read or write one tag now.
struct OperateOrder {
    std::uint32_t number = 0;
    std::size_t unit = 0;
    bool is_write = false;
    std::uint16_t tag = 0;
    std::uint16_t word = 0;
};

/// The text of a drive's answer to a survey read; ends with NUL.
using SaidText = std::array<char, 96>;

struct OperateAnswer {
    std::uint32_t number = 0;
    AccessError error = AccessError::none;
    std::uint16_t word = 0;
    SaidText said{}; ///< of a survey: the text of the value, empty with Modbus; with an error why
};

class Poller {
public:
    Poller(const std::vector<DriveSettings>& units, BlockRule rule);
    ~Poller();

    /// When a frame with its checksum has come last that can only be of this drive, in time or late
    /// (AnswerCounts::valid_at). Before next() and before done().
    void heard(std::size_t unit, Instant valid_at);

    // What the master wants, by the index of the drive. Orders of Demand Data come after the image of their
    // layout or before.
    /// An image with another generation is a new layout, and the end of the one before it.
    void set_outputs(std::size_t unit, const OutputImage& image);
    /// Every layout up to and including this generation has ended; may come before its image, and again. Only
    /// the outputs of an image with may_write go to the safe state: before, nothing is written at all.
    void left_data_exchange(std::size_t unit, const LeftDataExchange& left);
    void set_demand(std::size_t unit, const DemandOrder& order);
    /// From now on, also for a ride that is under way: it counts from the loss. What is zeroed already stays.
    void set_zero_after(std::size_t unit, ZeroAfter after);
    /// The drive is about to leave, or the program to end: what would be zeroed later is zeroed now, also of
    /// layouts that end afterwards. One that is lost is asked once more at once: it may be back.
    void cancel_ride_through(std::size_t unit);
    /// The master was lost in a way that is not ridden through: what left_data_exchange() has ended, and
    /// would be zeroed later, is zeroed now.
    void end_ride(std::size_t unit);
    /// False: too many wait already, or there is no such drive. A lost drive is answered for at once:
    /// no_answer. The limits of the tag table are not looked at: parse_value() has done it.
    bool operate(const OperateOrder& order);
    /// Reads a tag for a survey, whatever the table says of it: once, behind everything else, and one such
    /// read in a round of the living drives. Its answer, silence included, changes nothing else. False: one
    /// waits for this drive already, or there is no such drive. A lost drive is answered for at once.
    /// `rule`: SurveySlot::set(); precondition: it gives the tag a mnemonic, or its row does.
    bool survey(std::size_t unit, std::uint32_t number, std::uint16_t tag,
                std::optional<MnemonicRule> rule = std::nullopt);

    /// The order of operate() or survey() with this number was answered by somebody else, whatever its drive:
    /// what is left of it is dropped without an answer. Precondition: no transaction is under way.
    void withdraw(std::uint32_t number);

    /// What to do now; nothing = wait until next_deadline() or until something new is set. Then also what can
    /// be seen may have changed: that a drive is gone is not shown behind one more question.
    std::optional<Transaction> next(Instant now);
    /// The outcome of the transaction given last.
    void done(const Outcome& outcome, Instant now);
    /// When next() has something to do, if nothing new is set before; a moment that has passed: now. kNever
    /// while a transaction is under way.
    Instant next_deadline() const;

    /// The inputs of a drive, when they changed since the last take.
    std::optional<InputImage> take_inputs(std::size_t unit);
    std::optional<DemandAnswer> take_demand_answer(std::size_t unit);
    std::optional<OperateAnswer> take_operate_answer();

    /// Does an output still wait to be written to its safe state, now or when a ride is over?
    bool safe_state_pending() const;
    /// The tags of those of this drive, in the order of their layouts.
    std::vector<ZeroLeft> safe_state_left(std::size_t unit) const;

    const DriveSnapshot& snapshot(std::size_t unit) const;

    /// Nothing is asked of the drive until next(), for longer than a station may wait: its words are old
    /// until it answers again, and where something follows from its loss (LossRule) it is gone at once.
    /// Orders of Demand Data that newer ones have taken the place of are dropped. Precondition: no
    /// transaction is under way.
    void not_asked(std::size_t unit, Instant now);

    /// The port is about to be another one, and no line has the present one any more: what was written goes
    /// to the safe state here, and nothing else is written until port_changed(). A drive that is lost, or
    /// that is never to be zeroed, is left as it is.
    void leave_port();
    /// The port is another one: every present output is written at once, also to a drive that was lost at the
    /// old one; of a row that says `once` only a word that is not the one sent last. Precondition: no
    /// transaction is under way.
    void port_changed();

    /// The drives from now on. Drive i is the one that had the index stays[i] until now and goes on with all
    /// that is known and wanted of it, with the tags, watched tags, refresh and retries of units[i]: what a
    /// row asks in another way is asked anew, the rest goes on as it was. Where that is nothing it is a new
    /// one. The others are forgotten with whatever they still had to do. Tables of before may go after it.
    /// Precondition: no transaction is under way; no index stays twice; address and compare_outputs of one
    /// that stays are the same.
    void exchange(const std::vector<DriveSettings>& units,
                  const std::vector<std::optional<std::size_t>>& stays, BlockRule rule);

private:
    class Unit; ///< one drive: what is wanted of it and what is known of it
    std::optional<Transaction> next_survey(Instant now);

    std::optional<Transaction> next_of(Instant now);
    bool may_time_out() const;
    Instant probe_due(std::size_t unit) const;
    std::optional<Transaction> probe(std::size_t unit, Instant now);

    std::vector<std::unique_ptr<Unit>> units_;
    std::size_t turn_ = 0;             ///< whose turn is next
    std::optional<Transaction> doing_; ///< given by next(), not yet done()
    bool probes_ = false;              ///< it is the probe of a lost drive
    bool shows_first_ = false;         ///< that a drive is gone or back, before the next question
    std::optional<Instant> probed_at_; ///< end of the last one
    Instant began_{};                  ///< of `doing_`
};

} // namespace dpslave::drive
