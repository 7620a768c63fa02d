// SPDX-License-Identifier: Apache-2.0
#include "replay.hpp"

#include "dpsim/common/bus_times.hpp"

#include <fmt/format.h>

#include <utility>

namespace dpslave::sim {
namespace {

/// No more octets are kept of a station that never stops sending.
constexpr std::size_t kMostOfAnAnswer = 1024;

/// "Slave_Diag request 2 to 8", or the octets of what is no telegram.
std::string name_of(const Octets& octets)
{
    const auto length = frame_length(octets);
    if (length && *length == octets.size()) {
        if (const auto decoded = decode(octets)) {
            Frame frame = *decoded;
            frame.data.clear();
            return describe(frame);
        }
    }
    return hex(octets);
}

} // namespace

Replay::Replay(const ReplayScript& script, DriveSide drive, const ReplaySettings& settings, Instant now)
    : script_(script), settings_(settings), judge_(script, drive), last_begin_(now), idle_until_(now)
{}

std::chrono::nanoseconds Replay::capture_time() const
{
    return next_ < script_.steps.size() ? step().at : std::chrono::nanoseconds::max();
}

Instant Replay::due() const
{
    if (again_ || !settings_.in_time) return idle_until_;
    // The first telegram of the bus comes as long after the first packet of the drive as it did.
    const auto pause = next_ == 0 ? step().at : step().pause;
    return std::max(idle_until_, last_begin_ + pause);
}

Instant Replay::next_deadline() const
{
    if (is_done_) return Instant::max();
    if (waits_) return give_up_;
    return next_ < script_.steps.size() ? due() : idle_until_;
}

std::optional<Octets> Replay::take_transmit(Instant now)
{
    if (is_done_ || waits_ || next_ >= script_.steps.size() || now < due()) return std::nullopt;
    rx_.clear();
    is_reported_ = false;
    if (!again_) {
        ++counters_.sent;
        tries_ = 0;
    }
    again_ = false;
    last_begin_ = now;
    const Octets telegram = step().octets;
    const Instant end = now + duration_of(characters(telegram.size()), settings_.baud);
    if (step().answer) {
        waits_ = true;
        give_up_ =
            end + duration_of(slot_time(settings_.baud) + kCharacter, settings_.baud) + settings_.allowance;
    } else {
        go_on(end + duration_of(kTsyn, settings_.baud));
    }
    return telegram;
}

void Replay::on_bytes(Bytes octets, Instant now)
{
    if (octets.empty()) return;
    if (!waits_) return unasked(octets);
    if (rx_.empty()) last_begin_ = now;
    if (rx_.size() > kMostOfAnAnswer) return;
    rx_.insert(rx_.end(), octets.begin(), octets.end());
    give_up_ = now + duration_of(characters(1) + kTsyn, settings_.baud) + settings_.allowance;
    const auto length = frame_length(rx_);
    if (!length || *length == 0 || rx_.size() < *length) return; // no telegram: when the line has fallen idle
    const Octets more(rx_.begin() + static_cast<std::ptrdiff_t>(*length), rx_.end());
    rx_.resize(*length);
    answered(now);
    if (!more.empty()) unasked(more);
}

void Replay::on_time(Instant now)
{
    if (is_done_) return;
    if (waits_) {
        if (now >= give_up_) unanswered(now);
    } else if (next_ >= script_.steps.size() && now >= idle_until_) {
        is_done_ = true;
    }
}

void Replay::answered(Instant now)
{
    ++counters_.compared;
    const AnswerJudge::Verdict verdict = judge_.judge(next_, rx_);
    if (verdict.is_masked) ++counters_.masked;
    if (!verdict.is_same) {
        ++counters_.differences;
        lines_.push_back(fmt::format("packet {}: the answer to {} differs: {}", step().answer_packet,
                                     name_of(step().octets), verdict.why));
        lines_.push_back("  in the capture  " + hex(*step().answer));
        lines_.push_back("  now             " + hex(rx_));
    }
    go_on(now + duration_of(kTid1, settings_.baud));
}

/// No answer, or one that is no telegram: the telegram again, as a master would.
void Replay::unanswered(Instant now)
{
    if (tries_ < settings_.retries) {
        ++tries_;
        ++counters_.retries;
        waits_ = false;
        again_ = true;
        idle_until_ = now;
        return;
    }
    ++counters_.differences;
    lines_.push_back(fmt::format("packet {}: {} is not answered{}", step().packet, name_of(step().octets),
                                 rx_.empty() ? "" : " with a telegram"));
    lines_.push_back("  in the capture  " + hex(*step().answer));
    if (!rx_.empty()) lines_.push_back("  now             " + hex(rx_));
    go_on(now);
}

void Replay::go_on(Instant idle_until)
{
    waits_ = false;
    ++next_;
    idle_until_ = idle_until;
    if (next_ >= script_.steps.size()) idle_until_ += settings_.allowance; // for octets that nobody asked for
}

void Replay::unasked(Bytes octets)
{
    if (std::exchange(is_reported_, true)) return;
    ++counters_.differences;
    const ReplayStep& last = script_.steps[next_ == 0 ? 0 : next_ - 1];
    lines_.push_back(fmt::format("packet {}: octets that were not asked for, after {}", last.packet,
                                 name_of(last.octets)));
    lines_.push_back("  now             " + hex(octets));
}

std::string in_words(const ReplayCounters& counters)
{
    const auto [sent, compared, masked, retries, differences] = counters;
    return fmt::format(
        "{} telegrams sent, {} answers compared, {} of them without what depends on the drive, {} {}: {}",
        sent, compared, masked, retries, retries == 1 ? "retry" : "retries",
        differences == 0   ? std::string{"no difference"}
        : differences == 1 ? std::string{"1 difference"}
                           : fmt::format("{} differences", differences));
}

} // namespace dpslave::sim
