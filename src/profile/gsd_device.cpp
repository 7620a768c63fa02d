// SPDX-License-Identifier: Apache-2.0
#include "gsd_command.hpp"
#include "gsd_device_facts.hpp"
#include "gsd_made.hpp"
#include "parameter_notes.hpp"

#include "dpslave/base/bytes.hpp"
#include "dpslave/dp/set_prm.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

constexpr std::size_t kMaxOctets = 244; ///< of one direction (wire reference 4.6)

class DeviceMaker {
public:
    DeviceMaker(const Profile& profile, const Selection& selection)
        : profile_(profile),
          personality_(personality_of(profile, legal_keys(profile, selection))),
          facts_(profile.gsd),
          wanted_(selection)
    {
        Selection own;
        own.in = facts_.in_tags;
        own.out = facts_.out_tags;
        words_ = selection.parameters();
        const bool says_nothing =
            !selection.says_parameters() && !selection.tags && selection.modules.empty();
        standard_ =
            !own.parameters().empty() && (says_nothing || (!selection.tags && words_ == own.parameters()));
        if (standard_) words_ = own.parameters();
        is_choice_ = !std::any_of(selection.modules.begin(), selection.modules.end(),
                                  [](const PlantModule& module) { return module.preset; }) &&
                     (selection.tags || !selection.modules.empty());
        generic_ = words_.empty() && !selection.demand && !selection.tags && selection.modules.empty();
    }

    Draft make()
    {
        for (const WrongKey& wrong : wrong_keys(profile_, wanted_.keys())) refuse(wrong.key, wrong.sentence);
        const auto presets = std::count_if(wanted_.modules.begin(), wanted_.modules.end(),
                                           [](const PlantModule& module) { return module.preset; });
        if (presets != 0 && presets != static_cast<std::ptrdiff_t>(wanted_.modules.size()))
            refuse("preset",
                   "some modules are preset and others are not: write preset = true into each or into none.");
        // The profile's description speaks of its own mapping, so not of another one.
        if (generic_ || standard_) description_ = facts_.description;
        add_facts(profile_, wanted_, description_, device_, notes_);
        draft_.tags_at = personality_.prm.tags_at;
        if (generic_) {
            generic();
        } else if (is_choice_) {
            choice();
        } else {
            note_parameters(profile_, personality_, words_, notes_);
            if (fits()) fixed();
        }
        lengths();
        head();
        draft_.parameters = std::move(words_);
        return std::move(draft_);
    }

private:
    /// Returns the keys if they are valid, else none: wrong ones are refused.
    static StationKeys legal_keys(const Profile& profile, const Selection& selection)
    {
        const StationKeys keys = selection.keys();
        return wrong_keys(profile, keys).empty() ? keys : StationKeys{};
    }

    void refuse(std::string_view code, std::string sentence) { notes_.refuse(code, std::move(sentence)); }

    /// Returns the smallest number of identifiers that have just these words. It is empty if there are none,
    /// or no word.
    std::vector<const dp::Identifier*> identifiers() const
    {
        constexpr std::size_t kNever = SIZE_MAX;
        std::vector<std::size_t> count(words_.size() + 1, kNever);
        std::vector<const dp::Identifier*> last(words_.size() + 1, nullptr);
        count[0] = 0;
        for (std::size_t at = 0; at < words_.size(); ++at)
            for (const dp::Identifier& each : personality_.identifiers) {
                const std::size_t end = at + each.words();
                if (count[at] == kNever || each.words() == 0 || end > words_.size() ||
                    count[at] + 1 >= count[end])
                    continue;
                const auto is_its = [&](const GsdParameter& word) {
                    return (each.reads > 0) == reads(word) && (each.writes > 0) == writes(word);
                };
                if (!std::all_of(words_.begin() + static_cast<std::ptrdiff_t>(at),
                                 words_.begin() + static_cast<std::ptrdiff_t>(end), is_its))
                    continue;
                count[end] = count[at] + 1;
                last[end] = &each;
            }
        std::vector<const dp::Identifier*> out;
        for (std::size_t at = words_.size(); at > 0 && last[at] != nullptr; at -= last[at]->words())
            out.push_back(last[at]);
        std::reverse(out.begin(), out.end());
        return out;
    }

    void generic_lengths()
    {
        const bool demand = personality_.demand_identifier != 0;
        const std::size_t parameters = personality_.max_parameters;
        const std::size_t longest = (demand ? dp::kDemandOctets : 0) + 2 * parameters;
        const std::size_t both = identifier_for(personality_, {Direction::in_out}) != nullptr ? 2 : 1;
        std::size_t sum = 2 * (demand ? dp::kDemandOctets : 0) + 2 * both * parameters;
        if (personality_.max_words > 0) sum = std::min(sum, 2 * personality_.max_words);
        device_.max_in = device_.max_out = static_cast<std::uint8_t>(std::min({longest, sum, kMaxOctets}));
        device_.max_data = static_cast<std::uint16_t>(std::min(sum, 2 * kMaxOctets));
    }

    /// The modules by their names; the master's tool puts them together, the engineer enters the tags.
    void generic()
    {
        const dp::PrmLayout& prm = personality_.prm;
        if (prm.list == dp::TagList::exact)
            return refuse(
                "no_mapping",
                "the tags of a " + profile_.name +
                    " are in the GSD, one for each word, and none is chosen: choose tags as inputs and outputs, or Demand Data alone.");
        generic_lengths();
        modules_of_choice();
        open_tags();
    }

    void open_tags()
    {
        const dp::PrmLayout& prm = personality_.prm;
        device_.user_prm_data.assign(prm.list == dp::TagList::none ? prm.min_length : prm.max_length, 0);
        if (prm.list == dp::TagList::none) return;
        device_.prm_comments.push_back(
            "User_Prm_Data: the tags of the parameters in the order of the modules,");
        device_.prm_comments.push_back("two octets each, high octet first, from octet " +
                                       std::to_string(prm.tags_at) + " on; the rest stays zero.");
    }

    void modules_of_choice()
    {
        const bool demand = personality_.demand_identifier != 0;
        device_.choice_of_modules = true;
        device_.max_module = static_cast<std::uint8_t>(personality_.max_parameters + (demand ? 1 : 0));
        plant_modules();
        if (!device_.modules.empty()) return;
        if (demand) device_.modules.push_back({facts_.demand_module, {personality_.demand_identifier}});
        for (const dp::Identifier& each : personality_.identifiers)
            device_.modules.push_back({module_name(each), {each.octets().begin(), each.octets().end()}});
    }

    void plant_modules()
    {
        for (const PlantModule& module : wanted_.modules)
            device_.modules.push_back(
                {notes_.text_of("name of the module " + module.name, module.name, gsd::kMaxText),
                 module.identifiers});
    }

    /// The plant's own modules or tags: the master's tool puts the modules together.
    void choice()
    {
        if (wanted_.tags && !words_.empty())
            refuse("tags_and_list",
                   "the tags are listed beside parameters with a direction: keep one of them.");
        if (wanted_.tags)
            for (const std::uint16_t tag : *wanted_.tags)
                note_tag(profile_, tag, "tag " + std::to_string(tag), notes_);
        note_parameters(profile_, personality_, words_, notes_);
        generic_lengths();
        modules_of_choice();
        std::vector<std::uint16_t> tags = wanted_.tags.value_or(std::vector<std::uint16_t>{});
        for (const GsdParameter& word : words_) tags.push_back(word.tag);
        if (tags.empty() && personality_.prm.list != dp::TagList::exact) return open_tags();
        put_tags(tags);
        if (wanted_.tags)
            device_.prm_comments.push_back(
                "User_Prm_Data: the tags of the modules' words in their order, from octet " +
                std::to_string(personality_.prm.tags_at) + " on, high octet first.");
        describe_words();
    }

    void put_tags(const std::vector<std::uint16_t>& tags)
    {
        const dp::PrmLayout& prm = personality_.prm;
        if (tags.empty() && prm.may_be_absent) return;
        device_.user_prm_data.assign(prm.tags_at, 0);
        for (const std::uint16_t tag : tags) {
            device_.user_prm_data.push_back(high(tag));
            device_.user_prm_data.push_back(low(tag));
        }
        if (device_.user_prm_data.size() < prm.min_length) device_.user_prm_data.resize(prm.min_length, 0);
    }

    /// Sets the lengths in which the file of the plant differs.
    void lengths()
    {
        const PlantLengths& own = wanted_.lengths;
        if (own.user_prm_data)
            device_.user_prm_data.resize(std::min<std::size_t>(*own.user_prm_data, dp::kMaxUserPrm), 0);
        if (own.max_module) device_.max_module = static_cast<std::uint8_t>(*own.max_module);
        if (own.max_input) device_.max_in = static_cast<std::uint8_t>(*own.max_input);
        if (own.max_output) device_.max_out = static_cast<std::uint8_t>(*own.max_output);
        if (own.max_data) device_.max_data = static_cast<std::uint16_t>(*own.max_data);
    }

    /// A name for several words has the octets as well, so that names differ.
    std::string module_name(const dp::Identifier& each) const
    {
        const std::string name = gsd::latin1(each.reads > 0 && each.writes > 0 ? facts_.in_out_module
                                             : each.reads > 0                  ? facts_.in_module
                                                                               : facts_.out_module);
        const bool is_own =
            std::find(profile_.personality.identifiers.begin(), profile_.personality.identifiers.end(),
                      each) != profile_.personality.identifiers.end();
        return is_own ? name : (name + ' ' + profile::to_string(each)).substr(0, gsd::kMaxText);
    }

    /// Returns whether octets can be made of the words, refused or not.
    bool fits()
    {
        for (const GsdParameter& word : words_) {
            in_ += reads(word) ? 2U : 0U;
            out_ += writes(word) ? 2U : 0U;
        }
        if (wanted_.demand) {
            in_ += dp::kDemandOctets;
            out_ += dp::kDemandOctets;
        }
        if (in_ > kMaxOctets || out_ > kMaxOctets ||
            personality_.prm.tags_at + 2 * words_.size() > dp::kMaxUserPrm) {
            refuse(
                "too_many_octets",
                "more than 244 octets in one direction, or more tags than Set_Prm has room for, do not fit in a telegram: remove parameters.");
            return false;
        }
        if (wanted_.demand && personality_.demand_identifier == 0) {
            notes_.field = "demand";
            refuse("no_demand_data", "the device of the profile " + profile_.name +
                                         " has no Demand Data: leave Demand Data out.");
            return false;
        }
        if (personality_.prm.list == dp::TagList::none) return false;
        if (words_.empty() || !identifiers().empty()) return true;
        if (std::all_of(words_.begin(), words_.end(),
                        [this](const auto& word) { return identifier_for(personality_, word) != nullptr; }))
            refuse(
                "no_such_words",
                "the identifiers of the station have more words in a row than there are parameters of one direction: add parameters, or change their order.");
        return false;
    }

    /// The mapping as it was chosen: User_Prm_Data holds the tags, the modules all identifiers in their
    /// order. Up to 17 octets they are one module of a compact station, which every tool supports and which
    /// has no wrong order (two inputs that change places have the same identifiers, so the slave could not
    /// see it). More become several modules in a fixed order.
    void fixed()
    {
        std::vector<std::uint8_t> cfg;
        if (wanted_.demand) cfg.push_back(personality_.demand_identifier);
        std::vector<std::size_t> ends; // of modules
        std::size_t begin = 0;
        for (const dp::Identifier* one : identifiers()) {
            for (std::size_t word = 0; word < one->words(); ++word)
                draft_.cfg_places.emplace_back(cfg.size(), one->length);
            if (cfg.size() + one->length - begin > gsd::kMaxModuleOctets) ends.push_back(begin = cfg.size());
            cfg.insert(cfg.end(), one->octets().begin(), one->octets().end());
        }
        ends.push_back(cfg.size());
        std::vector<std::uint16_t> tags;
        for (const GsdParameter& word : words_) tags.push_back(word.tag);
        put_tags(tags);

        device_.choice_of_modules = false;
        plant_modules();
        if (device_.modules.empty()) own_modules(cfg, ends);
        device_.max_module = static_cast<std::uint8_t>(device_.modules.size());
        device_.max_in = static_cast<std::uint8_t>(in_);
        device_.max_out = static_cast<std::uint8_t>(out_);
        device_.max_data = static_cast<std::uint16_t>(in_ + out_);
        describe_words();
    }

    void own_modules(const std::vector<std::uint8_t>& cfg, const std::vector<std::size_t>& ends)
    {
        std::size_t begin = 0, words = 0;
        for (const std::size_t end : ends) {
            const std::size_t before = words;
            const auto is_its = [&](const auto& place) { return place.first >= begin && place.first < end; };
            words += static_cast<std::size_t>(
                std::count_if(draft_.cfg_places.begin(), draft_.cfg_places.end(), is_its));
            device_.modules.push_back({name_of_module(begin == 0 && wanted_.demand, before + 1, words),
                                       {cfg.begin() + static_cast<std::ptrdiff_t>(begin),
                                        cfg.begin() + static_cast<std::ptrdiff_t>(end)}});
            begin = end;
        }
    }

    /// "Demand Data, parameters 1 to 16": the longest is 31 characters while there are below 100.
    static std::string name_of_module(bool demand, std::size_t first, std::size_t last)
    {
        if (last < first) return "Demand Data";
        std::string name = demand ? "Demand Data, p" : "P";
        name += first == last ? "arameter " + std::to_string(first)
                              : "arameters " + std::to_string(first) + " to " + std::to_string(last);
        return name;
    }

    void describe_words()
    {
        if (words_.empty()) return;
        device_.prm_comments.push_back("User_Prm_Data: the tags of the parameters, from octet " +
                                       std::to_string(personality_.prm.tags_at) + " on, high octet first:");
        std::size_t number = 0;
        for (const GsdParameter& word : words_) {
            const drive::Tag* tag = profile_.tags.find(word.tag);
            std::string line =
                std::to_string(++number) +
                (word.direction == Direction::in_out ? " in/out" : ' ' + std::string{text(word.direction)}) +
                " tag " + std::to_string(word.tag);
            if (tag != nullptr) line += ' ' + gsd::latin1(tag->name);
            device_.prm_comments.push_back(std::move(line));
        }
    }

    void head()
    {
        device_.comments.push_back("Made for the profile " + profile_.name + " of dpslaved by the command");
        device_.comments.push_back(
            make_command(profile_, wanted_, standard_ ? std::nullopt : std::optional{words_}, description_));
    }

    const Profile& profile_;
    const dp::Personality personality_; ///< with the keys of the selection
    const GsdFacts& facts_;
    const Selection& wanted_;
    bool standard_ = false;  ///< the profile's own mapping
    bool generic_ = false;   ///< no mapping at all
    bool is_choice_ = false; ///< the plant's own modules or tags, in an order of the master's project
    std::vector<GsdParameter> words_;
    std::size_t in_ = 0, out_ = 0; ///< octets
    std::string description_;      ///< where the selection says none
    Draft draft_;
    Notes notes_{draft_.notes};
    gsd::Device& device_ = draft_.device;
};

} // namespace

Draft made(const Profile& profile, const Selection& selection)
{
    return DeviceMaker{profile, selection}.make();
}

} // namespace dpslave::profile
