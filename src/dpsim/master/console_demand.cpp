// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"
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

constexpr std::string_view kUsage =
    "write it as: demand read 55, demand write 56 1000, demand none (tags 0 to 2047), demand read-ext 8328, "
    "demand "
    "write-ext 8328 3, demand raw 8462 0 0 1, demand upload 8328 136 or demand download 8328";

std::optional<std::uint16_t> word_in(const std::vector<std::string>& words, std::size_t at,
                                     std::int64_t least, std::int64_t most)
{
    const auto number = at < words.size() ? number_of(words[at]) : std::nullopt;
    if (!number || *number < least || *number > most) return std::nullopt;
    return static_cast<std::uint16_t>(*number & 0xFFFF);
}

std::optional<std::uint16_t> value_in(const std::vector<std::string>& words, std::size_t at)
{
    return word_in(words, at, -32768, 65535);
}

} // namespace

void Console::do_demand(const Words& words, Instant now)
{
    if (!has_demand(master_.settings()))
        return fail("Cfg_Data does not begin with 73: there is no Demand Data");
    if (words.size() == 1) return show_demand_registers();
    if (words[1] == "raw") return demand_raw(words);
    if (words[1] == "upload" || words[1] == "download") return demand_transfer(words, now);
    demand_order(words, now);
}

void Console::show_demand_registers()
{
    say("request " + show_registers(demand_outputs(master_)));
    if (const auto answer = demand_inputs(master_)) say("answer  " + show_registers(*answer));
}

void Console::demand_raw(const Words& words)
{
    DemandRegisters registers{};
    if (words.size() < 3 || words.size() > 6) return fail(kUsage);
    for (std::size_t i = 2; i < words.size(); ++i) {
        const auto value = value_in(words, i);
        if (!value) return fail("a register is -32768 to 65535, or 0x0000 to 0xFFFF");
        registers[i - 2] = *value;
    }
    set_demand_outputs(master_, registers);
}

void Console::demand_order(const Words& words, Instant now)
{
    const bool extended = words[1].ends_with("-ext");
    const std::string name = extended ? words[1].substr(0, words[1].size() - 4) : words[1];
    const bool writes = name == "write";
    DemandWords order;
    if (name == "read" || writes) {
        const auto tag = word_in(words, 2, 0, extended ? 65535 : 2047);
        const auto value = writes ? value_in(words, 3) : std::optional<std::uint16_t>{0};
        if (!tag || !value || words.size() != (writes ? 4U : 3U)) return fail(kUsage);
        order = {extended ? (writes ? DemandCommand::extended_write : DemandCommand::extended_read)
                          : (writes ? DemandCommand::write : DemandCommand::read),
                 *tag, *value};
    } else if (words[1] != "none" || words.size() != 2) {
        return fail(kUsage);
    }
    if (master_.state() != MasterState::data_exchange) return fail("the station is not in data exchange");
    // Command 0 first: the answer to it separates the old answer from the new one, even with the same tag.
    set_demand_outputs(master_, {});
    const Instant until = now + kDemandTime;
    if (order.command != DemandCommand::none)
        return await(
            {.what = For::demand_idle, .until = until, .demand = order, .cycles = master_.counters().cycles});
    await(
        {.what = For::condition, .until = until, .condition = {.subject = Condition::Subject::demand_none}});
}

// ---- a block: command 0 once, then one tag a request, the next as soon as it is answered ----

void Console::demand_transfer(const Words& words, Instant now)
{
    transfer_ = {.down = words[1] == "download"};
    const auto first = word_in(words, 2, 0, 65535);
    if (!first) return fail(kUsage);
    transfer_.first = *first;
    if (transfer_.down) {
        if (words.size() > 3) block_.clear();
        for (std::size_t i = 3; i < words.size(); ++i) {
            const auto value = value_in(words, i);
            if (!value) return fail(fmt::format("'{}' is no value from -32768 to 65535", words[i]));
            block_.push_back(*value);
        }
        if (block_.empty()) return fail("nothing was uploaded yet, and no values are given");
        transfer_.count = block_.size();
    } else {
        const auto count = word_in(words, 3, 1, kMostValues);
        if (!count || words.size() != 4) return fail(kUsage);
        transfer_.count = *count;
        block_.clear();
    }
    if (transfer_.first + transfer_.count > 0x10000) return fail("the last tag would be above 65535");
    if (master_.state() != MasterState::data_exchange) return fail("the station is not in data exchange");
    set_demand_outputs(master_, {});
    await({.what = For::demand_idle,
           .until = now + kDemandTime,
           .demand = transfer_order(),
           .is_block = true,
           .cycles = master_.counters().cycles});
}

DemandWords Console::transfer_order() const
{
    const auto tag = static_cast<std::uint16_t>(transfer_.first + transfer_.done);
    if (transfer_.down) return {DemandCommand::extended_write, tag, block_[transfer_.done]};
    return {DemandCommand::extended_read, tag, 0};
}

void Console::check_demand(Instant now)
{
    const bool late = now >= wait_->until;
    const auto answer = demand_answer(master_);
    if (wait_->what == For::demand_idle) {
        const bool was_sent = master_.counters().cycles >= wait_->cycles + kCyclesToBeSent;
        if (was_sent && answer && answer->command == DemandCommand::none) {
            set_demand_outputs(master_, registers_of(wait_->demand));
            wait_->what = wait_->is_block ? For::demand_block : For::demand_answer;
        } else if (late) {
            fail("the slave does not answer 'no command'");
        }
        return;
    }
    const bool ours = answer &&
                      (answer->command == DemandCommand::read || answer->command == DemandCommand::reject) &&
                      answer->tag == wait_->demand.tag;
    if (!ours) {
        if (late) fail("no answer from the drive in time");
        return;
    }
    if (wait_->what == For::demand_block) return check_transfer(*answer, now);
    say(show_demand(*answer));
    done();
}

void Console::check_transfer(const DemandWords& answer, Instant now)
{
    if (answer.command == DemandCommand::reject)
        return fail(fmt::format("{} after {} values", show_demand(answer), transfer_.done));
    if (!transfer_.down) block_.push_back(answer.value);
    ++transfer_.done;
    if (!transfer_.down && (transfer_.done % kValuesPerLine == 0 || transfer_.done == transfer_.count))
        say_block_line(transfer_.done);
    if (transfer_.done < transfer_.count) {
        wait_->demand = transfer_order();
        wait_->until = now + kDemandTime;
        return set_demand_outputs(master_, registers_of(wait_->demand));
    }
    say(fmt::format("{} values {}, tags {} to {}", transfer_.count,
                    transfer_.down ? "downloaded" : "uploaded", transfer_.first,
                    transfer_.first + transfer_.count - 1));
    done();
}

/// The values of this line, up to `end`: "tag 8336 = 1 1000 100 0 1 0 0 0".
void Console::say_block_line(std::size_t end)
{
    const std::size_t begin = (end - 1) / kValuesPerLine * kValuesPerLine;
    std::string line = fmt::format("tag {} =", transfer_.first + begin);
    for (std::size_t i = begin; i < end; ++i)
        line += fmt::format(" {}", static_cast<std::int16_t>(block_[i]));
    say(std::move(line));
}

} // namespace dpslave::sim
