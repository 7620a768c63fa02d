// SPDX-License-Identifier: Apache-2.0
/// Layer 2 on a simulated line: octets, pauses, bad characters and a late edge. Judged by the second hand of
/// the tests (support/wire): each reply is a valid telegram to the requester and lies in its window; what is
/// read in several pieces is answered alike; after all of it a request on a quiet line is answered.
#include "input.hpp"
#include "support/wire.hpp"

#include "dpslave/fdl/layer2.hpp"

#include <array>
#include <optional>
#include <vector>

namespace {

using namespace dpslave;
using fuzz::demand;
using std::chrono::nanoseconds;
using test::Octets;

constexpr std::uint8_t kUs = 5, kAlsoUs = 31;
constexpr std::array<Tbit, kBauds.size()> kMaxTsdr{Tbit{60}, Tbit{60},  Tbit{60}, Tbit{60},
                                                   Tbit{60}, Tbit{100}, Tbit{150}};

/// Counted by the target itself; rounded down.
nanoseconds bits(std::uint64_t count, Baud baud)
{
    return nanoseconds{count * 1'000'000'000 / static_cast<std::uint64_t>(baud)};
}

/// Answers by the SAP that is asked for. SAP 61 sets min T_SDR, as Set_Prm does.
class User final : public fdl::SapUser {
public:
    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override
    {
        min_before = min;
        switch (request.dsap.value_or(0)) {
            case 62: return fdl::Answer::sc;
            case 61:
                min = request.data.empty() ? 11 : std::max<std::uint32_t>(11, request.data.front());
                return fdl::Answer::sc;
            case 50: return fdl::Answer::user_error;
            case 51: return fdl::Answer::no_resource;
            case 52: return fdl::Answer::not_activated;
            case 60: reply.append(request.data.first(std::min<std::size_t>(request.data.size(), 242))); break;
            default: reply.append(request.data); break;
        }
        return reply.empty() || !request.dsap ? fdl::Answer::low : fdl::Answer::high;
    }
    void sdn(const fdl::Indication&) override {}
    void heard(std::uint8_t, Instant) override {}
    Tbit min_tsdr() const override { return Tbit{min}; }
    fdl::Supervision supervision() const override { return fdl::Supervision::unowned; }
    void on_time(Instant) override {}
    Instant next_deadline() const override { return kNever; }

    std::uint32_t min = 11;        ///< T_bit
    std::uint32_t min_before = 11; ///< before the last request
};

/// Octets in a row on the wire, and what precedes them.
struct Step {
    nanoseconds pause{};
    Octets octets;
    std::size_t piece = 0; ///< octets of each further read; 0 = one read
    bool bad = false;      ///< its last character is a bad one
};

struct Line {
    Baud baud = Baud::k500;
    bool searched = false;
    nanoseconds lateness{}; ///< of the edge
    std::vector<Step> steps;
};

/// How the octets of a step are read.
enum class Reads { whole, pieces_at_once, as_they_come };

struct Reply {
    Octets octets;
    Instant at;
    friend bool operator==(const Reply&, const Reply&) = default;
};

class Run {
public:
    Run(const Line& line, Reads reads)
        : line_(line),
          reads_(reads),
          layer2_({.baud = line.baud,
                   .search = line.searched ? std::optional{fdl::BaudSearchSettings{}} : std::nullopt,
                   .start_up_latency = {}})
    {
        heard_.reserve(1024);
        replies_.reserve(64);
        layer2_.attach(kUs, users_[0], kMaxTsdr);
        layer2_.attach(kAlsoUs, users_[1], kMaxTsdr);
        wake();
        for (const Step& step : line.steps) take(step);
    }

    const std::vector<Reply>& replies() const { return replies_; }

    /// On a line that has been quiet an FDL_Status is answered, whatever was before.
    void demand_service()
    {
        advance(now_ + std::chrono::seconds{1});
        const std::size_t before = replies_.size();
        take({.pause = {}, .octets = test::sd1(kUs, 2, 0x49)});
        advance(now_ + std::chrono::milliseconds{500});
        demand(replies_.size() == before + 1, "a request on a quiet line is answered");
        demand(replies_.back().octets == test::sd1(2, kUs, 0x00), "FDL_Status is answered by OK");
    }

private:
    nanoseconds on_wire(std::size_t octets) const { return bits(11 * octets, layer2_.baud()); }

    void take(const Step& step)
    {
        advance(now_ + step.pause);
        const std::size_t count = step.octets.size();
        const bool in_pieces = reads_ != Reads::whole && step.piece != 0;
        const std::size_t piece = in_pieces ? step.piece : std::max<std::size_t>(count, 1);
        const Instant begin = now_;
        const std::size_t good = step.bad && count > 0 ? count - 1 : count;
        for (std::size_t from = 0; from < count; from += piece) {
            const std::size_t to = std::min(from + piece, count);
            const std::size_t read_up_to = reads_ == Reads::as_they_come ? to : count;
            advance(begin + on_wire(read_up_to));
            const Bytes octets = Bytes{step.octets}.subspan(from, std::min(to, good) - from);
            read(octets, reads_ == Reads::pieces_at_once && to < count);
            if (to > good) read_bad();
            if (reads_ == Reads::as_they_come || to == count) wake();
        }
    }

    void read(Bytes octets, bool more_follows)
    {
        if (octets.empty()) return;
        heard_.insert(heard_.end(), octets.begin(), octets.end());
        read_at_ = now_;
        layer2_.on_bytes(octets, now_, more_follows);
    }

    void read_bad()
    {
        heard_.clear();
        read_at_ = now_;
        layer2_.on_character_error(now_);
    }

    /// Serves each deadline before `until`, with the lateness of the edge.
    void advance(Instant until)
    {
        std::optional<Instant> last;
        while (layer2_.next_deadline() < until) {
            const Instant due = std::max(layer2_.next_deadline(), now_) + line_.lateness;
            if (due >= until) break;
            demand(!last || layer2_.next_deadline() > *last || line_.searched, "a deadline moves on");
            last = layer2_.next_deadline();
            now_ = due;
            wake();
        }
        now_ = std::max(now_, until);
    }

    void wake()
    {
        layer2_.on_time(now_);
        layer2_.take_baud_change();
        const auto octets = layer2_.take_transmit();
        if (!octets) return;
        replies_.push_back({{octets->begin(), octets->end()}, now_});
        judge(replies_.back());
        heard_.clear();
        demand(!layer2_.take_transmit(), "a request has one reply");
    }

    void judge(const Reply& reply) const
    {
        const Baud baud = layer2_.baud();
        demand(layer2_.baud_state() != fdl::BaudState::baud_search,
               "the station is silent while it searches");
        const auto telegram = test::heard(reply.octets);
        demand(telegram.has_value(), "a reply is a valid telegram");
        demand(!telegram->has_fc() || !telegram->is_request(), "a reply is no request");
        const auto requests = heard_requests();
        demand(!requests.empty(), "a reply answers what was heard last");
        const auto asked = std::ranges::find_if(requests, [&telegram](const test::Heard& one) {
            return !telegram->has_fc() || (telegram->sa == one.da && telegram->da == one.sa);
        });
        demand(asked != requests.end(), "a reply is of the address that was asked, to the master that asked");
        const User& user = users_[asked->da == kUs ? 0 : 1];
        const nanoseconds after = reply.at - read_at_;
        const std::uint32_t least = std::min(user.min, user.min_before);
        const std::uint32_t most =
            std::max(kMaxTsdr[index_of(baud)].count, std::max(user.min, user.min_before) + 49);
        demand(after >= bits(least, baud), "no reply before min T_SDR");
        demand(after <= bits(most, baud) + nanoseconds{1}, "no reply behind its window");
    }

    /// The requests to one of our addresses that heard_ ends with and that have to be answered. There is more
    /// than one where the data of a request end like another one, whose checksum and end are the same
    /// octets.
    std::vector<test::Heard> heard_requests() const
    {
        std::vector<test::Heard> found;
        constexpr std::string_view answered{"\x03\x05\x07\x09\x0C\x0D\x0E\x0F"};
        for (std::size_t length = 6; length <= std::min<std::size_t>(heard_.size(), 255); ++length) {
            const auto begin = heard_.end() - static_cast<std::ptrdiff_t>(length);
            if (*begin != 0x10 && *begin != 0x68 && *begin != 0xA2) continue;
            auto one = test::heard({begin, heard_.end()});
            if (one && one->is_request() && (one->fc & 0x80) == 0 && (one->da == kUs || one->da == kAlsoUs) &&
                answered.find(static_cast<char>(one->fc & 0x0F)) != std::string_view::npos)
                found.push_back(*one);
        }
        return found;
    }

    const Line& line_;
    Reads reads_;
    std::array<User, 2> users_;
    fdl::Layer2 layer2_;
    Instant now_{std::chrono::seconds{1000}};
    Instant read_at_ = now_;
    Octets heard_; ///< since the last reply or bad character
    std::vector<Reply> replies_;
};

/// Pauses round the limits: T_SYN, the FIFO's idle time, the silence that ends a telegram.
nanoseconds pause_of(std::uint8_t code, Baud baud)
{
    constexpr std::array<std::uint16_t, 16> in_bits{33, 0,  1,  11,  22,  32,  34,  40,
                                                    60, 76, 78, 100, 150, 200, 400, 800};
    constexpr std::array<std::uint16_t, 8> in_tenths{20, 48, 51, 70, 201, 210, 500, 5000};
    if (code < 0x80) return bits(in_bits[code % 16], baud);
    return std::chrono::microseconds{100} * in_tenths[code % 8];
}

/// The octets of a step: as they are, or a telegram of the second hand with them in it.
Octets octets_of(std::uint8_t kind, fuzz::Input& input)
{
    const auto content = input.octets(input.octet());
    const Octets octets{content.begin(), content.end()};
    const auto at = [&octets](std::size_t i) { return i < octets.size() ? octets[i] : std::uint8_t{0}; };
    const Octets data = octets.size() > 3 ? Octets{octets.begin() + 3, octets.end()} : Octets{};
    switch (kind) {
        case 1: return test::sd1(at(0), at(1), at(2));
        case 2:
        case 3:
            if (data.empty() || data.size() > 246) return octets;
            return test::sd2(kind == 2 ? at(0) : kUs | (at(0) & 0x80), at(1), at(2), data);
        case 4: {
            Octets eight = data;
            eight.resize(8);
            return test::sd3(at(0), at(1), at(2), eight);
        }
        case 5: return test::token(at(0), at(1));
        case 6: return test::joined({octets, test::sd1(kUs, 2, at(0) % 2 == 0 ? 0x49 : 0x6D)});
        default: return octets;
    }
}

Line line_of(fuzz::Input& input)
{
    Line line;
    const std::uint8_t head = input.octet();
    line.baud = kBauds[head % kBauds.size()];
    line.searched = (head & 0xE0) == 0xE0 && line.baud != Baud::k45_45;
    line.lateness = bits(input.octet(), line.baud);
    while (!input.at_end() && line.steps.size() < 64) {
        Step step;
        const std::uint8_t form = input.octet(); // bits 2..0 what, 3 bad, 7..4 the size of a piece
        step.pause = pause_of(input.octet(), line.baud);
        step.piece = form >> 4;
        step.bad = (form & 8) != 0;
        step.octets = octets_of(form & 7, input);
        line.steps.push_back(std::move(step));
    }
    return line;
}

/// Says what differs before it is a finding.
void demand_same(const Run& whole, const Run& pieces, const char* rule)
{
    if (whole.replies() == pieces.replies()) return;
    for (const Run* run : {&whole, &pieces})
        for (const Reply& reply : run->replies())
            std::fprintf(stderr, "%s at %lld: %s\n", run == &whole ? "whole" : "pieces",
                         static_cast<long long>(reply.at.time_since_epoch().count()),
                         test::show(reply.octets).c_str());
    demand(false, rule);
}

/// Of the telegram that begins at `at`; 0: none does.
std::size_t telegram_at(const Octets& octets, std::size_t at)
{
    for (const std::size_t length : {std::size_t{1}, std::size_t{3}, std::size_t{6}, std::size_t{14},
                                     at + 1 < octets.size() ? octets[at + 1] + std::size_t{6} : 0})
        if (length != 0 && at + length <= octets.size() &&
            test::heard({octets.begin() + static_cast<std::ptrdiff_t>(at),
                         octets.begin() + static_cast<std::ptrdiff_t>(at + length)}))
            return length;
    return 0;
}

/// Reads further apart than T_SYN may have silence between them for all that layer 2 knows. Telegrams in the
/// data of another one that fill whole reads, one behind the other, are heard then
/// (docs/internals/fuzzing.md).
bool hides_telegram(const Step& step)
{
    if (step.piece * 11 < 33) return false;
    for (std::size_t from = step.piece; from < step.octets.size(); from += step.piece)
        for (std::size_t at = from; at < step.octets.size();) {
            const std::size_t length = telegram_at(step.octets, at);
            if (length == 0) break;
            at += length;
            if (at % step.piece == 0 || at == step.octets.size()) return true;
        }
    return false;
}

/// Each step is one valid telegram, and longer behind the one before than any reply may take: whatever the
/// reads are, the replies are the same.
bool is_clean(const Line& line)
{
    if (line.searched || line.lateness != nanoseconds{0}) return false;
    for (const Step& step : line.steps)
        if (step.bad || step.pause < bits(320, line.baud) || !test::heard(step.octets) ||
            hides_telegram(step))
            return false;
    return true;
}

/// What is read in several pieces at one moment is one read, but the pause before it is measured to the first
/// piece. So the replies are the same where not even that pause ends a telegram that has begun. While the
/// rate is searched it depends on the reads what rate is tried next.
bool has_plain_pauses(const Line& line)
{
    if (line.searched) return false;
    const auto patience = std::chrono::milliseconds{line.baud < Baud::k93_75 ? 20 : 5};
    nanoseconds quiet{}; // steps without octets make one pause
    for (const Step& step : line.steps) {
        quiet += step.pause;
        if (quiet + bits(11 * step.octets.size(), line.baud) > patience) return false;
        if (!step.octets.empty()) quiet = {};
    }
    return true;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Input input{data, size};
    const Line line = line_of(input);
    Run whole{line, Reads::whole};
    Run as_they_come{line, Reads::as_they_come};
    if (is_clean(line)) demand_same(whole, as_they_come, "reads in pieces are answered alike");
    if (has_plain_pauses(line))
        demand_same(whole, Run{line, Reads::pieces_at_once}, "one read in pieces is answered alike");
    if (line.searched || line.lateness > bits(30, line.baud)) return 0;
    whole.demand_service();
    as_they_come.demand_service();
    return 0;
}
