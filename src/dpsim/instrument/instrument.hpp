// SPDX-License-Identifier: Apache-2.0
/// A 2408f or 2404f as its line and its front panel see it: words of registers, and what may write them
/// (handbook chapter 7; EI-ASCII and Modbus reference, section 5). It is pure and knows no telegram.
#pragma once

#include "instrument_model.hpp"
#include "modbus_frame.hpp"

#include <span>

namespace dpslave::sim {

/// Identity word (tag 122) of the instrument of this name, "2408f" or "2404f"; nothing for another name.
std::optional<std::uint16_t> instrument_ident(std::string_view name);

/// The faults that an instrument makes on request.
struct InstrumentFaults : DeviceFaults {
    bool no_loopback = false;              ///< no reply to function 8, as an older one
    bool too_short = false;                ///< replies end one octet early
    Exception refuse = Exception::none;    ///< answers every request so
    Exception no_writes = Exception::none; ///< answers every write so
};

struct InstrumentCounters {
    std::uint64_t reads = 0;  ///< requests, block or single
    std::uint64_t words = 0;  ///< that they asked for
    std::uint64_t writes = 0; ///< values taken
    std::uint64_t exceptions = 0;
};

class Instrument final : public InstrumentModel {
public:
    /// The parameters are those of InstrumentModel. Registers are the tags of the table.
    Instrument(std::uint8_t unit, std::uint16_t ident, const std::vector<SimTag>& tags, unsigned programs);

    std::uint8_t unit() const { return unit_; }

    // Over the line: words go in and out as the registers have them. The IEEE area begins at 8000h.
    Exception read(std::uint16_t address, std::uint16_t count, std::vector<std::uint16_t>& words,
                   Instant now);
    Exception write_one(std::uint16_t address, std::uint16_t word, Instant now);
    /// Values at missing addresses are dropped without an exception. The first that is refused ends it; those
    /// before it are written.
    Exception write_block(std::uint16_t address, std::span<const std::uint16_t> words, Instant now);
    std::uint8_t fast_status();

    /// Sets a value as the operator does at the front panel: one that is read only or beyond its limits is
    /// refused.
    Exception panel(std::uint16_t tag, std::int32_t counts, Instant now);

    std::vector<std::string> take_log() { return std::exchange(log_, {}); }
    std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

    InstrumentFaults faults{};
    InstrumentCounters counters{};

private:
    bool accept(SimParameter& parameter, std::int32_t counts, Instant now);
    Exception write(SimParameter& parameter, std::int32_t counts, Instant now);
    bool is_writable(const SimParameter& parameter);

    enum class IeeeForm : std::uint8_t {
        word,         ///< the first register, the second is 8000h
        milliseconds, ///< 32 bits
        single,
    };
    IeeeForm ieee_form(const SimTag& tag);
    std::uint32_t ieee_of(const SimParameter& parameter, Instant now);
    std::optional<std::int32_t> counts_of_ieee(const SimParameter& parameter, std::uint32_t bits);
    std::uint16_t word_of(const SimParameter& parameter, Instant now);
    std::int32_t counts_of(const SimParameter& parameter, std::uint16_t word);
    bool integer_resolution();

    std::uint8_t unit_;
    std::vector<std::string> log_, warnings_;
};

} // namespace dpslave::sim
