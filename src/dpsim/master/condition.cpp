// SPDX-License-Identifier: Apache-2.0
#include "condition.hpp"

#include "dpsim/common/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace dpslave::sim {
namespace {

using Words = std::vector<std::string>;

bool is_relation(std::string_view word)
{
    constexpr std::array<std::string_view, 7> kRelations{"=", "==", "!=", "<", ">", "<=", ">="};
    return std::find(kRelations.begin(), kRelations.end(), word) != kRelations.end();
}

/// Signed order; equality also holds for the unsigned reading of the same 16 bits.
bool relates(std::uint16_t word, std::string_view relation, std::int64_t value)
{
    const std::int64_t is = static_cast<std::int16_t>(word);
    const bool equal = is == value || std::int64_t{word} == value;
    if (relation == "=" || relation == "==") return equal;
    if (relation == "!=") return !equal;
    const std::int64_t left = value > 32767 ? std::int64_t{word} : is;
    if (relation == "<") return left < value;
    if (relation == ">") return left > value;
    return relation == "<=" ? left <= value : left >= value;
}

/// "in1=5" as "in", "1", "=", "5": blanks are optional.
Words separated(const Words& words)
{
    const auto kind = [](char c) {
        if (c == '=' || c == '<' || c == '>' || c == '!') return 1;
        return c == '&' ? 2 : 0;
    };
    Words out;
    for (const std::string& word : words) {
        std::string part;
        for (const char c : word) {
            if (!part.empty() && kind(part.back()) != kind(c)) {
                out.push_back(part);
                part.clear();
            }
            part += c;
        }
        if (!part.empty()) out.push_back(part);
    }
    if (!out.empty())
        for (const std::string_view subject : {"in", "out"})
            if (out[0].starts_with(subject) && out[0].size() > subject.size() &&
                std::isdigit(static_cast<unsigned char>(out[0][subject.size()])) != 0) {
                const std::string index = out[0].substr(subject.size());
                out[0] = subject;
                out.insert(out.begin() + 1, index);
            }
    return out;
}

/// "& MASK" at this place goes from the words into the condition; false if it is no mask.
bool take_mask(Words& w, std::size_t at, Condition& c)
{
    if (w.size() <= at || w[at] != "&") return true;
    const auto mask = number_at(w, at + 1, 1, 0xFFFF);
    if (!mask) return false;
    c.mask = static_cast<std::uint16_t>(*mask);
    w.erase(w.begin() + static_cast<std::ptrdiff_t>(at), w.begin() + static_cast<std::ptrdiff_t>(at) + 2);
    return true;
}

Result<Condition, std::string> word_condition(Words w)
{
    Condition c{.subject = w[0] == "in" ? Condition::Subject::input : Condition::Subject::output};
    const bool masked = take_mask(w, 2, c);
    const auto index = number_at(w, 1, 1, INT64_MAX);
    const auto value = w.size() == 4 ? read_number(w[3]) : std::nullopt;
    if (!masked || !index || !value || !is_relation(w[2]))
        return Failure{fmt::format("write it as: {0} 1 = 1250 (or != < > <= >=), {0} 1 & 0x1000 = 0", w[0])};
    c.index = static_cast<std::size_t>(*index);
    c.relation = w[2];
    c.value = *value;
    return c;
}

Result<Condition, std::string> demand_condition(Words w)
{
    Condition c{.subject = Condition::Subject::demand_none};
    if (w.size() == 2 && w[1] == "none") return c;
    const Failure help{
        std::string{"write it as: demand = 1250, demand reject 1, demand none or demand reg 1 = 4366"}};
    std::size_t at = 1;
    if (w.size() > 2 && w[1] == "reg") {
        const auto index = number_at(w, 2, 1, 4);
        if (!index) return help;
        c.subject = Condition::Subject::demand_register;
        c.index = static_cast<std::size_t>(*index);
        at = 3;
    } else if (w.size() == 3 && w[1] == "reject") {
        c.subject = Condition::Subject::demand_reject;
    } else {
        c.subject = Condition::Subject::demand_value;
    }
    if (c.subject != Condition::Subject::demand_reject) {
        if (!take_mask(w, at, c) || w.size() <= at || !is_relation(w[at])) return help;
        c.relation = w[at];
    }
    const auto value = w.size() == at + 2 ? read_number(w[at + 1]) : std::nullopt;
    if (!value) return help;
    c.value = *value;
    return c;
}

Result<Condition, std::string> octets_condition(Condition c, Words w)
{
    std::string text;
    const std::size_t first = c.subject == Condition::Subject::extended_diagnosis ? 2 : 1;
    for (std::size_t i = first; i < w.size(); ++i) text += w[i];
    auto octets = octets_of(text);
    if (!octets || octets->empty())
        return Failure{fmt::format("'{}' is neither a known finding nor octets in hexadecimal", text)};
    c.octets = std::move(*octets);
    return c;
}

Verdict judge_word(const Condition& c, std::string_view name, std::optional<std::uint16_t> word, bool any)
{
    if (!word)
        return {false, any ? fmt::format("there is no {} {}", name, c.index)
                           : std::string{"there are no inputs at present"}};
    return {relates(static_cast<std::uint16_t>(*word & c.mask), c.relation, c.value),
            fmt::format("{} {} is {}", name, c.index, show_word(*word))};
}

Verdict judge_register(const Condition& c, const Master& master)
{
    const auto registers = demand_inputs(master);
    if (!registers) return {false, "there is no Demand Data answer"};
    return {relates(static_cast<std::uint16_t>((*registers)[c.index - 1] & c.mask), c.relation, c.value),
            "the Demand Data registers are " + show_registers(*registers)};
}

Verdict judge_demand(const Condition& c, Master& master)
{
    const auto answer = demand_answer(master);
    if (!answer) return {false, "there is no Demand Data answer"};
    const std::string seen = "Demand Data answers " + show_demand(*answer);
    switch (c.subject) {
        case Condition::Subject::demand_none: return {answer->command == DemandCommand::none, seen};
        case Condition::Subject::demand_reject:
            return {answer->command == DemandCommand::reject && answer->value == c.value, seen};
        default:
            return {answer->command == DemandCommand::read &&
                        relates(static_cast<std::uint16_t>(answer->value & c.mask), c.relation, c.value),
                    seen};
    }
}

Verdict judge_diagnosis(const Condition& c, const Master& master)
{
    if (!master.diagnosis()) return {false, "no diagnosis was read yet"};
    const Diagnosis& d = *master.diagnosis();
    const std::string seen = "the diagnosis is " + hex(d.octets);
    if (!c.name.empty()) return {finding(d, c.name).value_or(false) != c.negated, seen};
    if (c.subject == Condition::Subject::extended_diagnosis)
        return {std::equal(c.octets.begin(), c.octets.end(), d.octets.begin() + 6, d.octets.end()), seen};
    return {d.octets.size() >= c.octets.size() &&
                std::equal(c.octets.begin(), c.octets.end(), d.octets.begin()),
            seen};
}

} // namespace

std::size_t input_words(const Master& m)
{
    return (m.lengths().inputs - demand_octets(m.settings())) / 2;
}
std::size_t output_words(const Master& m)
{
    return (m.lengths().outputs - demand_octets(m.settings())) / 2;
}

std::optional<std::uint16_t> input_word(const Master& master, std::size_t number)
{
    const std::size_t at = demand_octets(master.settings()) + 2 * (number - 1);
    if (number < 1 || number > input_words(master) || at + 2 > master.inputs().size()) return std::nullopt;
    return be16(master.inputs(), at);
}

std::optional<std::uint16_t> output_word(Master& master, std::size_t number)
{
    if (number < 1 || number > output_words(master)) return std::nullopt;
    return be16(master.outputs(), demand_octets(master.settings()) + 2 * (number - 1));
}

std::vector<std::string> changed_inputs(const Master& master, std::vector<std::optional<std::uint16_t>>& seen)
{
    std::vector<std::string> lines;
    seen.resize(input_words(master));
    for (std::size_t n = 1; n <= seen.size(); ++n) {
        const auto word = input_word(master, n);
        if (!word || seen[n - 1] == word) continue;
        seen[n - 1] = word;
        lines.push_back(fmt::format("in {} is {}", n, show_word(*word)));
    }
    return lines;
}

bool set_output_word(Master& master, std::size_t number, std::uint16_t word)
{
    if (number < 1 || number > output_words(master)) return false;
    const std::size_t at = demand_octets(master.settings()) + 2 * (number - 1);
    master.outputs()[at] = high(word);
    master.outputs()[at + 1] = low(word);
    return true;
}

Result<Condition, std::string> parse_condition(const std::vector<std::string>& words)
{
    Words w = separated(words);
    if (w.empty()) return Failure{std::string{"a condition is missing, for example: in 1 = 1250"}};
    if (w[0] == "in" || w[0] == "out") return word_condition(w);
    if (w[0] == "demand") return demand_condition(w);
    const bool negated = w.size() > 1 && w[1] == "not";
    if (negated) w.erase(w.begin() + 1);
    if (w[0] == "state" && w.size() == 2) {
        const auto state = master_state(w[1]);
        if (!state)
            return Failure{
                fmt::format("there is no state '{}'; the one that matters is data-exchange", w[1])};
        return Condition{.subject = Condition::Subject::state, .negated = negated, .state = *state};
    }
    if (w[0] == "diag" && w.size() >= 2) {
        Condition c{.subject = Condition::Subject::diagnosis, .negated = negated};
        if (w[1] == "ext") {
            c.subject = Condition::Subject::extended_diagnosis;
            return octets_condition(std::move(c), w);
        }
        if (!finding(Diagnosis{Octets(6, 0)}, w[1])) return octets_condition(std::move(c), w);
        c.name = w[1];
        return c;
    }
    if (w[0] == "reply" && w.size() >= 2) {
        Condition c{.subject = Condition::Subject::reply};
        if (w[1] == "none") return c;
        return octets_condition(std::move(c), w);
    }
    return Failure{fmt::format("'{}' is no condition: in N, out N, state, demand, diag or reply", w[0])};
}

Verdict judge(const Condition& c, Master& master, Bytes last_reply)
{
    switch (c.subject) {
        case Condition::Subject::input:
            return judge_word(c, "in", input_word(master, c.index),
                              c.index > input_words(master) || !master.inputs().empty());
        case Condition::Subject::output: return judge_word(c, "out", output_word(master, c.index), true);
        case Condition::Subject::state:
            return {(master.state() == c.state) != c.negated,
                    fmt::format("the state is {}", text(master.state()))};
        case Condition::Subject::demand_value:
        case Condition::Subject::demand_reject:
        case Condition::Subject::demand_none: return judge_demand(c, master);
        case Condition::Subject::demand_register: return judge_register(c, master);
        case Condition::Subject::diagnosis:
        case Condition::Subject::extended_diagnosis: return judge_diagnosis(c, master);
        case Condition::Subject::reply: break;
    }
    return {std::equal(c.octets.begin(), c.octets.end(), last_reply.begin(), last_reply.end()),
            last_reply.empty() ? std::string{"there was no reply"} : "the reply was " + hex(last_reply)};
}

} // namespace dpslave::sim
