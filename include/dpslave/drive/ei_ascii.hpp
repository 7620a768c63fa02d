// SPDX-License-Identifier: Apache-2.0
/// The EI-ASCII codec (ANSI X3.28 1976, subcategory 2.5): requests out, answers in, and the text form of
/// values. It is pure: it knows no line and no time. Source: EI-ASCII reference, sections 1, 2 and 4.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/tag.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::drive::ei {

inline constexpr std::uint8_t kStx = 0x02;
inline constexpr std::uint8_t kEtx = 0x03;
inline constexpr std::uint8_t kEot = 0x04;
inline constexpr std::uint8_t kEnq = 0x05;
inline constexpr std::uint8_t kAck = 0x06;
inline constexpr std::uint8_t kNak = 0x15;

using Mnemonic = std::array<char, 2>;
inline constexpr Mnemonic kIdentity{'I', 'I'};
inline constexpr Mnemonic kLastError{'E', 'E'};

/// Longest value text that is sent; the longest one in use has 8 characters.
inline constexpr std::size_t kMaxText = 16;
/// Longest text of an answer that is accepted: room for a STRING, which then is refused by its type.
inline constexpr std::size_t kMaxAnswerText = 80;
/// EOT GID GID UID UID STX C1 C2 text ETX BCC.
using Frame = ByteBuffer<10 + kMaxText>;

/// Exclusive OR of all octets given: those after STX, ETX included.
std::uint8_t bcc(Bytes after_stx);

/// EOT GID GID UID UID C1 C2 ENQ. Group and unit 0..15 are sent as the digits 0..9, A..F.
Frame poll(UnitAddress unit, Mnemonic mnemonic);

/// EOT GID GID UID UID STX C1 C2 text ETX BCC. Precondition: text.size() <= kMaxText.
Frame select(UnitAddress unit, Mnemonic mnemonic, std::string_view text);

/// Why the octets received are no answer.
enum class Flaw : std::uint8_t {
    none,
    unexpected_start, ///< neither STX, EOT, ACK nor NAK, or one that does not answer this request
    bad_text,         ///< a control character or an octet above 7Eh inside the frame
    too_long,
    bad_bcc,
    octets_after, ///< an EOT, ACK or NAK with something directly after it
};
std::string_view text(Flaw flaw) noexcept;

/// An answer of a drive.
struct Answer {
    enum class Kind : std::uint8_t { value, ack, nak, eot };
    Kind kind = Kind::eot;
    Mnemonic mnemonic{}; ///< of a value
    std::string text;    ///< of a value: what lies between mnemonic and ETX
};

/// Takes an answer octet by octet. The end is found by state alone: the octet after ETX is the BCC whatever
/// it is (BCC 15h looks like NAK, 04h like EOT). Octets 00, 7F and FF before an answer are the noise of a
/// transceiver that turns round, and are skipped.
class AnswerParser {
public:
    enum class To : std::uint8_t { poll, select };
    enum class Status : std::uint8_t { more, complete, broken };

    explicit AnswerParser(To request) : request_(request) {}

    Status feed(std::uint8_t octet);
    bool started() const { return state_ != State::start; } ///< noise is no start
    const Answer& answer() const { return answer_; }        ///< after complete
    Flaw flaw() const { return flaw_; }                     ///< after broken

private:
    enum class State : std::uint8_t { start, first_letter, second_letter, text, bcc, end };
    Status broken(Flaw flaw);
    Status single(Answer::Kind kind);
    Status on_start(std::uint8_t octet);
    Status on_end(std::uint8_t octet);

    To request_;
    State state_ = State::start;
    std::uint8_t sum_ = 0;
    Answer answer_;
    Flaw flaw_ = Flaw::none;
};

/// The form of an ENUM in requests: 590+ ">05", AC drives "5." (both are understood in answers).
enum class EnumForm : std::uint8_t { hexadecimal, decimal };

/// Why a text is no value of a tag, or a word cannot be sent as one.
enum class ValueFlaw : std::uint8_t {
    not_a_value,
    too_many_decimals, ///< the answer has more decimals than the tag table gives: the table is wrong
    out_of_span,       ///< does not fit in the 16 bits, or in the type; it is never clamped
    wrong_form,        ///< hexadecimal where the table has a number, or the other way round
    unsupported_type,  ///< STRING
};
std::string_view text(ValueFlaw flaw) noexcept;

/// The text of `word`: always with a decimal point, without redundant zeros ("30.", "-0.05"),
/// hexadecimal after '>'.
Result<std::string, ValueFlaw> encode_value(const Tag& tag, std::uint16_t word, EnumForm enums);

/// The 16 bits of an answer: with or without point, spaces around it (the fixed width has them in front),
/// digits above 9 in either case.
Result<std::uint16_t, ValueFlaw> decode_value(const Tag& tag, std::string_view text);

/// A word in the form of EE, II and every WORD: '>' and one to four hexadecimal digits.
Result<std::uint16_t, ValueFlaw> decode_word(std::string_view text);

/// Returns the meaning of the drive's last error (EE, its high octet) for an access. Line and format errors
/// (02, 03, 07C7) are not_understood: the same request again may pass. An unknown number is not_understood as
/// well; but it refuses a write as read only.
AccessError error_of_ee(std::uint16_t ee, bool is_write);
std::string_view meaning_of_ee(std::uint16_t ee) noexcept;

} // namespace dpslave::drive::ei
