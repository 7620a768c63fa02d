// SPDX-License-Identifier: Apache-2.0
#include "folder.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/io/fd.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/io/new_file.hpp"
#include "dpslave/trace/incident_file.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <system_error>

namespace dpslave::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExtension = ".incident";
constexpr const char* kCounts = "counts.json";

using Json = report::Json;

std::string text_of_errno()
{
    return std::system_category().message(errno);
}

fs::path path_of(const fs::path& folder, std::uint64_t number)
{
    return folder / (std::to_string(number) + kExtension);
}

/// Nothing: it is not called as this program calls an incident.
std::optional<std::uint64_t> number_of(const fs::path& path)
{
    constexpr std::size_t kMostDigits = 18; // fits the interface's int
    const std::string stem = path.stem().string();
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
    const bool is_number = error == std::errc{} && end == stem.data() + stem.size() && number != 0 &&
                           stem.front() != '0' && stem.size() <= kMostDigits;
    if (path.extension() != kExtension || !is_number) return std::nullopt;
    return number;
}

/// The octets from `offset` on, as many as there are up to `most`.
Result<std::vector<std::uint8_t>, std::string> read_at(int fd, std::uint64_t offset, std::size_t most)
{
    std::vector<std::uint8_t> octets(most);
    std::size_t used = 0;
    while (used < most) {
        const ssize_t got = ::pread(fd, octets.data() + used, most - used, static_cast<off_t>(offset + used));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return Failure{"it cannot be read: " + text_of_errno()};
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
    }
    octets.resize(used);
    return octets;
}

struct OpenFile {
    io::Fd fd;
    std::uint64_t size = 0;
};
Result<OpenFile, std::string> open_file(const fs::path& path)
{
    OpenFile open{.fd = io::Fd{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)}};
    struct stat status {};
    if (!open.fd || ::fstat(open.fd.get(), &status) != 0)
        return Failure{"it cannot be read: " + text_of_errno()};
    if (!S_ISREG(status.st_mode)) return Failure{std::string{"it is no regular file"}};
    if (status.st_size > static_cast<off_t>(io::kMaxFileSize))
        return Failure{std::string{"it is larger than any incident"}};
    open.size = static_cast<std::uint64_t>(status.st_size);
    return open;
}

/// The head of a file whose checksum is right. Read in pieces, so that memory does not grow with the files.
Result<report::IncidentHead, std::string> judged_head(const fs::path& path)
{
    const auto open = open_file(path);
    if (!open) return Failure{open.error()};
    const auto begin = read_at(open->fd.get(), 0, trace::kIncidentMark.size() + trace::kLongestHead);
    if (!begin) return Failure{begin.error()};
    const auto head = trace::incident_head(*begin);
    if (!head) return Failure{head.error()};
    const Json json = Json::parse(*head, nullptr, false);
    if (!json.is_object()) return Failure{std::string{"its head is no JSON"}};
    trace::Crc32 crc;
    const std::uint64_t checked = open->size - std::min<std::uint64_t>(open->size, trace::kChecksumOctets);
    for (std::uint64_t at = 0; at < checked;) {
        const auto piece = read_at(open->fd.get(), at, std::min<std::uint64_t>(kMostInAPiece, checked - at));
        if (!piece) return Failure{piece.error()};
        if (piece->empty()) return Failure{std::string{"it is cut off"}};
        crc.add(*piece);
        at += piece->size();
    }
    const auto said = read_at(open->fd.get(), checked, trace::kChecksumOctets);
    if (!said) return Failure{said.error()};
    const auto computed = trace::checksum_octets(crc);
    if (!std::equal(said->begin(), said->end(), computed.begin(), computed.end()))
        return Failure{std::string{"it is cut off or damaged: its checksum is wrong"}};
    return report::read<report::IncidentHead>(json);
}

std::optional<IncidentKey> key_of(const report::IncidentPart& part)
{
    const auto kind = incident_kind(part.kind);
    if (!kind) return std::nullopt;
    return IncidentKey{*kind, part.station.value_or(""), part.reason};
}

Result<Incident, std::string> incident_at(const fs::path& path, std::uint64_t number)
{
    const auto head = judged_head(path);
    if (!head) return Failure{head.error()};
    const auto key = key_of(head->what);
    if (!key) return Failure{"this version does not know the kind " + printable(head->what.kind)};
    Incident found{.number = number,
                   .key = *key,
                   .text = head->what.text,
                   .first_unix_ns = head->unix_ns,
                   .last_unix_ns = head->unix_ns};
    for (const report::IncidentPart& part : head->also)
        if (const auto also = key_of(part); also && found.also.size() < IncidentBook::kMostAlso)
            found.also.push_back(*also);
    return found;
}

/// Without that file each incident counts once. A file that is none is replaced by the next one.
void take_counts(const fs::path& folder, FoundIncidents& found)
{
    const auto text = io::read_regular_file((folder / kCounts).string());
    if (!text) return;
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_object()) {
        found.faults.push_back((folder / kCounts).string() + " is skipped: it is cut off or no JSON");
        return;
    }
    const auto counts = report::read<report::IncidentCounts>(json);
    if (counts.next > 0)
        found.next_number = std::max(found.next_number, static_cast<std::uint64_t>(counts.next));
    for (const report::IncidentCount& one : counts.counts)
        for (Incident& incident : found.kept)
            if (static_cast<std::int64_t>(incident.number) == one.number && one.count > 0) {
                incident.count = static_cast<std::uint64_t>(one.count);
                incident.last_unix_ns = one.last_unix_ns;
            }
}

/// A file of an incident on its way to the disk.
class Writer {
public:
    explicit Writer(const fs::path& path) : file_(path) {}

    void write(Bytes octets)
    {
        crc_.add(octets);
        file_.write(octets);
    }
    /// The records of a stretch, in their order; of more than that what is nearest to the moment.
    void write(const trace::Ring& ring, const Stretch& stretch, std::size_t most_before,
               std::size_t most_behind);
    std::optional<std::string> finish()
    {
        file_.write(trace::checksum_octets(crc_));
        return file_.finish();
    }

private:
    io::NewFile file_;
    trace::Crc32 crc_;
};

/// Each record of a stretch as octets, handed to `use` with whether it lies behind the moment.
template <class Use>
void for_each_record(const trace::Ring& ring, const Stretch& stretch, Use use)
{
    trace::Ring::Reader reader{ring};
    trace::Record record;
    std::vector<std::uint8_t> octets;
    while (reader.next(record) && record.head.at <= stretch.to) {
        if (record.head.at < stretch.from) continue;
        octets.clear();
        append(record, octets);
        use(Bytes{octets}, record.head.at > stretch.at);
    }
}

void Writer::write(const trace::Ring& ring, const Stretch& stretch, std::size_t most_before,
                   std::size_t most_behind)
{
    constexpr std::size_t kBuffered = 16 * 1024;
    std::size_t before = 0, behind = 0; // octets
    for_each_record(ring, stretch, [&](Bytes octets, bool is_behind) {
        if (!is_behind) before += octets.size();
    });
    std::size_t skipped = before - std::min(before, most_before);
    std::vector<std::uint8_t> buffer;
    for_each_record(ring, stretch, [&](Bytes octets, bool is_behind) {
        const bool is_wanted = is_behind ? behind + octets.size() <= most_behind : skipped == 0;
        if (is_behind)
            behind += octets.size();
        else
            skipped -= std::min(skipped, octets.size());
        if (is_wanted) buffer.insert(buffer.end(), octets.begin(), octets.end());
        if (buffer.size() < kBuffered) return;
        write(buffer);
        buffer.clear();
    });
    write(buffer);
}

} // namespace

FoundIncidents find_incidents(const fs::path& folder)
{
    FoundIncidents found;
    std::error_code error;
    fs::create_directories(folder, error);
    auto entry = error ? fs::directory_iterator{} : fs::directory_iterator{folder, error};
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        const fs::path path = entry->path();
        std::error_code ignored;
        if (path.extension() == io::NewFile::kUnfinished) {
            fs::remove(path, ignored);
            continue;
        }
        if (path.filename() == kCounts) continue;
        const auto number = number_of(path);
        auto incident =
            number ? incident_at(path, *number) : Failure{std::string{"it is not called as an incident is"}};
        if (number) found.next_number = std::max(found.next_number, *number + 1);
        if (incident)
            found.kept.push_back(*std::move(incident));
        else
            found.faults.push_back(printable(path.string()) + " is skipped: " + incident.error());
    }
    if (error)
        found.faults.push_back(folder.string() + " cannot be used: " + error.message() +
                               "; incidents are not kept");
    take_counts(folder, found);
    return found;
}

std::optional<std::string> write_incident(const fs::path& folder, const report::IncidentHead& head,
                                          const trace::Ring& bus, const std::vector<LineRing>& lines,
                                          const Stretch& stretch)
{
    std::error_code ignored; // the file says what is wrong
    fs::create_directories(folder, ignored);
    Writer file{path_of(folder, static_cast<std::uint64_t>(head.number))};
    file.write(
        bytes_of(trace::incident_begin(json_of(head).dump(-1, ' ', false, Json::error_handler_t::replace))));
    file.write(bus, stretch, kMostBefore, kMostBehind);
    for (const LineRing& line : lines) {
        trace::Record name{.head = {.kind = trace::Kind::line, .at = stretch.at}};
        const std::size_t length = std::min(line.name.size(), trace::Record::kMostOctets);
        name.octets.assign(bytes_of(line.name).first(length));
        std::vector<std::uint8_t> octets;
        append(name, octets);
        file.write(octets);
        file.write(*line.ring, stretch, kMostOfLinesBefore / lines.size(), kMostOfLinesBehind / lines.size());
    }
    return file.finish();
}

std::optional<std::string> write_counts(const fs::path& folder, const report::IncidentCounts& counts)
{
    io::NewFile file{folder / kCounts};
    file.write(bytes_of(json_of(counts).dump() + '\n'));
    return file.finish();
}

void remove_incident(const fs::path& folder, std::uint64_t number)
{
    std::error_code ignored; // what is not there any more is removed
    fs::remove(path_of(folder, number), ignored);
}

Result<IncidentPiece, std::string> read_piece(const fs::path& folder, std::uint64_t number,
                                              std::uint64_t offset)
{
    const auto open = open_file(path_of(folder, number));
    if (!open) return Failure{open.error()};
    if (offset > open->size) return IncidentPiece{.octets = {}, .size = open->size};
    auto octets =
        read_at(open->fd.get(), offset, std::min<std::uint64_t>(kMostInAPiece, open->size - offset));
    if (!octets) return Failure{octets.error()};
    return IncidentPiece{.octets = *std::move(octets), .size = open->size};
}

} // namespace dpslave::app
