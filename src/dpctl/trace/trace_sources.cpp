// SPDX-License-Identifier: Apache-2.0
#include "trace_sources.hpp"

#include "dpctl/cli/station_keys.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/document.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace dpslave::dpctl {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 2000;

/// .gsd, and those of the languages: .gse, .gsg, .gsf, .gsi, .gss, .gsp.
bool is_gsd(const fs::path& file)
{
    const std::string extension = to_lower(file.extension().string());
    return extension.size() == 4 && extension.starts_with(".gs") &&
           std::string_view{"degfisp"}.find(extension[3]) != std::string_view::npos;
}

/// Sorted, so that of two files of one device always the same one counts.
Result<std::vector<fs::path>, std::string> gsd_files(const std::string& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error))
        if (is_gsd(at->path())) files.push_back(at->path());
    if (error) return Failure{fmt::format("{} cannot be read: {}", folder, error.message())};
    if (files.empty()) return Failure{fmt::format("there is no GSD file (*.gsd, *.gse ...) in {}", folder)};
    std::sort(files.begin(), files.end());
    if (files.size() > kMostFiles)
        return Failure{fmt::format("there are more than {} GSD files in {}", kMostFiles, folder)};
    return files;
}

/// A file that is no GSD is named and left out. Nothing: done; else why not, a sentence.
std::optional<std::string> read_gsd_folder(const std::string& folder, TraceDecoder& decoder,
                                           Terminal& terminal)
{
    const auto files = gsd_files(folder);
    if (!files) return files.error();
    for (const fs::path& file : *files) {
        const auto content = io::read_regular_file(file.string());
        const auto leave_out = [&](const std::string& why) {
            terminal.err << "dpctl: " << printable(file.string()) << " is left out: " << why << '\n';
        };
        if (!content) {
            leave_out(content.error().why);
            continue;
        }
        const gsd::Document document = gsd::parse(*content);
        const auto ident = document.number("Ident_Number");
        if (!ident || *ident > 0xFFFF)
            leave_out("it has no Ident_Number");
        else
            decoder.add_texts(static_cast<std::uint16_t>(*ident), diagnosis_texts(document));
    }
    return std::nullopt;
}

/// With resolution = "integer" a floating value is a whole number.
void round_to_integers(profile::Profile& device)
{
    std::vector<drive::Tag> tags = device.tags.all();
    for (drive::Tag& tag : tags)
        if (tag.is_real) {
            tag.decimals = 0;
            tag.follows_display = false;
            tag.in_counts = false;
        }
    device.tags = drive::TagTable{std::move(tags)};
}

/// The device as the station has it; the failure is a sentence.
Result<profile::Profile, std::string> device_of(const report::Info& info, const std::string& profiles)
{
    auto device = profile::load_profile(io::read_regular_file, profiles, info.profile);
    if (!device) return Failure{to_string(device.error().front())};
    if (info.tag_table != device->tag_file) {
        auto tags = profile::load_tags(io::read_regular_file, info.tag_table);
        if (!tags) return Failure{to_string(tags.error().front())};
        std::vector<drive::Tag> rows = tags->all();
        if (device->selectable_resolution) drive::mark_counts(rows);
        device->tags = drive::TagTable{std::move(rows)};
    }
    const profile::StationKeys keys = keys_of(info);
    if (profile::wrong_keys(*device, keys).empty())
        device->personality = profile::personality_of(*device, keys);
    device->ident = keys.ident;
    if (info.resolution == "integer") round_to_integers(*device);
    return *std::move(device);
}

std::vector<std::uint8_t> octets_in(const std::string& text)
{
    auto octets = read_octets({text});
    return octets ? *std::move(octets) : std::vector<std::uint8_t>{};
}

/// The stations that there are; none with a daemon that only listens.
std::optional<int> ask_stations(const TraceOptions& options, Session& session, TraceSources& into)
{
    const auto infos = session.ask("GetInfo");
    if (!infos) return infos.error();
    const auto diagnoses = session.ask("GetDiagnosis");
    if (!diagnoses) return diagnoses.error();
    const auto all = report::read<report::GetDiagnosisReply>(*diagnoses).stations;
    for (const report::Info& info : report::read<report::GetInfoReply>(*infos).stations) {
        auto device = device_of(info, options.profiles);
        if (!device) {
            session.terminal().err << fmt::format("dpctl: {} is decoded without the names of its tags: {}\n",
                                                  printable(info.name), printable(device.error()));
            continue;
        }
        TraceStation station{
            static_cast<std::uint8_t>(info.address_active & 0x7F), *std::move(device), {}, {}};
        for (const report::Diagnosis& one : all) {
            if (one.name != info.name) continue;
            station.last_prm = octets_in(one.last_prm);
            station.last_cfg = octets_in(one.last_cfg);
        }
        into.decoder.set_device(station.address, station.device);
        into.stations.push_back(std::move(station));
    }
    return std::nullopt;
}

Result<TraceSources, int> with_texts(TraceSources sources, const TraceOptions& options, Terminal& terminal)
{
    if (options.gsd_folder.empty()) return sources;
    if (const auto why = read_gsd_folder(options.gsd_folder, sources.decoder, terminal)) {
        terminal.err << "dpctl: " << printable(*why) << '\n';
        return Failure{int{kNo}};
    }
    return sources;
}

} // namespace

Result<TraceSources, int> trace_sources(const TraceOptions& options, Session& session)
{
    TraceSources sources;
    if (const auto failed = ask_stations(options, session, sources)) return Failure{*failed};
    return with_texts(std::move(sources), options, session.terminal());
}

Result<TraceSources, int> sources_of_capture(const TraceOptions& options,
                                             const std::map<std::uint8_t, std::uint16_t>& idents,
                                             Terminal& terminal)
{
    TraceSources sources;
    for (const auto& [address, ident] : idents) {
        if (options.profile.empty()) break;
        auto device = profile::load_profile(io::read_regular_file, options.profiles, options.profile);
        if (!device) {
            terminal.err << "dpctl: " << printable(to_string(device.error().front())) << '\n';
            return Failure{int{kNo}};
        }
        if (device->ident && *device->ident != ident) continue;
        device->ident = device->personality.ident = ident;
        sources.decoder.set_device(address, *std::move(device));
    }
    return with_texts(std::move(sources), options, terminal);
}

void set_layouts(TraceSources& sources, const std::bitset<128>& changed)
{
    for (const TraceStation& station : sources.stations)
        if (!changed.test(station.address))
            sources.decoder.set_layout(station.address, station.last_prm, station.last_cfg);
}

} // namespace dpslave::dpctl
