// SPDX-License-Identifier: Apache-2.0
#include "demand_run.hpp"

#include "dpsim/common/values.hpp"

#include <fmt/format.h>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

constexpr auto kDemandTime = 5s; ///< two retries of a silent drive take less
/// The first answer after a change may still be one to the telegram before.
constexpr std::uint64_t kCyclesToBeSent = 2;
constexpr std::size_t kMostValues = 16'384;
/// Values a line of an upload shows: a block of the program store.
constexpr std::size_t kValuesPerLine = 8;

constexpr std::string_view kDemandUsage =
    "write it as: demand read 55, demand write 56 1000, demand none (tags 0 to 2047), demand read-ext 8328, demand write-ext 8328 3, demand raw 8462 0 0 1, demand upload 8328 136 or demand download 8328";

std::optional<std::uint16_t> word_in(const std::vector<std::string>& words, std::size_t at,
                                     std::int64_t least, std::int64_t most)
{
    const auto number = number_at(words, at, least, most);
    return number ? std::optional{static_cast<std::uint16_t>(*number & 0xFFFF)} : std::nullopt;
}

std::optional<std::uint16_t> value_in(const std::vector<std::string>& words, std::size_t at)
{
    return word_in(words, at, -32768, 65535);
}

DemandRun::Step done(std::vector<std::string> lines = {})
{
    return {.lines = std::move(lines), .done = true};
}

DemandRun::Step failed(std::string_view why, int exit = arguments::kNo)
{
    return {.failure = std::string{why}, .exit = exit};
}

} // namespace

DemandRun::Step DemandRun::begin(const Words& words, Instant now)
{
    if (!has_demand(master_.settings()))
        return failed("Cfg_Data does not begin with 73: there is no Demand Data");
    if (words.size() == 1) return show();
    if (words[1] == "raw") return raw(words);
    if (words[1] == "upload" || words[1] == "download") return transfer(words, now);
    return order(words, now);
}

DemandRun::Step DemandRun::show() const
{
    std::vector<std::string> lines{"request " + show_registers(demand_outputs(master_))};
    if (const auto answer = demand_inputs(master_)) lines.push_back("answer  " + show_registers(*answer));
    return done(std::move(lines));
}

DemandRun::Step DemandRun::raw(const Words& words)
{
    DemandRegisters registers{};
    if (words.size() < 3 || words.size() > 6) return failed(kDemandUsage);
    for (std::size_t i = 2; i < words.size(); ++i) {
        const auto value = value_in(words, i);
        if (!value) return failed("a register is -32768 to 65535, or 0x0000 to 0xFFFF");
        registers[i - 2] = *value;
    }
    set_demand_outputs(master_, registers);
    return done();
}

DemandRun::Step DemandRun::order(const Words& words, Instant now)
{
    const bool extended = words[1].ends_with("-ext");
    const std::string name = extended ? words[1].substr(0, words[1].size() - 4) : words[1];
    const bool writes = name == "write";
    order_ = {};
    if (name == "read" || writes) {
        const auto tag = word_in(words, 2, 0, extended ? 65535 : 2047);
        const auto value = writes ? value_in(words, 3) : std::optional<std::uint16_t>{0};
        if (!tag || !value || words.size() != (writes ? 4U : 3U)) return failed(kDemandUsage);
        order_ = {extended ? (writes ? DemandCommand::extended_write : DemandCommand::extended_read)
                           : (writes ? DemandCommand::write : DemandCommand::read),
                  *tag, *value};
    } else if (words[1] != "none" || words.size() != 2) {
        return failed(kDemandUsage);
    }
    return ask(false, now);
}

/// One tag a request, the next as soon as it is answered.
DemandRun::Step DemandRun::transfer(const Words& words, Instant now)
{
    transfer_ = {.down = words[1] == "download"};
    const auto first = word_in(words, 2, 0, 65535);
    if (!first) return failed(kDemandUsage);
    transfer_.first = *first;
    if (transfer_.down) {
        if (words.size() > 3) block_.clear();
        for (std::size_t i = 3; i < words.size(); ++i) {
            const auto value = value_in(words, i);
            if (!value) return failed(fmt::format("'{}' is no value from -32768 to 65535", words[i]));
            block_.push_back(*value);
        }
        if (block_.empty()) return failed("nothing was uploaded yet, and no values are given");
        transfer_.count = block_.size();
    } else {
        const auto count = word_in(words, 3, 1, kMostValues);
        if (!count || words.size() != 4) return failed(kDemandUsage);
        transfer_.count = *count;
        block_.clear();
    }
    if (transfer_.first + transfer_.count > 0x10000) return failed("the last tag would be above 65535");
    order_ = next_of_block();
    return ask(true, now);
}

DemandRun::Step DemandRun::ask(bool is_block, Instant now)
{
    if (master_.state() != MasterState::data_exchange) return failed("the station is not in data exchange");
    set_demand_outputs(master_, {});
    phase_ = order_.command == DemandCommand::none ? Phase::none_only : Phase::none_first;
    until_ = now + kDemandTime;
    is_block_ = is_block;
    cycles_ = master_.counters().cycles;
    return {};
}

DemandRun::Step DemandRun::on_time(Instant now)
{
    const bool late = now >= until_;
    if (phase_ == Phase::none_only) {
        const Verdict verdict = judge({.subject = Condition::Subject::demand_none}, master_, {});
        if (verdict.holds) return done();
        return late ? failed("not in time, " + verdict.seen) : Step{};
    }
    if (phase_ == Phase::none_first) return after_none(late);
    const auto answer = demand_answer(master_);
    const bool ours = answer &&
                      (answer->command == DemandCommand::read || answer->command == DemandCommand::reject) &&
                      answer->tag == order_.tag;
    if (!ours) return late ? failed("no answer from the drive in time", arguments::kNoAnswer) : Step{};
    return phase_ == Phase::block ? after_value(*answer, now) : done({show_demand(*answer)});
}

DemandRun::Step DemandRun::after_none(bool late)
{
    const auto answer = demand_answer(master_);
    const bool was_sent = master_.counters().cycles >= cycles_ + kCyclesToBeSent;
    if (was_sent && answer && answer->command == DemandCommand::none) {
        set_demand_outputs(master_, registers_of(order_));
        phase_ = is_block_ ? Phase::block : Phase::order;
    } else if (late) {
        return failed("the slave does not answer 'no command'", arguments::kNoAnswer);
    }
    return {};
}

DemandRun::Step DemandRun::after_value(const DemandWords& answer, Instant now)
{
    if (answer.command == DemandCommand::reject)
        return failed(fmt::format("{} after {} values", show_demand(answer), transfer_.done),
                      arguments::kRefused);
    if (!transfer_.down) block_.push_back(answer.value);
    ++transfer_.done;
    Step step;
    if (!transfer_.down && (transfer_.done % kValuesPerLine == 0 || transfer_.done == transfer_.count))
        step.lines.push_back(block_line(transfer_.done));
    if (transfer_.done < transfer_.count) {
        order_ = next_of_block();
        until_ = now + kDemandTime;
        set_demand_outputs(master_, registers_of(order_));
        return step;
    }
    step.lines.push_back(fmt::format("{} values {}, tags {} to {}", transfer_.count,
                                     transfer_.down ? "downloaded" : "uploaded", transfer_.first,
                                     transfer_.first + transfer_.count - 1));
    step.done = true;
    return step;
}

DemandWords DemandRun::next_of_block() const
{
    const auto tag = static_cast<std::uint16_t>(transfer_.first + transfer_.done);
    if (transfer_.down) return {DemandCommand::extended_write, tag, block_[transfer_.done]};
    return {DemandCommand::extended_read, tag, 0};
}

/// The values of this line, up to `end`: "tag 8336 = 1 1000 100 0 1 0 0 0".
std::string DemandRun::block_line(std::size_t end) const
{
    const std::size_t begin = (end - 1) / kValuesPerLine * kValuesPerLine;
    std::string line = fmt::format("tag {} =", transfer_.first + begin);
    for (std::size_t i = begin; i < end; ++i)
        line += fmt::format(" {}", static_cast<std::int16_t>(block_[i]));
    return line;
}

} // namespace dpslave::sim
