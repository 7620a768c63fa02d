// SPDX-License-Identifier: Apache-2.0
/// One question on a Modbus line and what is heard until its wait is over: takes the echo away and lets
/// OwedAnswers say whose a frame is. It is pure.
#pragma once

#include "dpslave/drive/owed_answers.hpp"
#include "dpslave/modbus/modbus_client.hpp"

#include <string>
#include <vector>

namespace dpslave::modbus {

class ModbusClient::Exchange {
public:
    Exchange(ModbusPort& line, ClientSettings settings);

    /// `request` from the function code on. Returns true if answer() is that to this request and to no other,
    /// an exception included; else trouble() says why. Precondition: may_ask().
    bool ask(std::uint8_t unit, Bytes request);
    Bytes answer() const { return answer_; } ///< from the function code on
    const std::string& trouble() const { return trouble_; }

    /// Returns whether an answer to the request could be accepted. `gave_data`: the unit gave data before;
    /// else it may refuse, and no answer of this function may be owed, because an exception does not show
    /// which of two it answers.
    bool may_ask(std::uint8_t unit, Bytes request, bool gave_data);
    /// Judges what has come since the last question.
    void listen() { fall_silent(); }
    /// Returns whether anything came from the unit that was asked last.
    bool heard_unit() const { return heard_unit_; }
    bool has_sent() const { return has_sent_; } ///< the last question got on the line
    drive::AnswerCounts counts(std::uint8_t unit) const { return owed_.counts(unit); }

private:
    enum class Echo : std::uint8_t { unknown, heard, none };

    drive::Question question_of(std::uint8_t unit, Bytes request) const;
    bool differs_from_echo(Bytes request) const;
    bool fall_silent();
    bool wait(Bytes request, Instant until);
    bool take_frame(Bytes request);
    bool refuse_early();
    void note_valid(Bytes frame, bool answers_something = false);
    bool take_echo(Bytes request, Bytes frame);
    drive::OwedAnswers::Verdict judge(Bytes request, Bytes frame);
    void note(drive::Judgement judgement);
    bool broken();
    std::chrono::nanoseconds duration_of(std::size_t count) const;
    std::chrono::nanoseconds pause() const;

    ModbusPort& line_;
    ClientSettings settings_;
    drive::OwedAnswers owed_;
    Echo echo_;
    drive::FrameNotes notes_;
    bool echo_due_ = false; ///< of the request under way
    std::uint8_t unit_ = 0; ///< asked last
    bool heard_unit_ = false;
    bool has_sent_ = false;
    Instant heard_at_{};
    std::vector<std::uint8_t> answer_;
    std::string trouble_;
};

} // namespace dpslave::modbus
