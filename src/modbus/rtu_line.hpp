// SPDX-License-Identifier: Apache-2.0
/// A serial line with Modbus RTU on it: one request, its answer. libmodbus makes and judges the frames; the
/// port is opened by io, so that every port of the program is opened, locked, judged and lost alike.
///
/// What libmodbus leaves open is closed here: it does not keep the 3.5 characters of silence before a
/// request, takes a late answer to an earlier request for the present one, takes unit 0 for any unit, and
/// does not compare echoes.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/io/port.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <modbus.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace dpslave::modbus {

inline constexpr std::uint8_t kLowestUnit = 1;
inline constexpr std::uint8_t kHighestUnit = 247;

/// From the start bit to the last stop bit.
int bits_of_a_character(const RtuSettings& settings);

class RtuLine {
public:
    static Result<std::unique_ptr<RtuLine>, std::string> open(const RtuSettings& settings,
                                                              std::atomic<bool>& is_open);

    /// `request` and the answer are from the function code on; the answer is valid until the next call.
    /// Nothing: none came that can be believed, and trouble() says why.
    std::optional<Bytes> exchange(std::uint8_t unit, Bytes request);

    const std::string& trouble() const { return trouble_; }

private:
    /// One frame, or why there is none.
    enum class Heard : std::uint8_t {
        frame,   ///< of the unit asked, in adu_
        other,   ///< of another unit
        silence, ///< until the time was over
        broken_off,
        noise, ///< wrong check sum or length
        gone,  ///< the port has vanished
    };
    struct FreeContext {
        void operator()(modbus_t* context) const { modbus_free(context); }
    };
    using Context = std::unique_ptr<modbus_t, FreeContext>;

    RtuLine(RtuSettings settings, Context context, io::Port port, std::atomic<bool>& is_open);

    bool ready();
    void use_port();
    void lose();
    bool await_late_answer(std::uint8_t unit);
    bool await_pause();
    bool send(std::uint8_t unit, Bytes request);
    std::optional<Bytes> receive_answer(std::uint8_t unit, Bytes request);
    Heard receive(std::uint8_t unit, Instant until);
    std::chrono::nanoseconds duration_of(std::size_t characters) const;
    std::chrono::nanoseconds pause() const;

    RtuSettings settings_;
    Context context_;
    io::Port port_;
    std::atomic<bool>& is_open_;
    Instant heard_at_{}; ///< when the last octet was read
    /// Until when a unit may still answer a request that was given up; passed = it owes nothing.
    std::array<Instant, kHighestUnit + 1> late_until_{};
    std::array<std::uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> adu_{};
    std::size_t adu_length_ = 0;
    std::string trouble_;
};

} // namespace dpslave::modbus
