// SPDX-License-Identifier: Apache-2.0
#include "console.hpp"

#include "dpsim/common/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

constexpr auto kStartTime = 10s; ///< for the complete start-up, at 9600 and with retries
constexpr auto kAnswerTime = 5s;

double seconds(std::chrono::nanoseconds t)
{
    return std::chrono::duration<double>(t).count();
}

} // namespace

struct Console::Command {
    std::string_view name;
    std::string_view usage;
    std::string_view help;
    void (*run)(Console&, const Words&, Instant);

    template <void (Console::*method)(const Words&, Instant)>
    static void by(Console& console, const Words& words, Instant now)
    {
        (console.*method)(words, now);
    }

    static void set_mode(Console& console, const Words& words, Instant now)
    {
        console.master_.clear(words[0] == "clear");
        console.wait_ = {.what = For::answer, .until = now + kAnswerTime, .service = Service::global_control};
    }
};

const std::vector<Console::Command>& Console::commands()
{
    static const std::vector<Command> table{
        {"start", "start [TIME]", "start-up until Data_Exch (10s), else the reason",
         Command::by<&Console::do_start>},
        {"in", "in [N]", "the process input words", Command::by<&Console::do_in>},
        {"follow", "follow on|off", "prints each process input word that changes",
         Command::by<&Console::do_follow>},
        {"out", "out [N = VALUE]", "sets a process output word, or shows all", Command::by<&Console::do_out>},
        {"wait", "wait TIME [for CONDITION]", "waits for TIME, or until the condition holds",
         Command::by<&Console::do_wait>},
        {"expect", "expect CONDITION", "fails if the condition does not hold now",
         Command::by<&Console::do_expect>},
        {"demand", "demand read TAG | write TAG VALUE | none",
         "Demand Data, tags to 2047; waits for the answer", Command::by<&Console::do_demand>},
        {"", "demand read-ext TAG | write-ext TAG VALUE", "the same with the extended commands 3 and 4",
         nullptr},
        {"", "demand raw R1 [R2 R3 R4]", "sets the four registers as they are; does not wait", nullptr},
        {"", "demand upload TAG COUNT", "reads a block with command 3, one value a request, and keeps it",
         nullptr},
        {"", "demand download TAG [VALUE ...]",
         "writes these values with command 4; without values the block kept", nullptr},
        {"", "demand", "the four registers in both directions", nullptr},
        {"diag", "diag", "reads Slave_Diag and explains it",
         [](Console& c, const Words&, Instant now) {
             c.ask({Service::slave_diag, {}}, now);
         }},
        {"get-cfg", "get-cfg", "reads the configuration that the slave holds",
         [](Console& c, const Words&, Instant now) {
             c.ask({Service::get_cfg, {}}, now);
         }},
        {"sync", "sync | unsync | freeze | unfreeze [GROUPS]", "Global_Control; GROUPS is a mask, 0 = all",
         Command::by<&Console::do_global>},
        {"unsync", "", "", Command::by<&Console::do_global>},
        {"freeze", "", "", Command::by<&Console::do_global>},
        {"unfreeze", "", "", Command::by<&Console::do_global>},
        {"clear", "clear | operate", "Clear: zeros go out; Operate: the outputs again", Command::set_mode},
        {"operate", "", "", Command::set_mode},
        {"set-prm", "set-prm HEX", "Set_Prm with this whole data unit (7 octets and more)",
         Command::by<&Console::do_service>},
        {"chk-cfg", "chk-cfg HEX | none", "Chk_Cfg with these identifier octets",
         Command::by<&Console::do_service>},
        {"send", "send HEX", "sends these octets as they are and shows the answer",
         Command::by<&Console::do_service>},
        {"unlock", "unlock", "releases the slave (Set_Prm with Unlock_Req) and stops",
         Command::by<&Console::do_unlock>},
        {"run", "run [TIME]", "exchanges for this time; without TIME until the program ends",
         Command::by<&Console::do_run>},
        {"stop", "stop", "stops sending, without Unlock",
         [](Console& c, const Words&, Instant) { c.master_.stop(); }},
        {"stats", "stats", "counters",
         [](Console& c, const Words&, Instant) { c.say(in_words(c.master_.counters())); }},
        {"help", "help", "this list", [](Console& c, const Words&, Instant) { c.say(help()); }},
        {"quit", "quit", "ends", [](Console& c, const Words&, Instant) { c.quit_ = true; }},
    };
    return table;
}

std::vector<std::string> Console::help()
{
    std::vector<std::string> lines;
    for (const Command& c : commands())
        if (!c.usage.empty()) lines.push_back(fmt::format("  {:<44} {}", c.usage, c.help));
    lines.push_back(fmt::format("  {:<44} {}", "try COMMAND", "goes on even if the command fails"));
    lines.emplace_back(
        "TIME: 2s, 500ms, 5m; a number alone is seconds. VALUE: 1250, -300, 0x04E2. '#' begins a comment.");
    lines.emplace_back(
        "CONDITION: in N = V (also != < > <= >=), out N = V, in N & MASK = V, state [not] data-exchange,");
    lines.emplace_back(
        "  demand = V, demand reject E, demand none, demand reg 1..4 [& MASK] = V, diag [not] NAME, diag HEX, diag ext HEX,");
    lines.emplace_back(
        "  reply HEX, reply none. NAME: prm-fault cfg-fault not-ready prm-required stat-diag ext-diag not-supported");
    lines.emplace_back("  watchdog sync freeze overflow. diag ext is all that follows octet 6.");
    return lines;
}

void Console::command(const std::string& line, const std::string& place, Instant now)
{
    Words words = words_of(line);
    tries_ = !words.empty() && words[0] == "try";
    if (tries_) words.erase(words.begin());
    if (words.empty()) return;
    line_ = rest_of(words, 0);
    place_ = place;
    const bool joined = words[0].size() > 2 && words[0].starts_with("in") && read_number(words[0].substr(2));
    if (joined) words = {"in", words[0].substr(2)};
    const auto& table = commands();
    const auto found =
        std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == words[0]; });
    if (found == table.end()) return fail(fmt::format("there is no command '{}'; help lists them", words[0]));
    found->run(*this, words, now);
}

std::vector<std::string> Console::take_lines()
{
    return std::exchange(lines_, {});
}

void Console::say(std::vector<std::string> lines)
{
    std::move(lines.begin(), lines.end(), std::back_inserter(lines_));
}

void Console::stamp(Instant now, std::string_view words)
{
    say(fmt::format("{:9.3f} s  {}", seconds(now - began_), words));
}

void Console::fail(std::string_view why, int exit)
{
    wait_.reset();
    say(fmt::format("{}{}: {}", place_, line_, why));
    if (!tries_ && exit_ == arguments::kFine) exit_ = exit;
}

// ---- what the master reports ----

void Console::on_time(Instant now)
{
    while (const auto event = master_.take_event()) take(*event, now);
    if (follows_) say(changed_inputs(master_, followed_));
    if (wait_) check_wait(now);
}

void Console::take(const MasterEvent& event, Instant now)
{
    switch (event.kind) {
        case MasterEvent::Kind::state:
            if (event.words == text(MasterState::data_exchange)) stamp(now, "station is in data exchange");
            return;
        case MasterEvent::Kind::refused:
            stamp(now, event.words);
            if (wait_ && wait_->what == For::start) start_refused(event.words, arguments::kRefused);
            return;
        case MasterEvent::Kind::lost: stamp(now, event.words); return;
        case MasterEvent::Kind::violation: stamp(now, "not as the standard has it: " + event.words); return;
        case MasterEvent::Kind::diagnosis:
            stamp(now, "diagnosis");
            for (const std::string& line : explain(*master_.diagnosis())) say("  " + line);
            return;
        case MasterEvent::Kind::answer:
            if (!wait_ || wait_->what != For::answer || wait_->service != event.answer->service) return;
            last_reply_ = event.answer->octets;
            take_answer(*event.answer);
            return;
    }
}

void Console::take_answer(const Answer& answer)
{
    wait_.reset();
    if (answer.service == Service::global_control) return;
    if (answer.service == Service::raw)
        return say(answer.words + (answer.octets.empty() ? "" : ": " + hex(answer.octets)));
    if (!answer.frame)
        return fail(fmt::format("{} from station {}", answer.words, master_.settings().slave),
                    arguments::kNoAnswer);
    if (answer.service != Service::slave_diag || answer.frame->kind != FrameKind::variable)
        return say(answer.words);
    const auto diagnosis = parse_diagnosis(answer.frame->data);
    if (!diagnosis) return fail(diagnosis.error());
    say(explain(*diagnosis));
}

void Console::start_refused(const std::string& why, int exit)
{
    fail(why, exit);
    if (master_.diagnosis())
        for (const std::string& line : explain(*master_.diagnosis())) say("  " + line);
    master_.stop();
}

void Console::check_wait(Instant now)
{
    const bool late = now >= wait_->until;
    switch (wait_->what) {
        case For::start:
            if (master_.state() == MasterState::data_exchange && master_.counters().cycles > wait_->cycles)
                return wait_.reset();
            if (!late) return;
            if (master_.state() == MasterState::searching)
                return fail(
                    fmt::format(
                        "station {} does not answer: is it running, at this rate and address, on this line?",
                        master_.settings().slave),
                    arguments::kNoAnswer);
            return start_refused(
                fmt::format("not in data exchange yet, the state is {}", text(master_.state())),
                arguments::kNoAnswer);
        case For::answer:
            if (late) fail("no answer in time", arguments::kNoAnswer);
            return;
        case For::time:
            if (late) wait_.reset();
            return;
        case For::condition: {
            const Verdict verdict = judge(wait_->condition, master_, last_reply_);
            if (verdict.holds) return wait_.reset();
            if (late) fail("not in time, " + verdict.seen);
            return;
        }
        case For::demand: return take(demand_.on_time(now));
    }
}

void Console::ask(Order order, Instant now)
{
    wait_ = Wait{.what = For::answer, .until = now + kAnswerTime, .service = order.service};
    master_.order(std::move(order));
}

// ---- commands ----

void Console::do_start(const Words& words, Instant now)
{
    const auto time =
        words.size() > 1 ? read_duration(words[1]) : std::optional<std::chrono::nanoseconds>{kStartTime};
    if (!time || words.size() > 2) return fail("write it as: start, or start 5s");
    master_.start();
    wait_ = Wait{.what = For::start, .until = now + *time, .cycles = master_.counters().cycles};
}

void Console::do_wait(const Words& words, Instant now)
{
    const auto time = words.size() > 1 ? read_duration(words[1]) : std::nullopt;
    if (!time || (words.size() > 2 && words[2] != "for")) return fail("write it as: wait 2s for in 1 = 1250");
    if (words.size() == 2) {
        wait_ = Wait{.what = For::time, .until = now + *time};
        return;
    }
    const auto condition = parse_condition({words.begin() + 3, words.end()});
    if (!condition) return fail(condition.error());
    wait_ = Wait{.what = For::condition, .until = now + *time, .condition = *condition};
}

void Console::do_run(const Words& words, Instant now)
{
    const auto time = words.size() == 2 ? read_duration(words[1]) : std::nullopt;
    if (!time && words.size() > 1) return fail("write it as: run 2s");
    wait_ = Wait{.what = For::time, .until = time ? now + *time : kNever};
}

void Console::do_expect(const Words& words, Instant /*now*/)
{
    const auto condition = parse_condition({words.begin() + 1, words.end()});
    if (!condition) return fail(condition.error());
    const Verdict verdict = judge(*condition, master_, last_reply_);
    if (!verdict.holds) return fail(verdict.seen);
    say("as expected, " + verdict.seen);
}

void Console::do_in(const Words& words, Instant /*now*/)
{
    const auto count = static_cast<std::int64_t>(input_words(master_));
    const auto only = words.size() > 1 ? read_number(words[1], 0, count) : std::optional<std::int64_t>{0};
    if (!only) return fail(fmt::format("there are {} input words, counted from 1", count));
    if (master_.inputs().empty()) return say("no inputs at present: " + std::string{text(master_.state())});
    for (std::size_t n = 1; n <= input_words(master_); ++n)
        if (*only == 0 || static_cast<std::size_t>(*only) == n)
            say(fmt::format("in {} = {}", n, show_word(input_word(master_, n).value_or(0))));
    if (const auto demand = demand_answer(master_); demand && *only == 0)
        say("demand: " + show_demand(*demand));
}

void Console::do_follow(const Words& words, Instant /*now*/)
{
    const auto on = switch_at(words, 1);
    if (!on) return fail("write it as: follow on");
    follows_ = *on;
    followed_.clear();
}

void Console::do_out(const Words& words, Instant /*now*/)
{
    if (words.size() == 1) {
        for (std::size_t n = 1; n <= output_words(master_); ++n)
            say(fmt::format("out {} = {}", n, show_word(output_word(master_, n).value_or(0))));
        return;
    }
    const auto condition = parse_condition(words);
    if (!condition) return fail("write it as: out 1 = 500");
    if (condition->relation != "=" || condition->value < -32768 || condition->value > 65535)
        return fail("a word is -32768 to 65535, written as: out 1 = 500");
    if (!set_output_word(master_, condition->index, static_cast<std::uint16_t>(condition->value & 0xFFFF)))
        return fail(fmt::format("there are {} output words, counted from 1", output_words(master_)));
}

void Console::do_demand(const Words& words, Instant now)
{
    wait_ = Wait{.what = For::demand};
    take(demand_.begin(words, now));
}

void Console::take(DemandRun::Step step)
{
    say(std::move(step.lines));
    if (!step.failure.empty()) return fail(step.failure, step.exit);
    if (step.done) return wait_.reset();
    wait_->until = demand_.deadline();
}

void Console::do_global(const Words& words, Instant now)
{
    const auto groups = words.size() > 1 ? read_number(words[1], 0, 255) : std::optional<std::int64_t>{0};
    if (!groups) return fail("groups are a mask 0x00 to 0xFF, 0 = all");
    const std::uint8_t control = words[0] == "sync"     ? 0x20
                                 : words[0] == "unsync" ? 0x10
                                 : words[0] == "freeze" ? 0x08
                                                        : 0x04;
    ask({Service::global_control, {control, static_cast<std::uint8_t>(*groups)}}, now);
}

void Console::do_unlock(const Words& /*words*/, Instant now)
{
    master_.stop();
    Octets unit = set_prm_unit(master_.settings());
    unit.resize(7);
    unit[0] = 0x40;
    ask({Service::set_prm, std::move(unit)}, now);
}

void Console::do_service(const Words& words, Instant now)
{
    const bool is_none = words[0] == "chk-cfg" && words.size() == 2 && words[1] == "none";
    auto octets = is_none ? Octets{} : octets_of(rest_of(words, 1));
    if (!octets) return fail(octets.error());
    if ((octets->empty() && !is_none) || octets->size() > 244)
        return fail("1 to 244 octets in hexadecimal are needed");
    const Service service = words[0] == "send"      ? Service::raw
                            : words[0] == "set-prm" ? Service::set_prm
                                                    : Service::chk_cfg;
    ask({service, std::move(*octets)}, now);
}

} // namespace dpslave::sim
