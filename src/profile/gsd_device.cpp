// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/gsd_device.hpp"

#include "gsd_command.hpp"

#include <algorithm>
#include <set>

namespace dpslave::profile {
namespace {

constexpr std::size_t kMaxOctets = 244; ///< of one direction (wire reference 4.6)

bool reads(const Parameter& parameter)
{
    return parameter.direction != Direction::out;
}

bool writes(const Parameter& parameter)
{
    return parameter.direction != Direction::in;
}

class DeviceMaker {
public:
    DeviceMaker(const Profile& profile, const Selection& selection)
        : profile_(profile), personality_(profile.personality), facts_(profile.gsd), wanted_(selection)
    {
        Selection own;
        own.in = facts_.in_tags;
        own.out = facts_.out_tags;
        words_ = selection.parameters();
        standard_ = !own.parameters().empty() && (!selection.says_parameters() || words_ == own.parameters());
        if (standard_) words_ = own.parameters();
        generic_ = words_.empty() && !selection.demand;
    }

    Draft make()
    {
        identity();
        rates();
        behaviour();
        if (generic_) {
            generic();
        } else {
            check_tags();
            check_lengths();
            if (fits()) fixed();
        }
        head();
        draft_.parameters = std::move(words_);
        return std::move(draft_);
    }

private:
    void refuse(std::string_view code, std::string sentence)
    {
        draft_.notes.push_back({true, code, std::move(sentence), at_});
    }
    void warn(std::string_view code, std::string sentence)
    {
        draft_.notes.push_back({false, code, std::move(sentence), at_});
    }

    std::string text_of(std::string_view what, const std::string& text, std::size_t longest)
    {
        std::string out = gsd::latin1(text);
        if (out.size() > longest)
            refuse("text_too_long", "the " + std::string{what} + " has " + std::to_string(out.size()) +
                                        " characters: a GSD has room for " + std::to_string(longest) + '.');
        if (out.find('?') != std::string::npos && text.find('?') == std::string::npos)
            warn("character_lost",
                 "a character of the " + std::string{what} +
                     " is none of ISO 8859-1, the character set of a GSD, and becomes a question mark.");
        return out;
    }

    void identity()
    {
        device_.vendor = text_of("vendor", facts_.vendor, gsd::kMaxText);
        device_.model = text_of("model", wanted_.model.value_or(facts_.model), gsd::kMaxText);
        device_.revision = text_of("revision", facts_.revision, gsd::kMaxText);
        device_.hardware = text_of("hardware release", facts_.hardware, gsd::kMaxText);
        device_.software = text_of("software release", facts_.software, gsd::kMaxText);
        device_.description =
            text_of("description", wanted_.description.value_or(own_description()), gsd::kMaxDescription);
        const auto ident = wanted_.ident ? wanted_.ident : profile_.ident;
        if (!ident)
            refuse(
                "ident_missing",
                "the profile " + profile_.name +
                    " has no Ident_Number, because no source states it: give that of your device. It is in "
                    "the GSD file that came with the device, in the present project of the master, and in "
                    "octets 5 and 6 of the device's diagnosis. Write the same into the station (ident = "
                    "0x...).");
        else if (*ident == 0)
            refuse("ident_missing", "the Ident_Number 0 belongs to no device: give that of your device.");
        else if (profile_.ident && *ident != *profile_.ident)
            warn("ident_differs", "the Ident_Number is not that of the profile " + profile_.name + ", " +
                                      hex_of(*profile_.ident) + ": write ident = " + hex_of(*ident) +
                                      " into the station, else it refuses the master.");
        device_.ident = ident.value_or(0);
    }

    /// It speaks of the profile's own mapping, so not of another one.
    std::string own_description() const { return generic_ || standard_ ? facts_.description : std::string{}; }

    void rates()
    {
        const std::uint32_t own = wanted_.max_tsdr.value_or(0);
        bool larger = false;
        for (const Baud baud : kBauds) {
            const Tbit bits = personality_.max_tsdr[index_of(baud)];
            if (bits.count == 0 || baud == Baud::k45_45)
                continue; // only ever fixed by hand, so no tool offers it
            device_.max_tsdr[index_of(baud)] = std::max(bits, Tbit{own});
            larger = larger || own > bits.count;
        }
        if (own > 0xFFFF)
            refuse("max_tsdr_too_high",
                   "MaxTsdr is " + std::to_string(own) + ": a GSD has room for 65535 bit times.");
        if (wanted_.max_tsdr && !larger)
            refuse("max_tsdr_no_effect",
                   "MaxTsdr " + std::to_string(own) + " is at no rate larger than that of the profile " +
                       profile_.name + ": leave it out, or give what [bus] max_tsdr of the daemon says.");
        if (own > 1000)
            warn("max_tsdr_long",
                 "MaxTsdr is above 1000 bit times: many masters do not wait that long; check that yours "
                 "does.");
    }

    void behaviour()
    {
        device_.family = facts_.family;
        device_.repeater = facts_.repeater;
        device_.freeze = personality_.freeze;
        device_.sync = personality_.sync;
        device_.fail_safe = personality_.fail_safe;
        device_.min_slave_interval = facts_.min_slave_interval;
        device_.max_diag_length = static_cast<std::uint8_t>(personality_.max_diag_length);
    }

    const dp::Identifier* identifier(const Parameter& word) const
    {
        const auto found = std::find_if(personality_.identifiers.begin(), personality_.identifiers.end(),
                                        [&](const dp::Identifier& each) {
                                            return each.reads == reads(word) && each.writes == writes(word);
                                        });
        return found == personality_.identifiers.end() ? nullptr : &*found;
    }

    /// The modules by their names; the master's tool puts them together, the engineer enters the tags.
    void generic()
    {
        const std::size_t parameters = personality_.max_parameters;
        const bool demand = personality_.demand_identifier != 0;
        const std::size_t longest = (demand ? dp::kDemandOctets : 0) + 2 * parameters;
        const std::size_t both = identifier({Direction::in_out}) != nullptr ? 2 : 1;
        std::size_t sum = 2 * (demand ? dp::kDemandOctets : 0) + 2 * both * parameters;
        if (personality_.max_words > 0) sum = std::min(sum, 2 * personality_.max_words);
        const dp::PrmLayout& prm = personality_.prm;
        if (prm.list == dp::TagList::exact)
            return refuse("no_mapping",
                          "the tags of a " + profile_.name +
                              " stand in the GSD, one for each word, and none is chosen: choose tags as "
                              "inputs and outputs, or Demand Data alone.");
        device_.choice_of_modules = true;
        device_.max_module = static_cast<std::uint8_t>(parameters + (demand ? 1 : 0));
        device_.max_in = device_.max_out = static_cast<std::uint8_t>(std::min(longest, kMaxOctets));
        device_.max_data = static_cast<std::uint16_t>(std::min(sum, 2 * kMaxOctets));
        if (demand) device_.modules.push_back({facts_.demand_module, {personality_.demand_identifier}});
        for (const dp::Identifier& each : personality_.identifiers)
            device_.modules.push_back({gsd::latin1(module_name(each)), {each.octet}});
        device_.user_prm_data.assign(prm.list == dp::TagList::none ? prm.min_length : prm.max_length, 0);
        if (prm.list == dp::TagList::none) return;
        device_.prm_comments.push_back(
            "User_Prm_Data: the tags of the parameters in the order of the modules,");
        device_.prm_comments.push_back("two octets each, high octet first, from octet " +
                                       std::to_string(prm.tags_at) + " on; the rest stays zero.");
    }

    const std::string& module_name(const dp::Identifier& each) const
    {
        if (each.reads && each.writes) return facts_.in_out_module;
        return each.reads ? facts_.in_module : facts_.out_module;
    }

    void check_tags()
    {
        std::set<std::uint16_t> read, written;
        for (std::size_t at = 0; at < words_.size(); ++at) {
            const Parameter& word = words_[at];
            at_ = at;
            const std::string name = "tag " + std::to_string(word.tag);
            if (identifier(word) == nullptr)
                refuse("no_such_direction",
                       name + ": the profile " + profile_.name +
                           " has no identifier for a parameter that is both read and written: choose it "
                           "once as input and once as output.");
            if (personality_.prm.list == dp::TagList::none)
                refuse("no_tags", name + ": the device of the profile " + profile_.name +
                                      " takes no tags from the master.");
            else if (word.tag == 0 || word.tag > personality_.prm.max_tag)
                refuse("tag_out_of_range", name + " is not a tag: tags of the profile " + profile_.name +
                                               " go from 1 to " + std::to_string(personality_.prm.max_tag) +
                                               '.');
            if (reads(word) && !read.insert(word.tag).second)
                refuse("read_twice", name + " is read twice: remove one.");
            if (writes(word) && !written.insert(word.tag).second)
                refuse("written_twice",
                       name + " is written twice, and the two values would conflict: remove one.");
            check_access(word, name);
        }
        at_.reset();
    }

    void check_access(const Parameter& word, const std::string& name)
    {
        const drive::Tag* tag = profile_.tags.find(word.tag);
        if (tag == nullptr && profile_.tags_only_from_table)
            refuse("tag_not_listed", name + " is not in the tag table of the profile " + profile_.name +
                                         ", and the profile allows no other: choose one of the table.");
        const auto& never = profile_.never_written;
        const bool locked = std::find(never.begin(), never.end(), word.tag) != never.end();
        if (writes(word) && locked)
            refuse("never_written",
                   name + " must never be written: the profile " + profile_.name + " says so.");
        else if (writes(word) && tag != nullptr && tag->access == drive::Access::read_only)
            warn("read_only",
                 name + " (" + tag->name + ") is read only: the drive will refuse what the master writes.");
        if (tag != nullptr && tag->type == drive::TagType::string)
            warn("text_tag", name + " (" + tag->name + ") is a text, which is not transported.");
    }

    void check_lengths()
    {
        for (const Parameter& word : words_) {
            in_ += reads(word) ? 2U : 0U;
            out_ += writes(word) ? 2U : 0U;
        }
        if (wanted_.demand) {
            in_ += dp::kDemandOctets;
            out_ += dp::kDemandOctets;
            if (personality_.demand_identifier == 0)
                refuse("no_demand_data", "the device of the profile " + profile_.name +
                                             " has no Demand Data: leave Demand Data out.");
        }
        if (words_.size() > personality_.max_parameters)
            refuse("too_many_parameters", std::to_string(words_.size()) + " parameters are more than a " +
                                              profile_.name + " has, " +
                                              std::to_string(personality_.max_parameters) +
                                              ": remove some, and use Demand Data for them.");
        if (words_.empty() && !personality_.may_have_no_parameters)
            refuse("no_parameters",
                   "a " + profile_.name + " needs at least one parameter: choose one as input or output.");
        const std::size_t words = (in_ + out_) / 2;
        if (personality_.max_words > 0 && words > personality_.max_words)
            refuse("too_many_words", std::to_string(words) + " words in and out" +
                                         (wanted_.demand ? ", 8 of them Demand Data," : "") +
                                         " are more than a " + profile_.name + " has, " +
                                         std::to_string(personality_.max_words) + ": remove " +
                                         std::to_string(words - personality_.max_words) + ".");
        if (in_ > kMaxOctets || out_ > kMaxOctets)
            refuse("too_many_octets",
                   "more than 244 octets in one direction do not fit in a telegram: remove parameters.");
    }

    /// Whether octets can be made of the words, refused or not.
    bool fits() const
    {
        return in_ <= kMaxOctets && out_ <= kMaxOctets && personality_.prm.list != dp::TagList::none &&
               personality_.prm.tags_at + 2 * words_.size() <= dp::kMaxUserPrm &&
               std::all_of(words_.begin(), words_.end(),
                           [this](const Parameter& word) { return identifier(word) != nullptr; });
    }

    /// The mapping as it was chosen: User_Prm_Data holds the tags, the modules all identifiers in their
    /// order. Up to 17 octets they are one module of a compact station, which every tool supports and which
    /// has no wrong order (two inputs that change places have the same identifiers, so the slave could not
    /// see it). More become several modules in a fixed order.
    void fixed()
    {
        const dp::PrmLayout& prm = personality_.prm;
        std::vector<std::uint8_t> identifiers;
        if (wanted_.demand) identifiers.push_back(personality_.demand_identifier);
        const bool none_sent = words_.empty() && prm.may_be_absent;
        if (!none_sent) device_.user_prm_data.assign(prm.tags_at, 0);
        for (const Parameter& word : words_) {
            identifiers.push_back(identifier(word)->octet);
            device_.user_prm_data.push_back(static_cast<std::uint8_t>(word.tag >> 8));
            device_.user_prm_data.push_back(static_cast<std::uint8_t>(word.tag & 0xFF));
        }
        if (!none_sent && device_.user_prm_data.size() < prm.min_length)
            device_.user_prm_data.resize(prm.min_length, 0);

        device_.choice_of_modules = false;
        for (std::size_t at = 0; at < identifiers.size(); at += gsd::kMaxModuleOctets) {
            const std::size_t end = std::min(at + gsd::kMaxModuleOctets, identifiers.size());
            device_.modules.push_back({name_of_module(at, end),
                                       {identifiers.begin() + static_cast<std::ptrdiff_t>(at),
                                        identifiers.begin() + static_cast<std::ptrdiff_t>(end)}});
        }
        device_.max_module = static_cast<std::uint8_t>(device_.modules.size());
        device_.max_in = static_cast<std::uint8_t>(in_);
        device_.max_out = static_cast<std::uint8_t>(out_);
        device_.max_data = static_cast<std::uint16_t>(in_ + out_);
        describe_words();
    }

    /// "Demand Data, parameters 1 to 16": the longest is 31 characters while there are below 100.
    std::string name_of_module(std::size_t at, std::size_t end) const
    {
        const bool demand = wanted_.demand && at == 0;
        const std::size_t shift = wanted_.demand ? 1 : 0;
        const std::size_t first = at + (demand ? 1 : 0) + 1 - shift;
        const std::size_t last = end - shift;
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
        for (const Parameter& word : words_) {
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
        device_.comments.push_back(make_command(
            profile_, wanted_, standard_ ? std::nullopt : std::optional{words_}, own_description()));
    }

    const Profile& profile_;
    const dp::Personality& personality_;
    const GsdFacts& facts_;
    const Selection& wanted_;
    bool standard_ = false; ///< the profile's own mapping
    bool generic_ = false;  ///< no mapping at all
    std::vector<Parameter> words_;
    std::optional<std::size_t> at_; ///< the word that is judged
    std::size_t in_ = 0, out_ = 0;  ///< octets
    Draft draft_;
    gsd::Device& device_ = draft_.device;
};

} // namespace

Draft draft_of(const Profile& profile, const Selection& selection)
{
    return DeviceMaker{profile, selection}.make();
}

Result<GsdDevice, std::vector<std::string>> device_of(const Profile& profile, const Selection& selection)
{
    Draft draft = draft_of(profile, selection);
    std::vector<std::string> warnings, refused;
    for (Note& note : draft.notes) (note.refuses ? refused : warnings).push_back(std::move(note.text));
    if (!refused.empty()) return Failure{std::move(refused)};
    return GsdDevice{std::move(draft.device), std::move(warnings)};
}

} // namespace dpslave::profile
