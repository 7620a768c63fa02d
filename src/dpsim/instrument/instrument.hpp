// SPDX-License-Identifier: Apache-2.0
/// A 2408f or 2404f in memory: what its registers hold, who may write them, and what follows from it
/// (handbook chapters 7 and 8; EI-ASCII and Modbus reference, section 5). Pure; knows no telegram.
#pragma once

#include "dpsim/common/device.hpp"
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

class Instrument final : public Device {
public:
    /// `unit`: 1 to 254. `ident`: of tag 122. `programs`: 0, 1 or 4 in the program store; program 0, the copy
    /// of the running one, comes with them. Registers are the tags of the table; of those without a start
    /// value some get a sensible one.
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

    void settle(Instant now) override;
    void changed(std::uint16_t tag, Instant now) override;

    /// How long the next autotune takes, and whether it fails.
    void prepare_tune(std::chrono::nanoseconds takes, bool fails);

    std::vector<std::string> take_log() { return std::exchange(log_, {}); }
    std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

    InstrumentFaults faults{};
    InstrumentCounters counters{};

private:
    void start_values(std::uint16_t ident, unsigned programs);
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

    std::int32_t counts_at(std::uint16_t tag);
    void put(std::uint16_t tag, std::int32_t counts); ///< nothing happens if there is no such tag
    void put_bit(std::uint16_t tag, unsigned bit, bool on);
    void follow(std::uint16_t from, std::uint16_t to); ///< `to` takes the value of `from`

    void autotune(Instant now);
    void end_tune(bool completed, bool failed);
    void run_program();
    void set_decimals(unsigned decimals);
    std::uint16_t selected_setpoint();

    std::uint8_t unit_;
    std::chrono::nanoseconds tune_takes_ = std::chrono::seconds{3};
    bool tune_fails_ = false;
    std::optional<Instant> tune_ends_;
    std::int32_t program_status_ = 0; ///< tag 23 before it changed
    std::vector<std::string> log_, warnings_;
};

} // namespace dpslave::sim
