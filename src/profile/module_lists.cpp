// SPDX-License-Identifier: Apache-2.0
#include "module_lists.hpp"

#include "parameter_notes.hpp"

#include "dpslave/gsd/sent.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <tuple>

namespace dpslave::profile {
namespace {

constexpr std::size_t kWordsOfDemand = dp::kDemandOctets / 2;

/// The sum of a module, or of a list of them.
struct Sum {
    std::size_t words = 0;       ///< of parameters
    std::size_t in = 0, out = 0; ///< words of the telegrams
    bool demand = false;         ///< begins with Demand Data
    auto operator<=>(const Sum&) const = default;
};

bool begins_with_demand(const dp::Personality& personality, Bytes cfg)
{
    return personality.demand_identifier != 0 && !cfg.empty() && cfg[0] == personality.demand_identifier;
}

/// Returns the identifiers of a module after its Demand Data; nullopt if the device does not have one of
/// them.
std::optional<std::vector<const dp::Identifier*>> identifiers_of(const dp::Personality& personality,
                                                                 const gsd::Module& module)
{
    std::vector<const dp::Identifier*> all;
    Bytes rest = module.identifiers;
    if (rest.empty()) return std::nullopt;
    if (begins_with_demand(personality, rest)) rest = rest.subspan(1);
    while (!rest.empty()) {
        const auto found =
            std::find_if(personality.identifiers.begin(), personality.identifiers.end(),
                         [&](const dp::Identifier& each) { return each.same_octets(rest) == each.length; });
        if (found == personality.identifiers.end()) return std::nullopt;
        all.push_back(&*found);
        rest = rest.subspan(found->length);
    }
    return all;
}

/// Returns nullopt if the device does not have an identifier.
std::optional<Sum> sum_of(const dp::Personality& personality, const gsd::Module& module)
{
    const auto identifiers = identifiers_of(personality, module);
    if (!identifiers) return std::nullopt;
    Sum sum;
    if (begins_with_demand(personality, module.identifiers)) sum = {0, kWordsOfDemand, kWordsOfDemand, true};
    for (const dp::Identifier* one : *identifiers) {
        sum.words += one->words();
        sum.in += one->reads;
        sum.out += one->writes;
    }
    return sum;
}

/// Lists of 1, 2, 3 ... modules. It keeps one of the lists with equal sums.
class Search {
public:
    Search(const dp::Personality& personality, const gsd::Document& document,
           std::optional<std::size_t> words)
        : personality_(personality),
          words_(words),
          most_words_(words.value_or(most_parameters())),
          limits_(gsd::limits_of(document)),
          left_(limits_.modules)
    {
        for (const gsd::Module& module : document.modules)
            if (const auto sum = sum_of(personality, module))
                add(module, *sum);
            else
                has_others_ = true;
    }

    std::optional<ModuleList> run()
    {
        std::map<Sum, Lists> lists{{Sum{}, {{}, 1}}};
        for (; left_ > 0 && !lists.empty() && ways_ < 2; --left_) {
            lists = longer(lists);
            for (const auto& [sum, found] : lists)
                if (is_wanted(sum)) take(found);
            if (!words_ && best_) break; // any number: the shortest will do
        }
        if (best_) return ModuleList{*best_, ways_ == 1 && !has_others_};
        if (!words_ && only_demand_) return ModuleList{*only_demand_, !has_others_};
        return std::nullopt;
    }

private:
    struct Lists {
        std::vector<const gsd::Module*> one;
        unsigned ways = 0; ///< 2: two or more
    };

    /// The first of several with equal sums stands for all.
    struct Usable {
        const gsd::Module* module;
        Sum sum;
        unsigned ways = 1;
    };

    void add(const gsd::Module& module, const Sum& sum)
    {
        const auto same =
            std::find_if(usable_.begin(), usable_.end(), [&](const Usable& one) { return one.sum == sum; });
        if (same == usable_.end())
            usable_.push_back({&module, sum});
        else
            same->ways = 2;
    }

    std::size_t most_parameters() const { return std::min(personality_.max_parameters, kMaxParameters); }

    bool is_wanted(const Sum& sum) { return words_ ? sum.words == *words_ : sum.words > 0; }

    void take(const Lists& found)
    {
        if (!best_) best_ = found.one;
        ways_ = std::min(2U, ways_ + found.ways);
    }

    bool fits(const Sum& sum) const
    {
        return sum.words <= std::min(most_words_, most_parameters()) &&
               (personality_.max_words == 0 || sum.in + sum.out <= personality_.max_words) &&
               2 * sum.in <= limits_.in && 2 * sum.out <= limits_.out &&
               2 * (sum.in + sum.out) <= limits_.data;
    }

    std::map<Sum, Lists> longer(const std::map<Sum, Lists>& lists)
    {
        std::map<Sum, Lists> next;
        for (const auto& [before, list] : lists)
            for (const auto& [module, more, ways] : usable_) {
                if (more.demand && !list.one.empty()) continue; // in first position only
                const Sum sum{before.words + more.words, before.in + more.in, before.out + more.out,
                              before.demand || more.demand};
                if (!fits(sum)) continue;
                Lists& there = next[sum];
                if (there.ways == 0) {
                    there.one = list.one;
                    there.one.push_back(module);
                }
                there.ways = std::min(2U, there.ways + list.ways * ways);
                if (sum.demand && sum.words == 0 && !only_demand_) only_demand_ = there.one;
            }
        return next;
    }

    const dp::Personality& personality_;
    std::optional<std::size_t> words_;
    std::size_t most_words_;
    gsd::Limits limits_;
    std::size_t left_;
    std::vector<Usable> usable_;
    bool has_others_ = false; ///< the file has a module that the device does not take
    std::optional<std::vector<const gsd::Module*>> best_, only_demand_;
    unsigned ways_ = 0;
};

} // namespace

std::optional<ModuleList> list_of_modules(const dp::Personality& personality, const gsd::Document& document,
                                          std::optional<std::size_t> words)
{
    return Search{personality, document, words}.run();
}

std::optional<std::vector<const gsd::Module*>> list_of_words(const dp::Personality& personality,
                                                             const gsd::Document& document,
                                                             const std::vector<GsdParameter>& words,
                                                             bool demand)
{
    // The shortest lists so far, by the count of words and whether Demand Data come first.
    using List = std::vector<const gsd::Module*>;
    std::map<std::pair<std::size_t, bool>, List> ends{{{0, false}, {}}};
    const auto directions = [&](const gsd::Module& module, std::size_t from) -> std::optional<std::size_t> {
        const auto identifiers = identifiers_of(personality, module);
        if (!identifiers) return std::nullopt;
        for (const dp::Identifier* one : *identifiers)
            for (std::size_t i = 0; i < one->words(); ++i, ++from)
                if (from >= words.size() || (one->reads > 0) != reads(words[from]) ||
                    (one->writes > 0) != writes(words[from]))
                    return std::nullopt;
        return from;
    };
    for (auto at = ends.begin(); at != ends.end(); ++at) { // a module that is added comes after it
        const auto [place, list] = *at;
        for (const gsd::Module& module : document.modules) {
            const bool begins = begins_with_demand(personality, module.identifiers);
            if (begins && (!list.empty() || !demand)) continue;
            const auto end = directions(module, place.first);
            const std::pair next{end.value_or(0), place.second || begins};
            if (!end || next == place || (!begins && list.empty() && demand)) continue;
            List longer = list;
            longer.push_back(&module);
            const auto there = ends.find(next);
            if (there == ends.end() || there->second.size() > longer.size()) ends[next] = std::move(longer);
        }
    }
    const auto found = ends.find({words.size(), demand});
    if (found == ends.end()) return std::nullopt;
    return found->second;
}

std::vector<const gsd::Module*> not_usable(const dp::Personality& personality, const gsd::Document& document)
{
    std::vector<const gsd::Module*> out;
    for (const gsd::Module& module : document.modules)
        if (!sum_of(personality, module)) out.push_back(&module);
    return out;
}

std::vector<const gsd::Module*> closest_list(const dp::Personality& personality,
                                             const gsd::Document& document, std::size_t words)
{
    if (document.modules.empty()) return {};
    const gsd::Module *with_words = nullptr, *not_known = nullptr;
    std::size_t own = 0;
    for (const gsd::Module& module : document.modules) {
        const auto sum = sum_of(personality, module);
        if (!sum && not_known == nullptr) not_known = &module;
        if (!sum || sum->words == 0 || with_words != nullptr) continue;
        with_words = &module;
        own = sum->words;
    }
    // If no module has a word for the station, the first one says why.
    if (with_words == nullptr) return {not_known != nullptr ? not_known : &document.modules.front()};
    std::vector<const gsd::Module*> list{with_words};
    for (std::size_t sum = own; sum < words; sum += own) {
        list.push_back(with_words);
        if (gsd::broken_limit(document, list).empty()) continue;
        list.pop_back();
        break;
    }
    return list;
}

} // namespace dpslave::profile
