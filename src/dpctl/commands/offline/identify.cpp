// SPDX-License-Identifier: Apache-2.0
// A search over a serial port, without a daemon.
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/end_signals.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/identify/identify_port.hpp"
#include "dpctl/identify/identify_report.hpp"

#include "dpslave/drive/line_search.hpp"
#include "dpslave/drive/line_setting.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/io/port_settings.hpp"
#include "dpslave/profile/survey.hpp"
#include "dpslave/report/answering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace dpslave::dpctl {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
using drive::LineProtocol;

constexpr auto kDrawProgressEvery = 200ms; ///< on a terminal
constexpr auto kSayProgressEvery = 10s;    ///< elsewhere
constexpr drive::SearchLimits kLimits{.units = 16, .trials = 2};

/// What narrows the search, as typed and judged; empty = all that is usual. And who switches the transceiver.
struct IdentifyOptions : ProfilesOption {
    std::string port;
    std::vector<std::string> bauds, formats, units, protocols, rules;
    std::vector<TagSpan> tags;
    std::string table;                        ///< a CSV file
    std::chrono::nanoseconds timeout = 200ms; ///< how long an answer may take to begin
    std::string direction = "none", gpio_chip;
    unsigned gpio_line = 0;
    bool gpio_active_low = false;
};

std::string format_fault(const std::string& text)
{
    return drive::format_of(text)
               ? std::string{}
               : input::in_quotes(text) +
                     ": write data bits 7 or 8, parity N, E or O, stop bits 1 or 2, as in 7E1";
}

std::string unit_fault(const std::string& text)
{
    const bool is_one = drive::unit_of(drive::LineProtocol::ei_ascii, text) ||
                        drive::unit_of(drive::LineProtocol::modbus_rtu, text);
    return is_one
               ? std::string{}
               : input::in_quotes(text) +
                     ": write two hexadecimal digits, group and unit id of EI-ASCII, as in 00, or an address of Modbus from 1 to 247";
}

void scope_options(CLI::App& app, IdentifyOptions& options)
{
    constexpr arguments::RateLimits kRates{300, 921'600}; // as baud of a [[line]]
    constexpr auto kBlanks = Between::commas_and_blanks;
    add_list(app, "--baud", options.bauds, "LIST", "Only these rates, in bit/s", kBlanks,
             arguments::rate_judge(kRates));
    add_list(app, "--format", options.formats, "LIST",
             "Only these formats, as 7E1. Modbus RTU has 8 data bits", kBlanks, format_fault);
    add_list(
        app, "--unit", options.units, "LIST",
        "Only these units: group and unit id of EI-ASCII, as 00, or an address of Modbus, as 1; 10 is both",
        kBlanks, unit_fault);
    add_list(app, "--protocol", options.protocols, "ei-ascii|modbus-rtu", "Only this protocol", kBlanks,
             arguments::choice_judge({"ei-ascii", "modbus-rtu"}));
    add_list(app, "--rule", options.rules, "590plus|ac|pno|none",
             "Only these rules of the mnemonics; none: those of the table itself", kBlanks,
             arguments::choice_judge(mnemonic_rules()));
}

void transceiver_options(CLI::App& app, IdentifyOptions& options)
{
    add_choice(app, "--direction", options.direction, {"none", "gpio", "kernel", "rts"},
               "Who switches the transceiver to sending, as in [[line]]");
    add_text(app, "--gpio-chip", options.gpio_chip, "CHIP",
             "With --direction gpio: the chip, by its device or label");
    add_number(app, "--gpio-line", options.gpio_line, "With --direction gpio: the line on it", {0, 65535});
    app.add_flag("--gpio-active-low", options.gpio_active_low,
                 "With --direction gpio, kernel or rts: the line is low while sending");
    app.parse_complete_callback([&app, &options] {
        const bool by_gpio = options.direction == "gpio";
        const bool has_chip = app.count("--gpio-chip") > 0, has_line = app.count("--gpio-line") > 0;
        if (by_gpio && !(has_chip && has_line))
            throw CLI::ValidationError{"--direction gpio needs --gpio-chip and --gpio-line"};
        if (!by_gpio && (has_chip || has_line))
            throw CLI::ValidationError{"--gpio-chip and --gpio-line belong to --direction gpio"};
        if (options.gpio_active_low && options.direction == "none")
            throw CLI::ValidationError{"--gpio-active-low belongs to --direction gpio, kernel or rts"};
    });
}

void set_up(CLI::App& app, IdentifyOptions& options)
{
    add_text(app, "PORT", options.port, "", "The tty, as /dev/ttyUSB0")->required();
    scope_options(app, options);
    add_tag_spans(app, options.tags, "Ask for these tags: 1-20,288. Default: 24 that tell the rules apart");
    add_text(app, "--table", options.table, "FILE",
             "Ask for the tags of this tag table; with --tags only for those");
    add_profiles(app, options, "Folder of the device profiles");
    add_time(app, "--timeout", options.timeout, "How long an answer may take to begin", {10ms, 10s});
    transceiver_options(app, options);
}

std::chrono::milliseconds timeout_of(const IdentifyOptions& options)
{
    return std::chrono::ceil<std::chrono::milliseconds>(options.timeout);
}

io::DriverEnableSettings driver_of(const IdentifyOptions& options)
{
    using io::Direction;
    io::DriverEnableSettings driver;
    for (const Direction one : {Direction::gpio, Direction::kernel, Direction::rts})
        if (io::text(one) == options.direction) driver.direction = one;
    driver.gpio_chip = options.gpio_chip;
    driver.gpio_line = options.gpio_line;
    driver.active_low = options.gpio_active_low;
    return driver;
}

/// Each once: what was typed twice is not asked twice.
template <class T>
void add_once(std::vector<T>& all, const T& one)
{
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
}

/// The error is a sentence: nothing is left to be asked.
Result<drive::SearchScope, std::string> scope_of(const IdentifyOptions& options)
{
    drive::SearchScope scope;
    for (const std::string& text : options.bauds)
        if (const auto baud = read_rate(text)) add_once(scope.bauds, *baud);
    for (const std::string& format : options.formats) add_once(scope.formats, *drive::format_of(format));
    for (const LineProtocol protocol : {LineProtocol::ei_ascii, LineProtocol::modbus_rtu}) {
        const auto& named = options.protocols;
        if (!named.empty() && std::find(named.begin(), named.end(), drive::name(protocol)) == named.end())
            continue;
        std::vector<drive::UnitAddress> units;
        for (const std::string& text : options.units)
            if (const auto unit = drive::unit_of(protocol, text)) add_once(units, *unit);
        if (!options.units.empty() && units.empty()) continue;
        scope.protocols.push_back(protocol);
        if (!units.empty()) scope.units[protocol] = std::move(units);
    }
    if (scope.protocols.empty()) return Failure{std::string{"no --unit is one of this --protocol"}};
    if (drive::search_plan(scope).empty())
        return Failure{std::string{"Modbus RTU has 8 data bits: write --format 8N1, 8E1 or 8O1"}};
    return scope;
}

/// What the plan leaves out.
std::vector<std::string> left_out(const IdentifyOptions& options, const drive::SearchScope& scope)
{
    const auto asks = [&](LineProtocol protocol) {
        return std::find(scope.protocols.begin(), scope.protocols.end(), protocol) != scope.protocols.end();
    };
    std::vector<std::string> notes;
    if (!options.units.empty() || !options.bauds.empty() || !options.formats.empty() ||
        !options.protocols.empty())
        notes.emplace_back(
            "what answers to other rates, formats, units and protocols: the options of this command left them out");
    if (asks(LineProtocol::ei_ascii) && scope.units.count(LineProtocol::ei_ascii) == 0) {
        notes.emplace_back("EI-ASCII units of the groups 8 to F: name one with --unit");
        if (scope.formats.empty())
            notes.emplace_back(
                "EI-ASCII units above 01 at other formats than 7E1: name the format with --format");
    }
    if (asks(LineProtocol::modbus_rtu) && scope.units.count(LineProtocol::modbus_rtu) == 0)
        notes.emplace_back("Modbus units above 32: name one with --unit");
    return notes;
}

Result<std::vector<drive::Tag>, std::string> tags_of(const IdentifyOptions& options)
{
    std::set<std::uint16_t> wanted;
    for (const TagSpan span : options.tags)
        for (unsigned tag = span.first; tag <= span.last; ++tag)
            wanted.insert(static_cast<std::uint16_t>(tag));
    std::vector<drive::Tag> tags;
    if (!options.table.empty()) {
        const auto table = profile::load_tags(io::read_regular_file, options.table);
        if (!table) {
            std::string faults;
            for (const input::Fault& fault : table.error())
                faults += (faults.empty() ? "" : "\n") + to_string(fault);
            return Failure{faults};
        }
        for (const drive::Tag& tag : table->all())
            if (options.tags.empty() || wanted.erase(tag.number) > 0) tags.push_back(tag);
        if (tags.empty() && wanted.empty()) return Failure{options.table + " has no tag: name another table"};
    }
    for (const std::uint16_t tag : wanted) tags.push_back(drive::unlisted_tag(tag));
    if (options.tags.empty() && options.table.empty()) tags = drive::usual_trial_tags();
    std::sort(tags.begin(), tags.end(),
              [](const drive::Tag& one, const drive::Tag& other) { return one.number < other.number; });
    return tags;
}

std::vector<drive::MnemonicRule> rules_of(const IdentifyOptions& options)
{
    if (options.rules.empty()) return drive::known_rules();
    std::vector<drive::MnemonicRule> rules;
    for (const std::string& name : options.rules) add_once(rules, *drive::mnemonic_rule_of(name));
    return rules;
}

/// Those of the folder that can be read.
std::vector<profile::Profile> profiles_of(const std::string& folder)
{
    std::vector<profile::Profile> all;
    for (const std::string& name : io::names_in(folder, ".toml"))
        if (auto profile = profile::load_profile(io::read_regular_file, folder, name))
            all.push_back(*std::move(profile));
    return all;
}

/// One line that is written again on a terminal, elsewhere a line now and then.
class Progress {
public:
    Progress(const drive::LineSearch& search, Terminal& terminal) : search_(search), terminal_(terminal) {}

    void begin(const std::string& port) const
    {
        terminal_.err << fmt::format("searching on {}: at most {} in at most {} s; Ctrl-C ends it\n", port,
                                     plural(search_.most(), "question"), search_.longest().count())
                      << std::flush;
    }
    void say()
    {
        const auto now = Clock::now();
        if (now < said_ + (terminal_.tty ? Clock::duration{kDrawProgressEvery}
                                         : Clock::duration{kSayProgressEvery}))
            return;
        said_ = now;
        terminal_.err << fmt::format("{}{} of at most {} asked, {} s{}", terminal_.tty ? "\r" : "",
                                     search_.asked(), plural(search_.most(), "question"), seconds().count(),
                                     terminal_.tty ? "\033[K" : "\n")
                      << std::flush;
    }
    void end() const
    {
        if (terminal_.tty) terminal_.err << "\r\033[K" << std::flush;
    }
    std::chrono::seconds seconds() const
    {
        return std::chrono::floor<std::chrono::seconds>(Clock::now() - begun_);
    }
    bool is_over() const { return Clock::now() - begun_ >= search_.longest(); }

private:
    const drive::LineSearch& search_;
    Terminal& terminal_;
    Clock::time_point begun_ = Clock::now(), said_ = begun_;
};

/// Asks until the search is over or is ended. `trouble`: a sentence, if the port failed.
SearchEnd ask_all(drive::LineSearch& search, IdentifyPort& port, const EndSignals& end, Progress& progress,
                  std::string& trouble)
{
    while (const auto question = search.next()) {
        if (becomes_readable(end.fd(), 0)) return SearchEnd::interrupted;
        if (progress.is_over()) return SearchEnd::time_is_over;
        const auto sight = port.ask(*question);
        if (!sight) {
            trouble = sight.error();
            return SearchEnd::failed;
        }
        search.take(*sight);
        progress.say();
    }
    return search.is_full() ? SearchEnd::full : SearchEnd::complete;
}

int refuse(const std::string& sentence, Exit exit, Terminal& terminal)
{
    terminal.err << "dpctl: " << sentence << '\n';
    return exit;
}

int run(const IdentifyOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    const auto scope = scope_of(options);
    if (!scope) return refuse(scope.error(), kUsage, terminal);
    auto tags = tags_of(options);
    if (!tags) return refuse(tags.error(), kUsage, terminal);
    Identified found;
    found.port = options.port;
    found.driver = driver_of(options);
    found.timeout = timeout_of(options);
    found.not_asked = left_out(options, *scope);
    found.profiles = profiles_of(options.profiles);
    if (!options.table.empty()) found.table = std::filesystem::absolute(options.table).string();

    const EndSignals end; // before the port is touched: from now on a signal leaves it as it was
    drive::LineSearch search{drive::search_plan(*scope),
                             drive::RuleTrial{*std::move(tags), rules_of(options)}, found.timeout, kLimits};
    IdentifyPort port{options.port, found.driver, found.timeout};
    std::string trouble;
    {
        const auto settings = io::PortSettings::save(options.port);
        if (!settings) return refuse(port_sentence(options.port, settings.error()), kNo, terminal);
        Progress progress{search, terminal};
        progress.begin(options.port);
        found.end = ask_all(search, port, end, progress, trouble);
        progress.end();
        found.took = progress.seconds();
    }
    for (const drive::FoundUnit& one : search.found()) found.answering.push_back(report::answering_of(one));
    found.asked = search.asked();
    found.most = search.most();
    found.unsure = search.unsure();
    found.damaged = search.damaged();
    found.hears_itself = port.hears_itself();
    for (const std::string& sentence : port.refused()) found.refused.push_back(sentence);
    if (!port.was_open() && trouble.empty() && !found.refused.empty()) trouble = found.refused.front();
    if (!trouble.empty()) terminal.err << "dpctl: " << trouble << '\n';
    if (trouble.empty() || port.was_open())
        session.print(identified_json(found), [&] { return render_identified(found, terminal.look()); });
    return found.answering.empty() ? kNo : kFine;
}

} // namespace

const Command kIdentify{
    "identify",
    kOffline,
    "Searches a serial port for drives: which rate, format, unit, protocol and rule of the mnemonics",
    add<IdentifyOptions>,
    kOwnForm,
    "dpctl identify /dev/ttyUSB0                       a laptop and a USB adapter are enough\n"
    "dpctl identify /dev/ttyUSB0 --tags 55-57,288      under which rule these tags answer\n"
    "dpctl identify /dev/ttyUSB0 --baud 9600 --format 7E1 --unit 00 --table my-590.csv",
    "0 something answers, 1 nothing answered, or the port cannot be used",
    Asks::nobody};

} // namespace dpslave::dpctl
