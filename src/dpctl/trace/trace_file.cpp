// SPDX-License-Identifier: Apache-2.0
#include "trace_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace dpslave::dpctl {
namespace {

std::string refusal(const std::string& path, const char* what)
{
    return path + " cannot be " + what + ": " + std::generic_category().message(errno);
}

} // namespace

Result<TraceFile, std::string> TraceFile::create(const std::string& path, pcapng::LinkType link_type)
{
    std::ofstream file{path, std::ios::binary | std::ios::trunc};
    if (!file) return Failure{refusal(path, "created")};
    TraceFile made{path, std::move(file)};
    made.write(pcapng::file_header(
        "dpctl trace",
        "Times are those of the first character, computed from the read, the length and the rate.",
        {{.link_type = static_cast<std::uint16_t>(link_type), .name = "bus", .description = "PROFIBUS"}}));
    return made;
}

void TraceFile::write(const pcapng::Octets& octets)
{
    file_.write(reinterpret_cast<const char*>(octets.data()), static_cast<std::streamsize>(octets.size()));
}

void TraceFile::add(const trace::Entry& entry, const TraceWords& words, UnixOffset offset,
                    std::string_view note)
{
    if (entry.what == trace::Entry::What::lost) {
        dropped_ += entry.count;
        dropped_before_ += entry.count;
    }
    auto packet = packet_of(entry, words, offset);
    if (!packet) return;
    if (!note.empty()) packet->comments.emplace_back(note);
    if (const std::uint64_t dropped = std::exchange(dropped_before_, 0); dropped != 0)
        packet->dropped = dropped;
    ++received_;
    write(block(*packet));
}

std::optional<std::string> TraceFile::finish(std::int64_t unix_ns)
{
    write(pcapng::block(
        pcapng::Statistics{.interface = 0, .unix_ns = unix_ns, .received = received_, .dropped = dropped_}));
    file_.flush();
    if (!file_) return refusal(path_, "written");
    return std::nullopt;
}

} // namespace dpslave::dpctl
