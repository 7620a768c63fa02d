// SPDX-License-Identifier: Apache-2.0
/// FDL telegrams: length, then contents; and the frames that a slave sends. Source: wire reference 2.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::fdl {

/// Start and end delimiters (wire reference 2.1).
inline constexpr std::uint8_t kSD1 = 0x10; ///< no data
inline constexpr std::uint8_t kSD2 = 0x68; ///< variable data
inline constexpr std::uint8_t kSD3 = 0xA2; ///< eight octets of data
inline constexpr std::uint8_t kSD4 = 0xDC; ///< token
inline constexpr std::uint8_t kSC = 0xE5;  ///< short acknowledge
inline constexpr std::uint8_t kED = 0x16;

inline constexpr std::uint8_t kBroadcast = 127;  ///< only as DA, only with SDN
inline constexpr std::size_t kMaxTelegram = 255; ///< octets: LE 249 + 6

/// Idle time after which a new request may begin, the same at all rates. Unit: T_bit. Source: EN 50170-2,
/// T_SYN.
inline constexpr Tbit kTsyn{33};

/// Function codes of a request, FC bits 3..0 (wire reference 2.3).
enum class Function : std::uint8_t {
    time_event = 0x0,
    sda_low = 0x3,
    sdn_low = 0x4,
    sda_high = 0x5,
    sdn_high = 0x6,
    msrd = 0x7,
    fdl_status = 0x9,
    srd_low = 0xC,
    srd_high = 0xD,
    ident = 0xE,
    lsap_status = 0xF,
};

/// FC of a slave's replies (wire reference 2.4): station type bits 00.
inline constexpr std::uint8_t kFcOk = 0x00;
inline constexpr std::uint8_t kFcUe = 0x01;
inline constexpr std::uint8_t kFcRr = 0x02;
inline constexpr std::uint8_t kFcRs = 0x03;
inline constexpr std::uint8_t kFcDl = 0x08;
inline constexpr std::uint8_t kFcDh = 0x0A;

/// Why a run of octets is no telegram. One count for each kind, shown by `dpctl counters`.
enum class Flaw : std::uint8_t {
    start_delimiter,
    length_mismatch, ///< LE and LEr differ, or the second SD2 is missing
    length_range,    ///< LE outside 4..249
    checksum,
    end_delimiter,
    missing_sap,    ///< the extension bit announces a SAP, but no octet is left for it
    extension,      ///< a SAP octet with region/segment or a further extension: not used by DP
    source_address, ///< SA 127
    character,      ///< parity, framing or break, reported by the UART
    unfinished,     ///< the line fell silent in the middle of a telegram
};
inline constexpr std::size_t kFlaws = 10;
std::string_view text(Flaw flaw) noexcept;

/// A telegram as heard. SC and SD4 have no FC; SC has no addresses either.
struct Telegram {
    std::uint8_t delimiter = 0;
    std::uint8_t da = 0; ///< without the extension bit
    std::uint8_t sa = 0;
    std::uint8_t fc = 0;
    std::optional<std::uint8_t> dsap; ///< 0..63
    std::optional<std::uint8_t> ssap;
    Bytes data; ///< user data without SAP octets; a view into the frame

    bool has_fc() const { return delimiter == kSD1 || delimiter == kSD2 || delimiter == kSD3; }
    bool is_request() const { return has_fc() && (fc & 0x40) != 0; }
    Function function() const { return static_cast<Function>(fc & 0x0F); }
    bool fcb() const { return (fc & 0x20) != 0; }
    bool fcv() const { return (fc & 0x10) != 0; }
};

/// Returns the number of octets of the telegram that begins with `head`; 0 if too few octets are known.
Result<std::size_t, Flaw> frame_length(Bytes head);

/// The contents of a telegram. Precondition: frame.size() == *frame_length(frame), not 0.
Result<Telegram, Flaw> decode(Bytes frame);

using Frame = ByteBuffer<kMaxTelegram>;

/// SD1: a reply without data (FDL status, UE, RR, RS).
Frame encode_sd1(std::uint8_t da, std::uint8_t sa, std::uint8_t fc);

/// SD2 with or without SAPs: both or none. Precondition: 1 <= SAP octets + data <= 246. Never SD3: wire
/// reference 2.1.
Frame encode_sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, std::optional<std::uint8_t> dsap,
                 std::optional<std::uint8_t> ssap, Bytes data);
/// The same of `telegram`, in the place of what `frame` has. Precondition: `telegram.data` is no part of it.
void encode_sd2(Frame& frame, const Telegram& telegram);

Frame encode_sc();

} // namespace dpslave::fdl
