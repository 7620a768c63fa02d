// SPDX-License-Identifier: Apache-2.0
#include "dpctl/tags/survey.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
using profile::SurveyAnswer;

constexpr auto kSaveEvery = 5s;     ///< what a loss of power may cost
constexpr auto kDrawEvery = 200ms;  ///< of the bar on a terminal
constexpr auto kSayEvery = 10s;     ///< of the lines elsewhere
constexpr auto kLongestRound = 60s; ///< a survey read waits for a round of the line
constexpr auto kWaitForDrive = 1s;
constexpr auto kWaitForOther = 200ms;

struct SurveyOptions {
    std::string station;
    std::vector<TagSpan> tags;                    ///< empty = all
    std::string output;                           ///< the table that it writes; empty = not said
    std::optional<std::chrono::nanoseconds> time; ///< repeats the passes
    std::uint32_t passes = 1;                     ///< how often each tag is asked
    std::string rule;                             ///< of the mnemonics; empty = that of the profile
    bool resume = false;                          ///< goes on with the record that is there
};

void set_up(CLI::App& app, SurveyOptions& options)
{
    add_station(app, options.station, "Name or address; required if there are several");
    add_tag_spans(app, options.tags, "Ask only for these tags: 1-600,1000-1127");
    add_output(app, options.output,
               "The tag table to write; an existing one is continued. Default: STATION.csv");
    auto* time = add_time(app, "--for", options.time, "Repeat the passes for this time", {1s, 30 * 24h});
    add_number(app, "--passes", options.passes, "Number of times to ask for each tag", {1, 1'000'000})
        ->default_str("1")
        ->excludes(time);
    add_choice(app, "--rule", options.rule, mnemonic_rules(),
               "Name tags by this rule, not by the profile's, and write each mnemonic into the table");
    app.add_flag("--resume", options.resume, "Continue where the last survey ended");
}

struct Scope {
    std::string station, protocol, tag_table;
    std::vector<TagSpan> tags;
};

Scope read_scope(const report::GetSurveyScopeReply& reply)
{
    Scope scope{reply.station, reply.protocol, reply.tag_table, {}};
    for (const report::TagSpan& span : reply.tags)
        scope.tags.push_back({static_cast<std::uint16_t>(span.first), static_cast<std::uint16_t>(span.last)});
    return scope;
}

/// How a survey came to its end.
enum class End {
    done,
    time_is_over,
    interrupted,
    no_drive, ///< it did not answer at all for long
    other,    ///< another survey of this station is under way
    failed,   ///< printed already
};

/// One survey, from its first read to its last.
class Run {
public:
    Run(const SurveyOptions& options, Session& session, Scope scope, SurveyFiles files)
        : options_(options),
          session_(session),
          terminal_(session.terminal()),
          scope_(std::move(scope)),
          files_(std::move(files)),
          plan_(scope_.tags, options.time ? 0 : options.passes),
          time_(options.time ? std::optional{std::chrono::ceil<std::chrono::seconds>(*options.time)}
                             : std::nullopt),
          patience_(time_)
    {}

    int go();

private:
    End read_all();
    std::optional<End> read_one(std::uint16_t tag);
    std::optional<End> wait_for(bool for_drive);
    bool take(const report::SurveyReply& reply, std::uint16_t tag);
    profile::Survey seen_in_scope() const;
    SurveyProgress progress() const;
    void say_progress(bool last);
    void save_now_and_then();
    int report(End end);

    const SurveyOptions& options_;
    Session& session_;
    Terminal& terminal_;
    Scope scope_;
    SurveyFiles files_;
    profile::SurveyPlan plan_;
    profile::SurveyPace pace_;
    std::optional<std::chrono::seconds> time_; ///< --for
    Clock::time_point began_ = Clock::now(), saved_ = began_, said_ = began_;
    profile::SurveyPatience patience_;
    bool waits_for_drive_ = false;
    std::string not_saved_; ///< why not, the last time
};

int Run::go()
{
    if (!session_.json()) {
        terminal_.out << fmt::format(
            "{}: {} to ask; rows go to {}, the record to {}. Ctrl-C ends it, --resume continues it.\n",
            scope_.station, plural(static_cast<std::int64_t>(plan_.tags()), "tag"), files_.table(),
            files_.record());
        if (files_.rows_taken_over() > 0)
            terminal_.out << fmt::format("{} begins with the {} of {}.\n", files_.table(),
                                         plural(static_cast<std::int64_t>(files_.rows_taken_over()), "tag"),
                                         scope_.tag_table);
        if (!files_.not_taken_over().empty())
            terminal_.out << fmt::format("{} begins without the rows of the table in use: {}\n",
                                         files_.table(), files_.not_taken_over());
        if (scope_.protocol == "modbus-rtu")
            terminal_.out
                << "Modbus shows 16 bits of each tag and no text: every row will be a WORD; type and decimals are in the manual only.\n";
        terminal_.out << std::flush;
    }
    session_.wait_longer(kLongestRound);
    return report(read_all());
}

End Run::read_all()
{
    for (;;) {
        if (patience_.is_time_over(Clock::now() - began_)) return End::time_is_over;
        const auto tag = plan_.next(files_.seen);
        if (!tag) return End::done;
        if (const auto ended = read_one(*tag)) return *ended;
        save_now_and_then();
        say_progress(false);
    }
}

/// Asks until there is an answer for this tag; nothing: there is.
std::optional<End> Run::read_one(std::uint16_t tag)
{
    for (;;) {
        const auto asked_at = Clock::now();
        Json question{{"station", scope_.station}, {"tag", tag}};
        if (!options_.rule.empty()) question["rule"] = options_.rule;
        const auto reply = session_.call("Survey", question);
        const auto& refused = reply ? std::nullopt : reply.error().refused;
        const bool is_busy = refused && refused->error == "org.dpslaved.Control.Busy";
        if (!reply && !refused && !reply.error().failed) return End::interrupted;
        if (!reply && !is_busy) {
            session_.print_stopped(reply.error());
            return End::failed;
        }
        if (!is_busy && take(report::read<report::SurveyReply>(*reply), tag)) {
            pace_.took(Clock::now() - asked_at);
            patience_.was_answered();
            waits_for_drive_ = false;
            return std::nullopt;
        }
        if (const auto ended = wait_for(!is_busy)) return ended;
    }
}

std::optional<End> Run::wait_for(bool for_drive)
{
    using Verdict = profile::SurveyPatience::Verdict;
    waits_for_drive_ = for_drive;
    say_progress(false);
    switch (patience_.waits(for_drive, Clock::now() - began_)) {
        case Verdict::wait: break;
        case Verdict::no_drive: return End::no_drive;
        case Verdict::other_survey: return End::other;
        case Verdict::time_is_over: return End::time_is_over;
    }
    if (session_.pause_until(Clock::now() + (for_drive ? kWaitForDrive : kWaitForOther)))
        return End::interrupted;
    return std::nullopt;
}

/// False: the drive does not answer at all, so nothing was learnt of this tag.
bool Run::take(const report::SurveyReply& reply, std::uint16_t tag)
{
    if (reply.outcome == "lost") return false;
    SurveyAnswer answer;
    if (reply.outcome == "value") {
        answer.kind = reply.raw ? SurveyAnswer::Kind::word : SurveyAnswer::Kind::text;
        answer.word = static_cast<std::uint16_t>(reply.raw.value_or(0));
        answer.text = reply.text.value_or("");
    } else if (reply.outcome == "denied") {
        answer.kind = SurveyAnswer::Kind::denied;
        answer.text = reply.reason.value_or("refused");
    }
    profile::Sighting& one = files_.seen[tag];
    one.mnemonic = reply.mnemonic.value_or("");
    one.add(answer);
    return true;
}

/// A record that is resumed may have others.
profile::Survey Run::seen_in_scope() const
{
    profile::Survey seen;
    for (const TagSpan span : scope_.tags)
        seen.insert(files_.seen.lower_bound(span.first), files_.seen.upper_bound(span.last));
    return seen;
}

SurveyProgress Run::progress() const
{
    SurveyProgress progress;
    const profile::Survey seen = seen_in_scope();
    progress.tags = plan_.tags();
    progress.visited = seen.size();
    progress.waits_for_drive = waits_for_drive_;
    std::size_t reads = 0;
    for (const auto& [tag, one] : seen) {
        reads += one.asked();
        ++(one.answers > 0 ? progress.answering : one.denials > 0 ? progress.denied : progress.silent);
    }
    if (time_) {
        const auto passed = Clock::now() - began_;
        progress.is_time_given = true;
        progress.left =
            std::chrono::ceil<std::chrono::seconds>(std::max<Clock::duration>(*time_ - passed, 0s));
        progress.share = std::chrono::duration<double>(passed) / std::chrono::duration<double>(*time_);
        return progress;
    }
    const std::size_t left = plan_.left(files_.seen);
    progress.left = pace_.time_for(left);
    progress.share = reads + left > 0 ? static_cast<double>(reads) / static_cast<double>(reads + left) : 1.0;
    return progress;
}

/// A bar on a terminal, elsewhere a line now and then.
void Run::say_progress(bool last)
{
    if (session_.json()) return;
    const auto now = Clock::now();
    const auto pause = terminal_.tty ? Clock::duration{kDrawEvery} : Clock::duration{kSayEvery};
    if (last ? !terminal_.tty : now < said_ + pause) return;
    said_ = now;
    if (last)
        terminal_.out << "\r\033[K";
    else if (terminal_.tty)
        terminal_.out << "\r\033[?7l" << progress_bar(progress()) << "\033[K\033[?7h";
    else
        terminal_.out << progress_line(progress()) << '\n';
    terminal_.out << std::flush;
}

/// What fails is tried again: the table may be saved meanwhile, or the disk have room again.
void Run::save_now_and_then()
{
    if (Clock::now() < saved_ + kSaveEvery) return;
    const std::string failed = files_.save().value_or("");
    saved_ = Clock::now();
    if (!failed.empty() && failed != not_saved_)
        terminal_.err << (terminal_.tty ? "\r\033[K" : "")
                      << fmt::format("dpctl: {}\nThe survey continues and tries again.\n", failed)
                      << std::flush;
    not_saved_ = failed;
}

int Run::report(End end)
{
    say_progress(true);
    if (const auto failed = files_.save()) {
        terminal_.err << fmt::format(
            "dpctl: {}\nRemove the cause, then continue with the same command and --resume: it asks again for what {} does not have.\n",
            *failed, files_.record());
        return kNo;
    }
    SurveyReport report{scope_.station, files_.table(), files_.record(), plan_.tags(), false, {},
                        files_.joined()};
    report.seen = seen_in_scope();
    const bool is_time_over = end == End::time_is_over || (end == End::no_drive && time_);
    report.complete = end == End::done || (is_time_over && report.seen.size() == report.tags);
    session_.print(survey_json(report), [&] { return render_survey(report); });
    if (end == End::no_drive)
        terminal_.err << fmt::format("dpctl: the drive of {} does not answer; see: dpctl doctor {}\n",
                                     scope_.station, scope_.station);
    if (end == End::other)
        terminal_.err << fmt::format("dpctl: another survey of {} is running: wait until it ends\n",
                                     scope_.station);
    if (!report.complete)
        terminal_.err << "dpctl: not every tag was asked; continue with the same command and --resume\n";
    return report.complete && report.joined.contradictions.empty() ? kFine : kNo;
}

/// A station may be called as no file can be.
std::string file_name(std::string station)
{
    std::replace(station.begin(), station.end(), '/', '_');
    return station + ".csv";
}

int run(const SurveyOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    Json question = station_parameter(options.station);
    if (!options.rule.empty()) question["rule"] = options.rule;
    const auto reply = session.ask("GetSurveyScope", question);
    if (!reply) return reply.error();
    session.catch_signals();
    Scope scope = read_scope(report::read<report::GetSurveyScopeReply>(*reply));
    if (!options.rule.empty() && scope.protocol == "modbus-rtu") {
        terminal.err << fmt::format("dpctl: {} speaks Modbus RTU, which has no mnemonics: leave out --rule\n",
                                    scope.station);
        return kUsage;
    }
    if (!options.tags.empty()) scope.tags = options.tags;
    if (scope.tags.empty()) {
        terminal.err << fmt::format(
            "dpctl: no rule of {} gives tags a mnemonic, and no row of {} has one: add rows with tag and mnemonic, or use --tags\n",
            scope.station, scope.tag_table);
        return kNo;
    }
    const bool is_by_rule = !options.rule.empty();
    auto files = SurveyFiles::open(is_by_rule ? scope.station + " by rule " + options.rule : scope.station,
                                   options.output.empty() ? file_name(scope.station) : options.output,
                                   scope.tag_table, options.resume,
                                   is_by_rule ? profile::MnemonicCells::fill : profile::MnemonicCells::keep);
    if (!files) {
        terminal.err << "dpctl: " << files.error() << '\n';
        return kNo;
    }
    return Run{options, session, std::move(scope), *std::move(files)}.go();
}

} // namespace

const Command kSurvey{
    "survey",
    kOperate,
    "Reads every tag of a drive and writes a tag table, whose rows you confirm (root and the operator group)",
    add<SurveyOptions>,
    kOwnForm,
    "dpctl survey unwinder                          every tag once, into unwinder.csv\n"
    "dpctl survey unwinder --resume                 continues after Ctrl-C\n"
    "dpctl survey unwinder --rule pno               by another rule of the mnemonics, see dpctl identify\n"
    "dpctl survey unwinder --tags 1-600 --for 10m   the extremes of ten minutes",
    "0 complete, 1 not complete"};

} // namespace dpslave::dpctl
