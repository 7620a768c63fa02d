// SPDX-License-Identifier: Apache-2.0
#include "meaning.hpp"

#include "facts.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/sent.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

namespace dpslave::configurator {
namespace {

/// 0x1F and 31 are the same.
std::string number_or_word(const std::string& word)
{
    const bool hex = word.starts_with("0x") || word.starts_with("0X");
    std::uint32_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + (hex ? 2 : 0), end, value, hex ? 16 : 10);
    return error == std::errc{} && stop == end ? std::to_string(value) : to_lower(word);
}

/// A value without what does not matter: blanks, the form of numbers, the case of words. Texts stay as they
/// are.
std::string normal(std::string_view value)
{
    std::string out, word;
    const auto end_word = [&] {
        if (!word.empty()) out += number_or_word(word);
        word.clear();
    };
    bool in_text = false;
    for (const char c : value) {
        if (c == '"') {
            end_word();
            in_text = !in_text;
            out += c;
        } else if (in_text) {
            out += c;
        } else if (c == ',' || c == ' ' || c == '\t' || c == '-') {
            end_word();
            if (c == ',' || c == '-') out += c;
        } else {
            word += c;
        }
    }
    end_word();
    return out;
}

/// One statement of a file by its name.
struct Said {
    std::string what, written, normal;
    unsigned line = 0;
};

class Sayings {
public:
    Sayings(const gsd::Document& document, const std::vector<std::uint8_t>& cfg)
    {
        for (const gsd::Entry& entry : document.keywords)
            if (!is_of_set_prm(entry.keyword)) add(name_of(entry), entry.value, entry.line);
        for (const gsd::Block& block : document.blocks)
            if (block.kind != "Module") add_block(block);
        const bool choice = gsd::plugging_of(document) == gsd::Plugging::choice;
        const auto used = choice && !cfg.empty() ? gsd::modules_in(document, cfg) : std::nullopt;
        const gsd::Sent sent = gsd::sent_by_master(document, used ? *used : gsd::plugged_modules(document));
        for (const gsd::Module& module : document.modules) {
            const std::string name = "module \"" + module.name + '"';
            if (choice) add('M' + name.substr(1), octets(module.identifiers), module.line);
            if (const auto own = gsd::own_parameters(document, module); choice && !own.empty())
                add("parameters of " + name, octets(own), module.line);
        }
        for (const gsd::Block& block : document.blocks)
            if (block.kind == "Module") add_rest_of_module(block, choice);
        add("Set_Prm", octets(sent.user.octets), line_of(document, "User_Prm_Data"));
        add("Chk_Cfg", octets(sent.cfg.octets), document.modules.empty() ? 0 : document.modules.front().line);
    }

    const std::vector<Said>& all() const { return all_; }

    const Said* find(const std::string& what) const
    {
        const auto found = places_.find(to_lower(what));
        return found == places_.end() ? nullptr : &all_[found->second];
    }

private:
    static bool is_of_set_prm(const std::string& keyword)
    {
        static constexpr std::array<std::string_view, 4> kOfSetPrm{
            "user_prm_data", "user_prm_data_len", "max_user_prm_data_len", "ext_user_prm_data_const"};
        return std::find(kOfSetPrm.begin(), kOfSetPrm.end(), to_lower(keyword)) != kOfSetPrm.end();
    }

    static std::string name_of(const gsd::Entry& entry)
    {
        return entry.index ? entry.keyword + '(' + std::to_string(*entry.index) + ')' : entry.keyword;
    }

    static std::string octets(const std::vector<std::uint8_t>& values)
    {
        std::string out;
        for (const std::uint8_t value : values) {
            out += out.empty() ? "" : " ";
            out += "0123456789ABCDEF"[value >> 4U];
            out += "0123456789ABCDEF"[value & 15U];
        }
        return out;
    }

    static unsigned line_of(const gsd::Document& document, std::string_view keyword)
    {
        const gsd::Entry* entry = document.find(keyword);
        return entry == nullptr ? 0 : entry->line;
    }

    /// Adds the keywords that are in no telegram, or only if an engineer changes it.
    void add_rest_of_module(const gsd::Block& module, bool is_choice)
    {
        for (const gsd::Entry& entry : module.body) {
            const std::string keyword = to_lower(entry.keyword);
            if ((keyword == "preset" && !is_choice) || keyword == "ext_module_prm_data_len" ||
                keyword == "ext_user_prm_data_const" || keyword.empty())
                continue;
            add(name_of(entry) + " of module " + module.head, entry.value, entry.line);
        }
    }

    void add_block(const gsd::Block& block)
    {
        std::string body;
        for (const gsd::Entry& entry : block.body)
            body += (body.empty() ? "" : "; ") +
                    (entry.keyword.empty() ? entry.value : name_of(entry) + " = " + entry.value);
        add(block.kind + ' ' + block.head, body, block.line);
    }

    /// The last one counts, as in the masters' tools.
    void add(std::string what, const std::string& value, unsigned line)
    {
        Said said{what, utf8_of_latin1(value), normal(value), line};
        const auto [place, is_new] = places_.emplace(to_lower(what), all_.size());
        if (is_new)
            all_.push_back(std::move(said));
        else
            all_[place->second] = std::move(said);
    }

    std::vector<Said> all_;
    std::map<std::string, std::size_t> places_;
};

std::string value_of(const gsd::IoValue& value)
{
    std::string text = value.is_demand || !value.tag ? value.what : "tag " + std::to_string(*value.tag);
    if (value.tag && value.what != text) text += ' ' + value.what;
    return text;
}

void compare(std::vector<Difference>& all, const std::string& direction,
             const std::vector<gsd::IoValue>& left, const std::vector<gsd::IoValue>& right)
{
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
        const gsd::IoValue* a = i < left.size() ? &left[i] : nullptr;
        const gsd::IoValue* b = i < right.size() ? &right[i] : nullptr;
        if (a != nullptr && b != nullptr && a->octet == b->octet && a->octets == b->octets &&
            value_of(*a) == value_of(*b))
            continue;
        const gsd::IoValue& one = i < left.size() ? left[i] : right[i];
        Difference difference{direction + " octets " + std::to_string(one.octet) + '-' +
                                  std::to_string(one.octet + one.octets - 1),
                              {},
                              {},
                              0};
        if (a != nullptr) difference.left = value_of(*a);
        if (b != nullptr) difference.right = value_of(*b);
        all.push_back(std::move(difference));
    }
}

struct Name {
    unsigned line = 0;
    std::string name; ///< UTF-8
};

/// Reads "; 3 out tag 6 Ramp rate": the tag and its name; returns nullopt if the line is no such comment.
std::optional<std::pair<std::uint32_t, std::string>> name_in(std::string_view line)
{
    constexpr std::string_view kTag = " tag ";
    const auto tag = line.find(kTag, 2);
    if (!line.starts_with("; ") || tag == std::string_view::npos) return std::nullopt;
    std::uint32_t place = 0, number = 0;
    const auto [behind, no_place] = std::from_chars(line.data() + 2, line.data() + tag, place);
    const std::string_view direction{behind, static_cast<std::size_t>(line.data() + tag - behind)};
    if (no_place != std::errc{} || (direction != " in" && direction != " out" && direction != " in/out"))
        return std::nullopt;
    const char* const end = line.data() + line.size();
    const auto [name, no_tag] = std::from_chars(line.data() + tag + kTag.size(), end, number);
    if (no_tag != std::errc{} || end - name < 2 || *name != ' ') return std::nullopt;
    return std::pair{number, utf8_of_latin1({name + 1, static_cast<std::size_t>(end - name) - 1})};
}

/// Returns the names by tag.
std::map<std::uint32_t, Name> names_in(std::string_view file)
{
    std::map<std::uint32_t, Name> names;
    for (unsigned line = 1; !file.empty(); ++line) {
        std::string_view text = file.substr(0, file.find('\n'));
        file.remove_prefix(std::min(file.size(), text.size() + 1));
        if (text.ends_with('\r')) text.remove_suffix(1);
        if (auto found = name_in(text)) names.try_emplace(found->first, Name{line, std::move(found->second)});
    }
    return names;
}

} // namespace

std::vector<Difference> differences(const gsd::Document& left, const gsd::Document& right,
                                    const std::vector<std::uint8_t>& cfg)
{
    const Sayings of_left{left, cfg}, of_right{right, cfg};
    std::vector<Difference> all;
    for (const Said& said : of_left.all()) {
        const Said* other = of_right.find(said.what);
        if (other != nullptr && other->normal == said.normal) continue;
        all.push_back({utf8_of_latin1(said.what), said.written,
                       other != nullptr ? std::optional{other->written} : std::nullopt, said.line});
    }
    for (const Said& said : of_right.all())
        if (of_left.find(said.what) == nullptr)
            all.push_back({utf8_of_latin1(said.what), std::nullopt, said.written, 0});
    return all;
}

std::vector<Difference> name_differences(std::string_view left, std::string_view right)
{
    const auto of_left = names_in(left), of_right = names_in(right);
    std::vector<Difference> all;
    for (const auto& [tag, here] : of_left) {
        const auto there = of_right.find(tag);
        if (there != of_right.end() && there->second.name == here.name) continue;
        all.push_back({"name of tag " + std::to_string(tag), here.name,
                       there != of_right.end() ? std::optional{there->second.name} : std::nullopt,
                       here.line});
    }
    return all;
}

void add_names(gsd::MapHints& hints, std::string_view file)
{
    for (const auto& [tag, name] : names_in(file))
        if (tag <= 0xFFFF) hints.names.emplace(static_cast<std::uint16_t>(tag), name.name);
}

std::vector<Difference> map_differences(const gsd::IoMap& left, const gsd::IoMap& right)
{
    std::vector<Difference> all;
    if (!left.fixed || !right.fixed) return all;
    compare(all, "input", left.inputs, right.inputs);
    compare(all, "output", left.outputs, right.outputs);
    return all;
}

} // namespace dpslave::configurator
