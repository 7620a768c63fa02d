// SPDX-License-Identifier: Apache-2.0
#include "instrument.hpp"

#include "instrument_registers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace dpslave::sim {
namespace {

constexpr std::uint16_t kNoSecondWord = 0x8000; ///< of a value that is no floating point number
constexpr std::uint16_t kMostRegisters = 125;

/// Registers that can be written only while another one has a certain value (handbook chapters 7 and 8).
struct Interlock {
    std::uint16_t first, last, tag;
    std::int32_t value;
};
constexpr std::array kWritableWhile{
    Interlock{kOutputPower, kOutputPower, kManual, 1},
    Interlock{kManualValve, kManualValve, kManual, 1},
    Interlock{kStore, kStore + kProgramWords - 1, kProgramStatus, kHold},
};

bool is_unsigned(const SimTag& tag)
{
    return tag.type != TagKind::number || (!tag.follows_display && tag.max > 32767);
}

/// The duration of a segment is in seconds in the normal area.
std::uint32_t ms_per_count(const SimTag& tag)
{
    return tag.ms_per_count > 0 ? static_cast<std::uint32_t>(tag.ms_per_count) : 1'000U;
}

bool is_in_store(std::uint16_t tag)
{
    return tag >= kStore && tag < kStore + (kPrograms + 1) * kProgramWords;
}

std::vector<SimParameter> registers_of(const std::vector<SimTag>& tags, unsigned programs)
{
    const unsigned store_ends = programs == 0 ? kStore : kStore + (programs + 1) * kProgramWords;
    std::vector<SimParameter> registers;
    for (const SimTag& tag : tags)
        if (!is_in_store(tag.number) || tag.number < store_ends)
            registers.push_back({tag, {}, tag.start, std::nullopt});
    for (SimParameter& p :
         registers) // the table says ro, to protect a real instrument, which takes the write
        if (p.tag.number == kMode) p.tag.access = TagAccess::read_write;
    return registers;
}

std::optional<std::int32_t> counts_of_single(const SimTag& tag, std::uint32_t bits)
{
    double value = std::bit_cast<float>(bits);
    for (unsigned i = 0; i < tag.decimals; ++i) value *= 10.0;
    if (!(std::abs(value) <= 2'000'000'000.0)) return std::nullopt; // not a number is caught here too
    return static_cast<std::int32_t>(std::llround(value));
}

} // namespace

std::optional<std::uint16_t> instrument_ident(std::string_view name)
{
    if (name == "2408f") return std::uint16_t{0x2480};
    if (name == "2404f") return std::uint16_t{0x2440};
    return std::nullopt;
}

Instrument::Instrument(std::uint8_t unit, std::uint16_t ident, const std::vector<SimTag>& tags,
                       unsigned programs)
    : InstrumentModel(unit, ident, registers_of(tags, programs), programs), unit_(unit)
{}

// ---- values ----

std::uint8_t Instrument::fast_status()
{
    return static_cast<std::uint8_t>(counts_at(find(kFastStatus) != nullptr ? kFastStatus : kSummaryStatus) &
                                     0xFF);
}

bool Instrument::integer_resolution()
{
    return counts_at(kResolution) == 1;
}

/// Returns the form of a tag in the IEEE area (EI-ASCII and Modbus reference, section 5). Word 2 of a segment
/// is a rate or a duration, as word 0 says.
Instrument::IeeeForm Instrument::ieee_form(const SimTag& tag)
{
    const unsigned word = (unsigned{tag.number} - kStore) % kProgramWords;
    if (is_in_store(tag.number) && word >= kSegmentWords && word % kSegmentWords == kDurationOrRate) {
        switch (counts_at(static_cast<std::uint16_t>(tag.number - kDurationOrRate + kSegmentType))) {
            case kRampRate: return IeeeForm::single;
            case kRampTime:
            case kDwell: return IeeeForm::milliseconds;
            default: return IeeeForm::word;
        }
    }
    if (tag.type != TagKind::number) return IeeeForm::word;
    if (tag.ms_per_count > 0) return IeeeForm::milliseconds;
    return tag.is_real ? IeeeForm::single : IeeeForm::word;
}

/// The two registers of a parameter in the IEEE area.
std::uint32_t Instrument::ieee_of(const SimParameter& parameter, Instant now)
{
    const std::int32_t counts = parameter.at(now).counts;
    double value = counts;
    switch (ieee_form(parameter.tag)) {
        case IeeeForm::word: break;
        case IeeeForm::milliseconds: return static_cast<std::uint32_t>(counts) * ms_per_count(parameter.tag);
        case IeeeForm::single:
            for (unsigned i = 0; i < parameter.tag.decimals; ++i) value /= 10.0;
            return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    return std::uint32_t{word_of(parameter, now)} << 16 | kNoSecondWord;
}

std::optional<std::int32_t> Instrument::counts_of_ieee(const SimParameter& parameter, std::uint32_t bits)
{
    switch (ieee_form(parameter.tag)) {
        case IeeeForm::word: break;
        case IeeeForm::milliseconds: return static_cast<std::int32_t>(bits / ms_per_count(parameter.tag));
        case IeeeForm::single: return counts_of_single(parameter.tag, bits);
    }
    return counts_of(parameter, static_cast<std::uint16_t>(bits >> 16));
}

/// The scaled integer of the register; beyond what a word can say it stays at the end of the range.
std::uint16_t Instrument::word_of(const SimParameter& parameter, Instant now)
{
    const SimTag& tag = parameter.tag;
    std::int32_t counts = parameter.at(now).counts;
    if (integer_resolution()) counts = rescaled(counts, tag.decimals, 0);
    if (!is_unsigned(tag)) counts = std::clamp(counts, -32767, 32767);
    return static_cast<std::uint16_t>(counts & 0xFFFF);
}

std::int32_t Instrument::counts_of(const SimParameter& parameter, std::uint16_t word)
{
    const SimTag& tag = parameter.tag;
    const std::int32_t counts = is_unsigned(tag) ? std::int32_t{word} : static_cast<std::int16_t>(word);
    return integer_resolution() ? rescaled(counts, 0, tag.decimals) : counts;
}

// ---- over the line ----

Exception Instrument::read(std::uint16_t address, std::uint16_t count, std::vector<std::uint16_t>& words,
                           Instant now)
{
    settle(now);
    words.clear();
    if (count == 0 || count > kMostRegisters) return Exception::illegal_value;
    ++counters.reads;
    counters.words += count;
    const bool ieee = address >= kIeeeArea;
    if (ieee && address % 2 != 0) return Exception::illegal_address;
    if (ieee && count % 2 != 0) return Exception::illegal_value;
    const unsigned end = unsigned{address} + count;
    if (end > (ieee ? 0x10000U : kIeeeArea)) return Exception::illegal_address;
    for (unsigned at = address; at < end; at += ieee ? 2 : 1) {
        const SimParameter* const p = find(tag_at(at));
        if (p == nullptr) return Exception::illegal_address;
        const std::uint32_t bits = ieee ? ieee_of(*p, now) : word_of(*p, now);
        if (ieee) words.push_back(static_cast<std::uint16_t>(bits >> 16));
        words.push_back(static_cast<std::uint16_t>(bits & 0xFFFFU));
    }
    return Exception::none;
}

bool Instrument::is_writable(const SimParameter& parameter)
{
    const SimTag& tag = parameter.tag;
    if (tag.access == TagAccess::read_only || tag.type == TagKind::string) return false;
    return std::all_of(kWritableWhile.begin(), kWritableWhile.end(), [&](const Interlock& c) {
        return tag.number < c.first || tag.number > c.last || counts_at(c.tag) == c.value;
    });
}

/// Writes the value if that is allowed; false: the value stays.
bool Instrument::accept(SimParameter& parameter, std::int32_t counts, Instant now)
{
    if (!is_writable(parameter) || counts < parameter.tag.min || counts > parameter.tag.max) return false;
    parameter.put({counts, {}});
    changed(parameter.tag.number, now);
    return true;
}

Exception Instrument::write(SimParameter& parameter, std::int32_t counts, Instant now)
{
    const std::uint16_t tag = parameter.tag.number;
    if (!accept(parameter, counts, now)) {
        log_.push_back(fmt::format("write of tag {} refused", tag));
        return Exception::illegal_value;
    }
    ++counters.writes;
    log_.push_back(fmt::format("tag {} written {}", tag, displayed(parameter.tag, {counts, {}})));
    if (tag == kMode && counts > 2)
        warnings_.push_back(fmt::format(
            "tag 199 written {}: a real instrument would have started a factory function", counts));
    return Exception::none;
}

Exception Instrument::write_one(std::uint16_t address, std::uint16_t word, Instant now)
{
    settle(now);
    SimParameter* const p = address < kIeeeArea ? find(address) : nullptr;
    return p == nullptr ? Exception::illegal_address : write(*p, counts_of(*p, word), now);
}

Exception Instrument::write_block(std::uint16_t address, std::span<const std::uint16_t> words, Instant now)
{
    settle(now);
    if (words.empty() || words.size() > kMostRegisters) return Exception::illegal_value;
    const bool ieee = address >= kIeeeArea;
    if (ieee && address % 2 != 0) return Exception::illegal_address;
    if (ieee && words.size() % 2 != 0) return Exception::illegal_value;
    for (std::size_t i = 0; i < words.size(); i += ieee ? 2 : 1) {
        const std::uint16_t tag = tag_at(address + static_cast<unsigned>(i));
        SimParameter* const p = find(tag);
        if (p == nullptr) {
            log_.push_back(fmt::format("tag {} is not there, its value is dropped", tag));
            continue;
        }
        const auto counts = ieee ? counts_of_ieee(*p, std::uint32_t{words[i]} << 16 | words[i + 1])
                                 : std::optional{counts_of(*p, words[i])};
        if (!counts) return Exception::illegal_value;
        if (p->tag.access == TagAccess::read_only && counts_at(kSkipReadOnly) == 1) {
            log_.push_back(fmt::format("tag {} is read only and skipped", tag));
            continue;
        }
        const Exception refused = write(*p, *counts, now);
        if (refused != Exception::none) return refused;
    }
    return Exception::none;
}

Exception Instrument::panel(std::uint16_t tag, std::int32_t counts, Instant now)
{
    settle(now);
    SimParameter* const p = find(tag);
    if (p == nullptr) return Exception::illegal_address;
    return accept(*p, counts, now) ? Exception::none : Exception::illegal_value;
}

} // namespace dpslave::sim
