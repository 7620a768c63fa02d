// SPDX-License-Identifier: Apache-2.0
#include "answer_faults.hpp"

#include "values.hpp"

#include <algorithm>

namespace dpslave::sim {
namespace {

std::optional<std::chrono::nanoseconds> delay_of(std::string_view text)
{
    return read_duration(text, std::chrono::nanoseconds{0}, kLongestDelay);
}

} // namespace

bool AnswerFaults::knows(const std::string& name)
{
    return name == "late" || name == "lose" || name == "spoil" || name == "instead" || name == "noise";
}

std::vector<std::string> AnswerFaults::help()
{
    return {
        "  late TIME[-TIME] [WHICH]   replies come this much later, even after the next request",
        "  lose [WHICH]               replies are lost, but the request is carried out",
        "  spoil [WHICH]              a reply with a wrong checksum comes before the right one",
        "  instead OCTETS [WHICH]     these octets come in place of the reply, for example: instead 04 once",
        "  noise OCTETS [WHICH]       these octets come right before the reply, for example: noise 00FF",
        "                             WHICH: 1/N (one in N), every TIME, tag TAG, once; can be joined",
    };
}

/// Reads which replies it applies to; returns an empty text if it was understood.
std::string AnswerFaults::choose(Fault& fault, const std::vector<std::string>& words, std::size_t at)
{
    for (; at < words.size(); ++at) {
        const std::string& word = words[at];
        const bool has_more = at + 1 < words.size();
        if (word == "once") {
            fault.once = true;
        } else if (word.starts_with("1/")) {
            const auto n = read_number(std::string_view{word}.substr(2), 1, INT64_MAX);
            if (!n) return "one in N is written as: 1/20";
            fault.one_in = *n;
        } else if (word == "every" && has_more) {
            fault.every = read_duration(words[++at]);
            if (!fault.every) return "a time is written as: every 3s";
        } else if (word == "tag" && has_more) {
            const auto tag = number_at(words, ++at, 0, 0xFFFF);
            if (!tag) return "a tag is a number to 65535: tag 55";
            fault.tag = static_cast<std::uint16_t>(*tag);
        } else {
            return "'" + word + "' chooses no replies: 1/N, every TIME, tag TAG, once";
        }
    }
    return {};
}

std::string AnswerFaults::add(const std::vector<std::string>& words)
{
    Fault fault;
    std::size_t rest = 1;
    if (words[0] == "late") {
        const std::string text = words.size() > 1 ? words[1] : "";
        const auto dash = text.find('-');
        const auto least = delay_of(std::string_view{text}.substr(0, dash));
        const auto most =
            dash == std::string::npos ? least : delay_of(std::string_view{text}.substr(dash + 1));
        if (!least || !most || *most < *least) return "write it as: late 900ms, or late 210ms-230ms 1/20";
        fault.least = *least;
        fault.most = *most;
        rest = 2;
    } else if (words[0] == "lose") {
        fault.kind = Kind::lose;
    } else if (words[0] == "spoil") {
        fault.kind = Kind::spoil;
    } else {
        const auto octets = words.size() > 1 ? octets_of(words[1]) : Result<Octets, std::string>{Octets{}};
        const bool is_noise = words[0] == "noise";
        if (!octets || octets->empty())
            return is_noise ? "write it as: noise 00FF (octets without blanks)"
                            : "write it as: instead 04 once (octets without blanks)";
        fault.kind = is_noise ? Kind::noise : Kind::instead;
        fault.octets = *octets;
        rest = 2;
    }
    std::string wrong = choose(fault, words, rest);
    if (wrong.empty()) faults_.push_back(std::move(fault));
    return wrong;
}

bool AnswerFaults::meets(Fault& fault, Concerned concerned, Instant now)
{
    if (fault.is_over) return false;
    if (fault.tag && (*fault.tag < concerned.first || *fault.tag >= concerned.first + concerned.count))
        return false;
    if (++fault.count % fault.one_in != 0) return false;
    if (fault.every) {
        if (now < fault.due) return false;
        fault.due = now + *fault.every;
    }
    fault.is_over = fault.once;
    return true;
}

std::vector<Departure> AnswerFaults::apply(Octets reply, Concerned concerned, Instant now)
{
    std::vector<Departure> leaving;
    Departure answer{std::move(reply), {}, false};
    bool is_lost = false;
    for (Fault& fault : faults_) {
        if (!meets(fault, concerned, now)) continue;
        switch (fault.kind) {
            case Kind::late:
                answer.later += std::chrono::nanoseconds{std::uniform_int_distribution<std::int64_t>{
                    fault.least.count(), fault.most.count()}(random_)};
                answer.is_late = true;
                break;
            case Kind::lose: is_lost = true; break;
            case Kind::spoil:
                leaving.push_back({answer.octets, {}, false});
                leaving.back().octets.back() =
                    static_cast<std::uint8_t>(leaving.back().octets.back() ^ 0x01U);
                break;
            case Kind::instead: answer.octets = fault.octets; break;
            case Kind::noise:
                answer.octets.insert(answer.octets.begin(), fault.octets.begin(), fault.octets.end());
                break;
        }
    }
    if (!is_lost) leaving.push_back(std::move(answer));
    return leaving;
}

} // namespace dpslave::sim
