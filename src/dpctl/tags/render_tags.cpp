// SPDX-License-Identifier: Apache-2.0
#include "render_tags.hpp"

#include "dpctl/cli/table.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using drive::Access;
using drive::Tag;

constexpr std::uint16_t kMaxStandardTag = 2047;  ///< 11 bits
constexpr std::uint16_t kMaxExtendedTag = 16383; ///< 2408f/2404f handbook ch. 7
constexpr std::uint16_t kFirstIeeeRegister = 0x8000;

/// The words that the master writes into register 1 (HA389815 ch. 7; 2408f/2404f handbook ch. 7).
struct DemandWords {
    std::uint16_t read, write;
    bool extended;
};
std::optional<DemandWords> demand_words(const TagHit& hit)
{
    const std::uint16_t tag = hit.tag->number;
    if (tag <= kMaxStandardTag)
        return DemandWords{static_cast<std::uint16_t>(0x1000 + tag), static_cast<std::uint16_t>(0x2000 + tag),
                           false};
    if (tag <= kMaxExtendedTag && hit.file->extended_demand) return DemandWords{0x3000, 0x4000, true};
    return std::nullopt;
}

bool never_written(const TagHit& hit)
{
    const auto& tags = hit.file->never_written;
    return std::find(tags.begin(), tags.end(), hit.tag->number) != tags.end();
}

std::string_view access_text(const TagHit& hit)
{
    if (never_written(hit)) return "read only: the gateway never writes it";
    switch (hit.tag->access) {
        case Access::read_only: return "read only";
        case Access::read_write: return "read and write";
        case Access::write_only: return "write only";
        case Access::unknown: break;
    }
    return "not known: the device decides";
}

std::string demand_text(const TagHit& hit)
{
    const auto words = demand_words(hit);
    if (!words)
        return fmt::format("none: it takes tags up to {}",
                           hit.file->extended_demand ? kMaxExtendedTag : kMaxStandardTag);
    std::string text;
    if (hit.tag->access != Access::write_only) text = "read " + word(words->read);
    if (hit.tag->access != Access::read_only && !never_written(hit))
        text += (text.empty() ? "write " : ", write ") + word(words->write);
    if (words->extended) text += ", with " + word(hit.tag->number) + " in register 2";
    return text;
}

std::string type_text(const Tag& tag)
{
    std::string text{drive::type_name(tag)};
    if (tag.type != drive::TagType::number) return text;
    if (tag.is_unsigned) text += ", unsigned";
    if (tag.follows_display)
        return text + fmt::format(", decimals as the display has them ({} here)", tag.decimals);
    if (tag.in_counts) return text + ", in counts: its decimals are not known";
    return text + (tag.decimals == 0 ? "" : ", " + plural(tag.decimals, "decimal"));
}

/// A limit as the drive shows it; labels would only disturb.
std::string limit(const Tag& tag, std::int32_t counts)
{
    if (tag.type == drive::TagType::word) return fmt::format("0x{:04X}", static_cast<std::uint16_t>(counts));
    Tag bare = tag;
    bare.labels.clear();
    return drive::displayed(bare, static_cast<std::uint16_t>(counts));
}

std::string limits(const Tag& tag)
{
    if (tag.min && tag.max) return limit(tag, *tag.min) + " to " + limit(tag, *tag.max);
    if (tag.min) return "at least " + limit(tag, *tag.min);
    return tag.max ? "at most " + limit(tag, *tag.max) : std::string{};
}

std::uint16_t modbus_register(const Tag& tag)
{
    return tag.modbus_register.value_or(tag.number);
}

std::string modbus_text(const Tag& tag)
{
    const std::uint16_t number = modbus_register(tag);
    if (number < kFirstIeeeRegister) return fmt::format("register {}", number);
    return fmt::format("registers {} and {}, IEEE", number, number + 1);
}

std::string mnemonic(const TagHit& hit)
{
    const auto two = drive::mnemonic_of(*hit.tag, hit.file->mnemonics);
    return two ? std::string{two->begin(), two->end()} : std::string{};
}

std::string labels(const Tag& tag, bool bits)
{
    std::string lines;
    for (const drive::Label& label : tag.labels)
        if (label.is_bit == bits)
            lines += fmt::format("{}{} = {}", lines.empty() ? "" : "\n", label.number, label.text);
    return lines;
}

Json labels_json(const Tag& tag, bool bits)
{
    Json list = Json::array();
    for (const drive::Label& label : tag.labels)
        if (label.is_bit == bits) list.push_back({{"number", label.number}, {"text", label.text}});
    return list;
}

std::string profiles(const TagFile& file)
{
    std::string names;
    for (const DeviceOfTable& device : file.devices) names += (names.empty() ? "" : ", ") + device.profile;
    return names;
}

std::string joined_aliases(const Tag& tag)
{
    std::string names;
    for (const std::string& alias : tag.aliases) names += (names.empty() ? "" : ", ") + alias;
    return names;
}

std::string when_text(const Tag& tag)
{
    switch (tag.when) {
        case drive::WritableWhen::not_said: return {};
        case drive::WritableWhen::stopped: return "only while the drive is stopped";
        case drive::WritableWhen::configuration: return "only in configuration mode";
    }
    return {};
}

void add_if(Block& block, const char* name, std::string value)
{
    if (!value.empty()) block.add(name, std::move(value));
}

std::string in_full(const TagHit& hit, Look look)
{
    const Tag& tag = *hit.tag;
    Block block;
    add_if(block, "also", joined_aliases(tag));
    block.add("type", type_text(tag));
    add_if(block, "limits", limits(tag));
    add_if(block, "values", labels(tag, false));
    add_if(block, "bits", labels(tag, true));
    block.add("access", std::string{access_text(hit)});
    add_if(block, "writable", when_text(tag));
    block.add("Demand Data", demand_text(hit));
    block.add("Modbus", modbus_text(tag));
    add_if(block, "mnemonic", mnemonic(hit));
    add_if(block, "section", tag.section);
    add_if(block, "notes", tag.notes);
    add_if(block, "profiles", profiles(*hit.file));
    return painted(fmt::format("{}: tag {} (0x{:04X}) {}", hit.file->name, tag.number, tag.number, tag.name),
                   Tone::strong, look) +
           '\n' + block.str(2, look);
}

} // namespace

Json tags_json(const TagHits& hits)
{
    Json list = Json::array();
    for (const TagHit& hit : hits.hits) {
        const Tag& tag = *hit.tag;
        const auto words = demand_words(hit);
        const std::string two = mnemonic(hit);
        Json demand = nullptr;
        if (words)
            demand = {{"read", fmt::format("{:04X}", words->read)},
                      {"write", fmt::format("{:04X}", words->write)},
                      {"extended", words->extended}};
        list.push_back({{"table", hit.file->name},
                        {"tag", tag.number},
                        {"hex", fmt::format("{:04X}", tag.number)},
                        {"name", tag.name},
                        {"aliases", tag.aliases},
                        {"type", drive::type_name(tag)},
                        {"decimals", tag.decimals},
                        {"follows_display", tag.follows_display},
                        {"unsigned", tag.is_unsigned},
                        {"min", tag.min ? Json(limit(tag, *tag.min)) : Json(nullptr)},
                        {"max", tag.max ? Json(limit(tag, *tag.max)) : Json(nullptr)},
                        {"access", access_text(hit)},
                        {"when", drive::text(tag.when)},
                        {"mnemonic", two.empty() ? Json(nullptr) : Json(two)},
                        {"modbus_register", modbus_register(tag)},
                        {"demand_data", demand},
                        {"values", labels_json(tag, false)},
                        {"bits", labels_json(tag, true)},
                        {"section", tag.section},
                        {"notes", tag.notes}});
    }
    return {{"tags", list}};
}

std::string render_tags(const TagHits& hits, Look look)
{
    std::string out;
    if (hits.hits.size() > kMostTagsInFull) {
        Table table({"TABLE", ">TAG", "HEX", "NAME", "TYPE", "ACCESS", "SECTION"});
        for (const TagHit& hit : hits.hits)
            table.add({hit.file->name, std::to_string(hit.tag->number),
                       fmt::format("{:04X}", hit.tag->number), hit.tag->name,
                       std::string{drive::type_name(*hit.tag)}, std::string{access_text(hit)},
                       hit.tag->section});
        out = table.str(look) + "\nall about one of them: dpctl tag NUMBER\n";
    } else {
        for (const TagHit& hit : hits.hits) out += (out.empty() ? "" : "\n") + in_full(hit, look);
    }
    if (hits.left_out > 0)
        out += fmt::format("\n{} more with these words; --all shows them\n",
                           plural(static_cast<std::int64_t>(hits.left_out), "name"));
    return out;
}

Json tables_json(const std::vector<TagFile>& files)
{
    Json tables = Json::array(), without = Json::array();
    for (const TagFile& file : files) {
        Json names = Json::array();
        for (const DeviceOfTable& device : file.devices) {
            if (file.is_only_form())
                without.push_back({{"profile", device.profile}, {"device", device.device}});
            else
                names.push_back(device.profile);
        }
        tables.push_back({{"table", file.name}, {"tags", file.tags.all().size()}, {"profiles", names}});
    }
    return {{"tables", tables}, {"without", without}};
}

std::string render_tables(const std::vector<TagFile>& files, Look look)
{
    Table tables({"TABLE", ">TAGS", "PROFILES"}), without({"PROFILE", "DEVICE"});
    for (const TagFile& file : files) {
        tables.add({file.name, std::to_string(file.tags.all().size()),
                    file.is_only_form() ? "none: it only has the form of a table" : profiles(file)});
        if (!file.is_only_form()) continue;
        for (const DeviceOfTable& device : file.devices) without.add({device.profile, device.device});
    }
    std::string out = tables.str(look);
    if (!without.empty())
        out +=
            "\nOf these devices no public tag table exists. Their tags and scaling are those of the drive's product manual,\nin decimal: write a table of the tags that you use, and name it in the station (tags = \"FILE.csv\").\n" +
            without.str(look, 2);
    return out;
}

} // namespace dpslave::dpctl
