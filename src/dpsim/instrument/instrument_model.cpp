// SPDX-License-Identifier: Apache-2.0
#include "instrument_model.hpp"

#include "instrument_registers.hpp"

#include <algorithm>
#include <array>

namespace dpslave::sim {
namespace {

/// The values that an instrument begins with if its table does not say: tag, value, decimals of the value.
struct Start {
    std::uint16_t tag;
    std::int32_t value;
    unsigned decimals;
};
constexpr std::array kStarts{
    Start{kProcessValue, 200, 1},
    Start{kTargetSetpoint, 500, 1},
    Start{kWorkingSetpoint, 500, 1},
    Start{kSetpoint1, 500, 1},
    Start{kSetpoint2, 750, 1},
    Start{6, 50, 1}, // proportional band
    Start{8, 360, 0},
    Start{9, 60, 0}, // integral and derivative time
    Start{kProgramNumber, 1, 0},
    Start{kProgramStatus, kReset, 0},
    Start{kVersion, 0x0322, 0},
    Start{kMostSegments, 16, 0},
};
/// Program 1 as it is delivered here, by offset: a ramp to 100.0, a dwell, a step to 60.0 and the end.
constexpr std::array kProgram{
    Start{0, 3, 0},  Start{1, 50, 1},   Start{2, 1, 0},    Start{3, 1, 0},
    Start{4, 1, 0},  Start{8, 1, 0},    Start{9, 1000, 1}, Start{10, 100, 1},
    Start{12, 1, 0}, Start{16, 3, 0},   Start{18, 300, 1}, Start{20, 3, 0},
    Start{24, 4, 0}, Start{25, 600, 1}, Start{32, 0, 0},   Start{35, 1, 0},
};

} // namespace

InstrumentModel::InstrumentModel(std::uint8_t unit, std::uint16_t ident, std::vector<SimParameter> registers,
                                 unsigned programs)
    : Device(std::to_string(unit), std::move(registers))
{
    start_values(ident, programs);
}

std::int32_t InstrumentModel::counts_at(std::uint16_t tag)
{
    const SimParameter* const p = find(tag);
    return p == nullptr ? 0 : p->value.counts;
}

void InstrumentModel::start_values(std::uint16_t ident, unsigned programs)
{
    const auto start = [this](std::uint16_t tag, std::int32_t value, unsigned decimals) {
        SimParameter* const p = find(tag);
        if (p == nullptr || p->tag.has_start || p->tag.type == TagKind::string) return;
        p->value.counts = std::clamp(rescaled(value, decimals, p->tag.decimals), p->tag.min, p->tag.max);
    };
    start(kDecimals, 1, 0);
    set_decimals(find(kDecimals) != nullptr ? static_cast<unsigned>(std::max(counts_at(kDecimals), 0)) : 1U);
    start(kIdent, ident, 0);
    for (const Start& s : kStarts) start(s.tag, s.value, s.decimals);
    if (programs == 0) return;
    for (const Start& s : kProgram)
        start(static_cast<std::uint16_t>(kStore + kProgramWords + s.tag), s.value, s.decimals);
    program_status_ = counts_at(kProgramStatus);
}

void InstrumentModel::put(std::uint16_t tag, std::int32_t counts)
{
    if (SimParameter* const p = find(tag)) p->put({counts, {}});
}

void InstrumentModel::put_bit(std::uint16_t tag, unsigned bit, bool on)
{
    const std::int32_t mask = 1 << bit;
    put(tag, on ? counts_at(tag) | mask : counts_at(tag) & ~mask);
    if (tag == kSummaryStatus) put(kFastStatus, counts_at(kSummaryStatus) & 0xFF);
}

void InstrumentModel::follow(std::uint16_t from, std::uint16_t to)
{
    const SimParameter *const source = find(from), *const target = find(to);
    if (source == nullptr || target == nullptr || source == target) return;
    put(to, std::clamp(rescaled(source->value.counts, source->tag.decimals, target->tag.decimals),
                       target->tag.min, target->tag.max));
}

// ---- what follows from a value ----

void InstrumentModel::changed(std::uint16_t tag, Instant now)
{
    const std::int32_t value = counts_at(tag);
    switch (tag) {
        case kTargetSetpoint:
            follow(kTargetSetpoint, selected_setpoint());
            return follow(kTargetSetpoint, kWorkingSetpoint);
        case kProgramStatus: return run_program();
        case kSummaryStatus: return put(kFastStatus, value & 0xFF);
        case kAutotune: return autotune(now);
        case kManual:
            put_bit(kSummaryStatus, kSummaryManual, value == 1);
            return put_bit(kControlStatus, kControlManual, value == 1);
        case kDecimals: return set_decimals(static_cast<unsigned>(std::max(value, 0)));
        default: break;
    }
    if (tag != kSelectSetpoint && tag != selected_setpoint()) return;
    follow(selected_setpoint(), kTargetSetpoint);
    follow(selected_setpoint(), kWorkingSetpoint);
}

/// Tag 15 counts from 0; setpoints 3 to 16 lie together.
std::uint16_t InstrumentModel::selected_setpoint()
{
    const std::int32_t choice = std::clamp(counts_at(kSelectSetpoint), 0, 15);
    if (choice < 2) return choice == 0 ? kSetpoint1 : kSetpoint2;
    return static_cast<std::uint16_t>(kSetpoint3 + choice - 2);
}

void InstrumentModel::prepare_tune(std::chrono::nanoseconds takes, bool fails)
{
    tune_takes_ = takes;
    tune_fails_ = fails;
}

void InstrumentModel::autotune(Instant now)
{
    if (counts_at(kAutotune) == 0) {
        if (tune_ends_) end_tune(false, false);
        return;
    }
    if (tune_ends_) return;
    tune_ends_ = now + tune_takes_;
    put_bit(kControlStatus, kTuneFailed, false);
    put_bit(kControlStatus, kTuneCompleted, false);
    put_bit(kControlStatus, kTuning, true);
    put_bit(kSummaryStatus, kSummaryTuning, true);
}

void InstrumentModel::end_tune(bool completed, bool failed)
{
    tune_ends_.reset();
    put(kAutotune, 0);
    put_bit(kControlStatus, kTuning, false);
    put_bit(kSummaryStatus, kSummaryTuning, false);
    if (completed) put_bit(kControlStatus, kTuneCompleted, true);
    if (failed) put_bit(kControlStatus, kTuneFailed, true);
}

void InstrumentModel::settle(Instant now)
{
    if (tune_ends_ && now >= *tune_ends_) end_tune(!tune_fails_, tune_fails_);
}

/// Changes from reset or complete to run: program 0 becomes a copy of the program that is chosen.
void InstrumentModel::run_program()
{
    const std::int32_t before = std::exchange(program_status_, counts_at(kProgramStatus));
    if (program_status_ != kRun || (before != kReset && before != kComplete)) return;
    const auto chosen =
        static_cast<unsigned>(std::clamp<std::int32_t>(counts_at(kProgramNumber), 1, kPrograms));
    for (unsigned i = 0; i < kProgramWords; ++i)
        follow(static_cast<std::uint16_t>(kStore + chosen * kProgramWords + i),
               static_cast<std::uint16_t>(kStore + i));
}

/// Values that follow the display keep their size and take its number of decimals.
void InstrumentModel::set_decimals(unsigned decimals)
{
    decimals = std::min(decimals, kDisplayDecimals);
    for (SimParameter& p : parameters_) {
        if (!p.tag.follows_display || p.tag.decimals == decimals) continue;
        for (std::int32_t* const counts : {&p.value.counts, &p.tag.min, &p.tag.max})
            *counts = rescaled(*counts, p.tag.decimals, decimals);
        p.motion.reset();
        p.tag.decimals = decimals;
    }
}

} // namespace dpslave::sim
