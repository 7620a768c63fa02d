// SPDX-License-Identifier: Apache-2.0
/// A 2408f or 2404f as its line and its front panel see it: words of registers, and who may write them
/// (handbook chapter 7; EI-ASCII and Modbus reference, section 5). Pure; knows no telegram.
#pragma once

#include "instrument_model.hpp"
#include "modbus_frame.hpp"

#include <span>

namespace dpslave::sim {

/// Identity word (tag 122) of the instrument of this name, "2408f" or "2404f"; nothing for another name.
std::optional<std::uint16_t> instrument_ident(std::string_view name);

/// What an instrument does wrong on request.
struct InstrumentFaults {
    bool silence = false;                  ///< hears nothing, as if it were off
    bool bad_crc = false;                  ///< replies carry a wrong CRC
    bool garbage = false;                  ///< replies are random octets
    bool no_loopback = false;              ///< says nothing to function 8, as an older one
    bool too_short = false;                ///< replies end one octet early
    Exception refuse = Exception::none;    ///< answers every request so
    Exception no_writes = Exception::none; ///< answers every write so
    std::chrono::nanoseconds slow{0};      ///< on top of the turnaround
};

struct InstrumentCounters {
    std::uint64_t reads = 0;  ///< requests, block or single
    std::uint64_t words = 0;  ///< that they asked for
    std::uint64_t writes = 0; ///< values taken
    std::uint64_t exceptions = 0;
};

class Instrument final : public InstrumentModel {
public:
    /// As InstrumentModel. Registers are the tags of the table.
    Instrument(std::uint8_t unit, std::uint16_t ident, const std::vector<SimTag>& tags, unsigned programs);

    std::uint8_t unit() const { return unit_; }

    // Over the line: words go in and out as the registers have them. From 8000h on lies the IEEE area.
    Exception read(std::uint16_t address, std::uint16_t count, std::vector<std::uint16_t>& words,
                   Instant now);
    Exception write_one(std::uint16_t address, std::uint16_t word, Instant now);
    /// Values at missing addresses are dropped without a word; the first that is refused ends it, what stands
    /// before it has been written.
    Exception write_block(std::uint16_t address, std::span<const std::uint16_t> words, Instant now);
    std::uint8_t fast_status();

    /// As the operator does at the front panel: what is read only or beyond its limits is refused.
    Exception panel(std::uint16_t tag, std::int32_t counts, Instant now);

    std::vector<std::string> take_log() { return std::exchange(log_, {}); }
    std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

    InstrumentFaults faults{};
    InstrumentCounters counters{};

private:
    Exception read_ieee(std::uint16_t address, std::uint16_t count, std::vector<std::uint16_t>& words,
                        Instant now);
    Exception write_block_ieee(std::uint16_t address, std::span<const std::uint16_t> words, Instant now);
    /// One value of a block write; `counts` is nothing where the octets are no number.
    Exception write_member(std::uint16_t tag, Parameter& parameter, std::optional<std::int32_t> counts,
                           Instant now);
    Exception write(Parameter& parameter, std::int32_t counts, Instant now);
    bool is_writable(const Parameter& parameter);

    enum class IeeeForm : std::uint8_t {
        word,         ///< the first register, the second is 8000h
        milliseconds, ///< 32 bits
        single,
    };
    IeeeForm ieee_form(const SimTag& tag);
    std::uint32_t ieee_of(const Parameter& parameter, Instant now);
    std::optional<std::int32_t> counts_of_ieee(const Parameter& parameter, std::uint32_t bits);
    std::uint16_t word_of(const Parameter& parameter, Instant now);
    std::int32_t counts_of(const Parameter& parameter, std::uint16_t word);
    bool integer_resolution();

    std::uint8_t unit_;
    std::vector<std::string> log_, warnings_;
};

} // namespace dpslave::sim
