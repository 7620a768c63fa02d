// SPDX-License-Identifier: Apache-2.0
#include "daemon_slave.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

namespace conformance {

using namespace std::chrono_literals;
using dpslave::test::Wiring;

namespace {

constexpr unsigned kRate = 93'750;
/// What the station promises, in bit times (8 ms), and when the slot ends: the promise, and what the programs
/// between may need on a loaded machine.
constexpr unsigned kMaxTsdr = 750;
constexpr auto kSlot = 25ms;
constexpr auto kTsyn = 352us; // 33 bit times
/// How often a request is repeated that the machine was too busy for.
constexpr int kTries = 15;
/// So long the drive may still get what a daemon wrote that has ended: 4 ms of the line, and what the
/// programs between need on a loaded machine.
constexpr auto kOnTheLine = 100ms;
constexpr unsigned kTripTag = 4, kStatusTag = 75;

/// Of the telegram that begins here; 0: more octets have to tell.
std::size_t length_of(const Octets& octets)
{
    if (octets.empty()) return 0;
    switch (octets[0]) {
        case 0xE5: return 1;
        case 0x10: return 6;
        case 0x68: return octets.size() < 2 ? 0 : octets[1] + std::size_t{6};
        default: return 0; // a slave sends nothing else
    }
}

dpslave::sim::Pty new_bus()
{
    auto bus = dpslave::sim::open_pty(kRate);
    if (!bus) throw std::runtime_error{bus.error()};
    return std::move(*bus);
}

/// A drive of these tests: words without a scale, so that a word of the bus is a word of the drive.
std::string table()
{
    std::string text = "tag,name,type,decimals,min,max,access,values,start\n";
    const auto row = [&](unsigned tag, const char* access, unsigned start) {
        text += fmt::format("{},Tag {},WORD,,0000,FFFF,{},,{:04X}\n", tag, tag, access, start);
    };
    row(kTripTag, "ro", 0);
    row(kStatusTag, "ro", 0);
    for (std::size_t i = 0; i < kInputTags.size(); ++i) row(kInputTags[i], "ro", kInputsAtStart[i]);
    for (const std::uint16_t tag : kOutputTags) row(tag, "rw", 0);
    for (unsigned i = 0; i < kMostNumberedTags; ++i) row(kFirstNumberedTag + i, "rw", 0);
    return text;
}

Wiring wiring_of(const Family& family, const dpslave::sim::Pty& bus)
{
    Wiring wiring;
    wiring.bus_baud = kRate;
    // Not the simulated bus: on a loaded machine it tears telegrams, and a Global_Control is not repeated.
    wiring.bus_port = bus.path;
    wiring.profile = family.profile;
    wiring.max_tsdr = kMaxTsdr;
    wiring.output_refresh_s = "3600"; // a word that the drive got twice was sent twice
    wiring.table = table();
    const bool is_controller = family.has_own_ident;
    if (is_controller) {
        wiring.protocol = "modbus-rtu";
        wiring.units = {"1"};
        // Where the outputs may be held, the end of the exchange cannot be seen at the drive.
        wiring.keys = fmt::format("ident = {}\noutput_loss = \"zero\"\n", family.ident);
    }
    if (family.has_diagnosis()) wiring.keys += "ext_diag_bit = true\n";
    if (family.has_diagnosis() && !is_controller)
        wiring.keys += fmt::format("[station.tec]\ntrip_tag = {}\n", kTripTag);
    return wiring;
}

} // namespace

DaemonSlave::DaemonSlave(const Family& family)
    : family_(family), bus_(new_bus()), gateway_(wiring_of(family, bus_))
{}

/// Of T_SYN, in which nobody may speak.
void DaemonSlave::after_pause()
{
    expect_nothing(std::chrono::steady_clock::now() + kTsyn);
}

void DaemonSlave::write(const Octets& octets)
{
    if (dpslave::sim::write_all(bus_.master.get(), octets, 1s) != octets.size())
        throw std::runtime_error{"the bus takes no octets"};
}

void DaemonSlave::write_request(const Octets& request)
{
    sent_.note_request(request);
    write(request);
}

void DaemonSlave::write_other(const Octets& octets)
{
    sent_.note_other(octets);
    write(octets);
}

void DaemonSlave::expect_nothing(Time until)
{
    while (std::chrono::steady_clock::now() < until)
        if (const auto word = reply_until(until))
            ADD_FAILURE() << "nobody asked, and the slave sends " << test::show(*word);
}

/// The telegram that comes in time. Octets that are none are a failure.
std::optional<Octets> DaemonSlave::reply_until(Time slot_ends)
{
    while (true) {
        if (const std::size_t length = length_of(heard_); length != 0 && length <= heard_.size()) {
            const auto end = heard_.begin() + static_cast<std::ptrdiff_t>(length);
            Octets telegram(heard_.begin(), end);
            heard_.erase(heard_.begin(), end);
            sent_.note_answer();
            return telegram;
        }
        const auto left = slot_ends - std::chrono::steady_clock::now();
        pollfd bus{bus_.master.get(), POLLIN, 0};
        const timespec wait{0, std::max<long>(std::chrono::nanoseconds{left}.count(), 0)};
        if (::ppoll(&bus, 1, &wait, nullptr) != 1) {
            if (!heard_.empty()) ADD_FAILURE() << "the slave sends no telegram: " << test::show(heard_);
            heard_.clear();
            return std::nullopt;
        }
        const auto more = dpslave::sim::read_some(bus_.master.get());
        if (!more) throw std::runtime_error{"the bus is gone"};
        heard_.insert(heard_.end(), more->begin(), more->end());
        slot_ends = std::max(slot_ends, std::chrono::steady_clock::now() + kSlot); // it has begun in time
    }
}

std::optional<Octets> DaemonSlave::ask(const Octets& request)
{
    const Octets damaged = std::exchange(damaged_, {});
    after_pause();
    write_request(request);
    auto reply = reply_until(std::chrono::steady_clock::now() + kSlot);
    bool is_repeated = false;
    for (int tries = 1; !reply && tries < kTries; ++tries) {
        reply = reply_before_repetition(damaged);
        if (reply) break; // in time, but late in this program
        write_request(request);
        is_repeated = true;
        reply = reply_until(std::chrono::steady_clock::now() + kSlot);
    }
    if (reply && is_repeated) drop_doubles(*reply);
    return reply;
}

/// `damaged`: what was sent before the request. It is sent before a repetition too: a slave that takes a
/// request for the rest of it is silent to each of them.
std::optional<Octets> DaemonSlave::reply_before_repetition(const Octets& damaged)
{
    auto reply = reply_until(std::chrono::steady_clock::now() + kTsyn);
    if (reply || damaged.empty()) return reply;
    write_other(damaged);
    return reply_until(std::chrono::steady_clock::now() + kSlot);
}

/// A request that was repeated may have been answered in time and reached this program late: then each of its
/// repetitions is answered too.
void DaemonSlave::drop_doubles(const Octets& reply)
{
    while (const auto again = reply_until(std::chrono::steady_clock::now() + kSlot))
        EXPECT_EQ(test::show(*again), test::show(reply)) << "the answer to a repetition";
}

testing::AssertionResult DaemonSlave::is_silent_to(const Octets& octets)
{
    after_pause();
    write_other(octets);
    damaged_ = is_whole(octets) ? Octets{} : octets;
    const auto reply = reply_until(std::chrono::steady_clock::now() + kSlot);
    if (!reply) return testing::AssertionSuccess();
    return testing::AssertionFailure() << test::show(octets) << " is answered with " << test::show(*reply);
}

void DaemonSlave::send(const Octets& telegram)
{
    after_pause();
    write_other(telegram);
    damaged_.clear();
}

void DaemonSlave::pass(std::chrono::milliseconds time)
{
    expect_nothing(std::chrono::steady_clock::now() + time);
}

void DaemonSlave::begin_case()
{
    const auto set = [this](unsigned tag, unsigned word) {
        tell_drive(fmt::format("set {} {:04X}", tag, word));
    };
    gateway_.daemon().end(SIGKILL); // first: it writes what the case before has left
    pass(kOnTheLine);
    drive_answers(true);
    for (std::size_t i = 0; i < kInputTags.size(); ++i) set(kInputTags[i], kInputsAtStart[i]);
    for (const unsigned tag : kOutputTags) set(tag, 0);
    for (const unsigned tag : {kTripTag, kStatusTag}) set(tag, 0);
    gateway_.drive().skip();
    written();
    start(test::kUs);
}

/// What its bus thread publishes may be a moment old, and a reply may still be on its way.
void DaemonSlave::end_case()
{
    testing::AssertionResult result = testing::AssertionSuccess();
    dpslave::test::eventually([&] {
        while (reply_until(std::chrono::steady_clock::now() + kTsyn)) {
        }
        return static_cast<bool>(result = sent_.agree(gateway_.json({"counters"})));
    });
    EXPECT_TRUE(result);
}

/// It does not end by itself: the supply is gone.
void DaemonSlave::restart(std::uint8_t address)
{
    end_case();
    gateway_.daemon().end(SIGKILL);
    start(address);
}

void DaemonSlave::start(std::uint8_t address)
{
    std::string text = gateway_.config_text();
    const std::string key = "\naddress = ";
    const auto at = text.find(key) + key.size();
    text.replace(at, text.find('\n', at) - at, std::to_string(address));
    dpslave::test::write_file(gateway_.config(), text);
    gateway_.start_daemon();
    sent_.begin(address);
    damaged_.clear();
}

/// Returns when the drive has done it.
void DaemonSlave::tell_drive(const std::string& command)
{
    auto& drive = gateway_.drive();
    const std::size_t before = drive.transcript().size();
    drive.send_line(command);
    drive.send_line(fmt::format("get {}", kStatusTag)); // what it says comes in the order of the commands
    EXPECT_TRUE(
        drive.transcript().await(fmt::format("tag {} = ", kStatusTag), before, dpslave::test::kLimit));
}

void DaemonSlave::drive_answers(bool does)
{
    tell_drive(does ? "ok" : "silence");
}

/// Two refreshes that began after the change: the first may have been asked before it.
void DaemonSlave::set_input(std::size_t index, std::uint16_t word)
{
    const auto reads = [this] { return gateway_.station().at("drive").at("reads").get<std::uint64_t>(); };
    tell_drive(fmt::format("set {} {:04X}", kInputTags.at(index), word));
    const auto enough = reads() + 2 * (kInputTags.size() + kOutputTags.size() + 2);
    EXPECT_TRUE(dpslave::test::eventually([&] { return reads() >= enough; }));
}

testing::AssertionResult DaemonSlave::drive_gets(std::uint16_t word)
{
    return gateway_.drive().says(fmt::format("tag {} written >{:04X}", kOutputTags[0], word));
}

std::vector<std::uint16_t> DaemonSlave::written()
{
    const std::string what = fmt::format("tag {} written >", kOutputTags[0]);
    const auto lines = gateway_.drive().transcript().lines(written_until_);
    written_until_ += lines.size();
    std::vector<std::uint16_t> words;
    for (const std::string& line : lines)
        if (const auto at = line.find(what); at != std::string::npos)
            words.push_back(
                static_cast<std::uint16_t>(std::stoul(line.substr(at + what.size()), nullptr, 16)));
    return words;
}

void DaemonSlave::report_fault(bool stands)
{
    const bool by_trip = family_.faulty.size() == 4;
    tell_drive(fmt::format("set {} {:04X}", by_trip ? kTripTag : kStatusTag, stands ? 1 : 0));
    const std::string block = test::show(stands ? family_.faulty : family_.healthy);
    EXPECT_TRUE(dpslave::test::eventually(
        [&] { return gateway_.diagnosis().at("hex").get<std::string>().ends_with(block); }));
}

} // namespace conformance
