// SPDX-License-Identifier: Apache-2.0
#include "samples.hpp"

#include "app/reload/plant.hpp"
#include "app/state/report.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/report/words.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace dpslave::app {
namespace {

/// Of one reply: far below what a reply may have, also where each value has many labels.
constexpr std::size_t kMostSamples = 2000, kMostText = 200'000;
constexpr const char* kNone = "none";

constexpr std::size_t kNowhere = kMaxParameters;

/// The place of the tag; where it stands twice, that of the input; kNowhere: it is not among them.
std::size_t place_of(std::uint16_t tag, std::span<const LayoutEntry> parameters)
{
    std::size_t found = kNowhere;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].tag == tag &&
            (found == kNowhere || (parameters[i].reads && !parameters[found].reads)))
            found = i;
    return found;
}

double scaled(const drive::Tag* row, std::uint16_t word)
{
    const bool is_number = row != nullptr && row->type == drive::TagType::number && row->confirmed;
    if (!is_number) return word;
    const int counts = row->is_unsigned ? int{word} : int{static_cast<std::int16_t>(word)};
    return counts / std::pow(10.0, row->decimals);
}

/// Reads the records of one ring in their order, and makes of them what one tag of one station was.
class TagHistory {
public:
    TagHistory(const Station& station, std::uint16_t tag)
        : station_(station), tag_(tag), row_(station.config->tags->find(tag))
    {}

    /// Nothing: the record is not about this tag.
    std::optional<report::Sample> next(const trace::Record& record)
    {
        const auto sample = trace::sample_of(record);
        if (!sample || sample->of.station != station_.number) return std::nullopt;
        if (sample->is_layout) {
            if (std::exchange(layout_, sample->of.generation) == sample->of.generation) return std::nullopt;
            place_ = place_of(tag_, std::span{sample->parameters}.first(sample->count));
            reads_ = place_ != kNowhere && sample->parameters[place_].reads;
            return none(); // until the first refresh
        }
        if (layout_ != sample->of.generation) { // the record with its tags has made room
            ++unreadable_;
            return std::nullopt;
        }
        if (place_ >= sample->count) return std::nullopt;
        if (sample->has_ended && !reads_) return none();
        is_none_ = false;
        const std::uint16_t word = sample->words[place_];
        return report::Sample{.state = std::string{report::code(sample->states[place_])},
                              .raw = word,
                              .scaled = scaled(row_, word),
                              .value = shown_value(*station_.config->tags, tag_, word)};
    }
    std::uint64_t unreadable() const { return unreadable_; }

private:
    std::optional<report::Sample> none()
    {
        if (std::exchange(is_none_, true)) return std::nullopt;
        return report::Sample{.state = kNone};
    }

    const Station& station_;
    const std::uint16_t tag_;
    const drive::Tag* const row_;
    Generation layout_ = 0;
    std::size_t place_ = kNowhere;
    bool reads_ = false;
    bool is_none_ = true; ///< as said last
    std::uint64_t unreadable_ = 0;
};

std::optional<std::string> direction(const Station& station, std::uint16_t tag)
{
    const Layout& layout = station.bus.layout;
    const std::size_t place = place_of(tag, std::span{layout.parameters}.first(layout.count));
    if (place == kNowhere) return std::nullopt;
    return layout.parameters[place].reads ? "in" : "out";
}

} // namespace

report::GetSamplesReply samples_of(const Station& station, const trace::Ring& ring,
                                   const SampleQuestion& question, Instant now,
                                   std::chrono::nanoseconds unix_now)
{
    const auto unix_ms = [&](Instant at) {
        return std::chrono::floor<std::chrono::milliseconds>(unix_now - (now - at)).count();
    };
    report::GetSamplesReply reply{.station = station.config->name,
                                  .tag = question.tag,
                                  .direction = direction(station, question.tag),
                                  .newest = integer(question.after),
                                  .now_unix_ms = unix_ms(now)};
    if (const drive::Tag* const row = station.config->tags->find(question.tag)) reply.name = row->name;
    TagHistory history{station, question.tag};
    std::optional<report::Sample> stood; // when the time that is asked for began
    std::size_t text = 0;
    std::uint64_t known_unreadable = 0; // as a reply before this one has said
    const auto add = [&](report::Sample sample) {
        text += sample.value.size();
        if (sample.number > integer(question.after)) reply.samples.push_back(std::move(sample));
    };
    trace::Ring::Reader reader{ring};
    for (trace::Record record; reader.next(record);) {
        if (!reply.oldest_unix_ms) {
            reply.oldest_unix_ms = unix_ms(record.head.at);
            if (record.number > question.after) reply.lost = integer(record.number - question.after);
        }
        if (reply.samples.size() >= kMostSamples || text >= kMostText) {
            reply.more = true;
            break;
        }
        reply.newest = std::max(reply.newest, integer(record.number + 1)); // no sample has the number 0
        auto sample = history.next(record);
        if (record.number < question.after) known_unreadable = history.unreadable();
        if (!sample) continue;
        sample->number = integer(record.number + 1);
        sample->unix_ms = unix_ms(record.head.at);
        if (question.within && record.head.at < now - *question.within) {
            stood = std::move(sample);
            continue;
        }
        if (stood) add(*std::exchange(stood, std::nullopt));
        add(*std::move(sample));
    }
    if (stood && !reply.more) add(*std::move(stood));
    reply.lost += integer(reader.lost() + history.unreadable() - known_unreadable);
    return reply;
}

control::Reply get_samples(const Station& station, const control::Json& parameters)
{
    constexpr std::int64_t kMostTag = 65'535, kLongest_s = 366 * 86'400;
    const auto tag = parameters["tag"].get<std::int64_t>();
    if (tag < 0 || tag > kMostTag)
        return control::Error{"BadValue",
                              {{"tag", tag}, {"value", ""}, {"reason", "a tag is a number from 0 to 65535"}}};
    const trace::Ring& ring = station.drive_line->link.samples;
    if (!ring.is_on()) return control::Error{"SamplesOff", control::Json::object()};
    SampleQuestion question{.tag = static_cast<std::uint16_t>(tag)};
    if (parameters.contains("seconds"))
        question.within =
            std::chrono::seconds{std::clamp<std::int64_t>(parameters["seconds"], 0, kLongest_s)};
    question.after =
        static_cast<std::uint64_t>(std::max<std::int64_t>(0, parameters.value("after", std::int64_t{0})));
    return control::Done{json_of(samples_of(station, ring, question, io::monotonic_now(), io::unix_now()))};
}

} // namespace dpslave::app
