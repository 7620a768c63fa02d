// SPDX-License-Identifier: Apache-2.0
/// Answers what `wait ... for` and `expect` can ask of the master.
#pragma once

#include "demand.hpp"

namespace dpslave::sim {

/// Process words, counted from 1; nothing if there is none of this number.
std::optional<std::uint16_t> input_word(const Master& master, std::size_t number);
std::optional<std::uint16_t> output_word(Master& master, std::size_t number);
bool set_output_word(Master& master, std::size_t number, std::uint16_t word);
std::size_t input_words(const Master& master);
/// A line for each input word that is another one than in `seen`, which is brought up to date. Asked after
/// each turn of the master, no word that was on the bus is missed.
std::vector<std::string> changed_inputs(const Master& master,
                                        std::vector<std::optional<std::uint16_t>>& seen);
std::size_t output_words(const Master& master);

struct Condition {
    enum class Subject : std::uint8_t {
        input,
        output,
        state,
        demand_value,
        demand_reject,
        demand_none,
        demand_register,
        diagnosis,
        extended_diagnosis,
        reply
    };
    Subject subject = Subject::input;
    std::size_t index = 0;       ///< word or register, from 1
    std::uint16_t mask = 0xFFFF; ///< "& 0x1000": what of the word counts
    std::string relation{"="};   ///< = != < > <= >=
    std::int64_t value = 0;
    bool negated = false; ///< "not"
    MasterState state = MasterState::stopped;
    std::string name{}; ///< of a finding in the diagnosis
    Octets octets{};    ///< of a diagnosis (beginning), of its extended part, or of the last reply; empty
                        ///< reply = none
};

/// "in 1 = 1250", "in 2 & 0x1000 = 0", "state data-exchange", "state not stopped", "demand reject 1",
/// "demand = 5", "demand none", "demand reg 1 = 4366", "diag cfg-fault", "diag not prm-fault", "diag 00 0C 00
/// 02", "diag ext 03 40 30", "reply E5", "reply none".
Result<Condition, std::string> parse_condition(const std::vector<std::string>& words);

struct Verdict {
    bool holds = false;
    std::string seen; ///< a sentence: what is there instead
};
/// `last_reply`: octets heard after the last order of the script.
Verdict judge(const Condition& condition, Master& master, Bytes last_reply);

} // namespace dpslave::sim
