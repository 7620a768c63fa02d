// SPDX-License-Identifier: Apache-2.0
/// What `wait ... for` and `expect` can ask of the master, and how Demand Data is read from its image.
#pragma once

#include "dpsim/master.hpp"

namespace dpslave::sim {

/// Demand Data: the first eight octets in both directions, if Cfg_Data begins with 73h (HA389815 chapter 7).
struct DemandWords {
    std::uint8_t command = 0; ///< bits 15..12 of the first word: 0 none, 1 read or done, 2 write, 7 reject
    std::uint16_t tag = 0;    ///< bits 10..0
    std::uint16_t value = 0;  ///< octets 6 and 7: value, or error code with command 7
};
bool has_demand(const MasterSettings& settings);
std::optional<DemandWords>
demand_answer(const Master& master); ///< nothing before the first answer, or without Demand Data
DemandWords demand_request(Master& master);
void set_demand_request(Master& master, DemandWords words);
std::string show_demand(const DemandWords& answer);

/// Process words, counted from 1; nothing if there is none of this number.
std::optional<std::uint16_t> input_word(const Master& master, std::size_t number);
std::optional<std::uint16_t> output_word(Master& master, std::size_t number);
bool set_output_word(Master& master, std::size_t number, std::uint16_t word);
std::size_t input_words(const Master& master);
std::size_t output_words(const Master& master);

struct Condition {
    enum class Subject : std::uint8_t {
        input,
        output,
        state,
        demand_value,
        demand_reject,
        demand_none,
        diagnosis,
        reply
    };
    Subject subject = Subject::input;
    std::size_t index = 0;     ///< word, from 1
    std::string relation{"="}; ///< = != < > <= >=
    std::int64_t value = 0;
    bool negated = false; ///< "not"
    MasterState state = MasterState::stopped;
    std::string name{}; ///< of a finding in the diagnosis
    Octets octets{};    ///< of a diagnosis (beginning) or of the last reply; empty reply = none
};

/// "in 1 = 1250", "state data-exchange", "state not stopped", "demand reject 1", "demand = 5", "demand none",
/// "diag cfg-fault", "diag not prm-fault", "diag 00 0C 00 02", "reply E5", "reply none".
Result<Condition, std::string> parse_condition(const std::vector<std::string>& words);

struct Verdict {
    bool holds = false;
    std::string seen; ///< a sentence: what is there instead
};
/// `last_reply`: octets heard after the last order of the script.
Verdict judge(const Condition& condition, Master& master, Bytes last_reply);

} // namespace dpslave::sim
