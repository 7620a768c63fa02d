// SPDX-License-Identifier: Apache-2.0
// The files of incidents: written, found again, and what is not one of them. And what leads to them.
#include "app/incident/burst.hpp"
#include "app/incident/folder.hpp"

#include "dpslave/io/new_file.hpp"
#include "dpslave/trace/incident_file.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

namespace dpslave::app {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Instant kAt{seconds{1000}};
constexpr Stretch kStretch{.from = kAt - seconds{3}, .at = kAt, .to = kAt + seconds{2}};

class IncidentFolder : public testing::Test {
protected:
    IncidentFolder()
    {
        std::string name = (fs::temp_directory_path() / "dpslave-incidents-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error{"no temporary folder"};
        top = name;
        folder = top / "incidents";
    }
    ~IncidentFolder() override { fs::remove_all(top); }

    void record(Instant at, std::size_t octets = 1)
    {
        const std::vector<std::uint8_t> heard(octets, 0xE5);
        ring.put({.kind = trace::Kind::heard, .rate = 4, .at = at}, heard);
    }
    static report::IncidentHead head(std::int64_t number)
    {
        return {.number = number,
                .what = {"left", "unwinder", "watchdog", "unwinder: left"},
                .at_ns = kAt.time_since_epoch().count(),
                .unix_ns = 1'700'000'000'000'000'000,
                .also = {{"refused", "rewinder", "prm_ident", "rewinder: refused"}}};
    }
    void write(std::int64_t number) const
    {
        const auto failure = write_incident(folder, head(number), ring, lines, kStretch);
        ASSERT_FALSE(failure) << *failure;
    }
    static std::string content(const fs::path& path)
    {
        std::ifstream file{path, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    void put(const std::string& name, const std::string& text) const
    {
        fs::create_directories(folder);
        std::ofstream{folder / name, std::ios::binary} << text;
    }
    std::vector<trace::Record> records_in(std::uint64_t number) const
    {
        const std::string text = content(folder / (std::to_string(number) + ".incident"));
        const auto file = trace::read_incident(bytes_of(text));
        std::vector<trace::Record> records;
        if (!file) return records;
        for (Bytes rest = file->records; const auto record = trace::take_record(rest);)
            records.push_back(*record);
        return records;
    }
    std::vector<Instant> times_in(std::uint64_t number) const
    {
        std::vector<Instant> times;
        for (const trace::Record& record : records_in(number)) times.push_back(record.head.at);
        return times;
    }

    fs::path top, folder;
    trace::Ring ring{4 * 1024 * 1024};
    std::vector<LineRing> lines;
};

TEST_F(IncidentFolder, HasTheRecordsOfTheSecondsAroundTheIncident)
{
    for (const auto at : {kAt - seconds{4}, kAt - seconds{3}, kAt, kAt + seconds{2}, kAt + seconds{3}})
        record(at);
    write(1);

    EXPECT_THAT(times_in(1), ElementsAre(kAt - seconds{3}, kAt, kAt + seconds{2}));
}

TEST_F(IncidentFolder, KeepsWhatIsNearestToTheIncidentWhereThereIsTooMuch)
{
    for (int i = -2900; i <= 1900; ++i) record(kAt + milliseconds{i}, 400); // 2 MiB
    write(1);

    const auto times = times_in(1);
    ASSERT_FALSE(times.empty());
    EXPECT_LE(fs::file_size(folder / "1.incident"), kMostBefore + kMostBehind + 4096);
    EXPECT_GT(fs::file_size(folder / "1.incident"), kMostBefore + kMostBehind - 4096);
    for (std::size_t i = 1; i < times.size(); ++i)
        ASSERT_EQ(times[i] - times[i - 1], milliseconds{1}) << "without a gap";
    EXPECT_LT(times.front(), kAt);
    EXPECT_GT(times.back(), kAt);
}

TEST_F(IncidentFolder, HasTheFramesOfEachDriveLineBehindTheTelegrams)
{
    record(kAt);
    trace::Ring p3{64 * 1024}, p4{64 * 1024};
    const std::vector<std::uint8_t> frame{0x04, 0x30};
    p3.put({.kind = trace::Kind::asked, .at = kAt - seconds{4}}, frame);
    p3.put({.kind = trace::Kind::asked, .at = kAt + seconds{1}}, frame);
    p4.put({.kind = trace::Kind::no_answer, .at = kAt - seconds{1}}, {});
    lines = {{"p3", &p3}, {"p4", &p4}};
    write(1);

    const auto records = records_in(1);
    ASSERT_EQ(records.size(), 5U);
    EXPECT_EQ(records[0].head.kind, trace::Kind::heard);
    EXPECT_EQ(records[1].head.kind, trace::Kind::line);
    EXPECT_THAT(Bytes{records[1].octets}, ElementsAre('p', '3'));
    EXPECT_EQ(records[2].head.kind, trace::Kind::asked);
    EXPECT_EQ(records[2].number, 1U);
    EXPECT_THAT(Bytes{records[3].octets}, ElementsAre('p', '4'));
    EXPECT_EQ(records[4].head.kind, trace::Kind::no_answer);
}

TEST_F(IncidentFolder, OfManyDriveLinesIsNotLarger)
{
    std::vector<std::unique_ptr<trace::Ring>> rings;
    const std::vector<std::uint8_t> frame(100, 0x30);
    for (int i = 0; i < 31; ++i) {
        rings.push_back(std::make_unique<trace::Ring>(128 * 1024));
        for (int n = 0; n < 400; ++n)
            rings.back()->put({.kind = trace::Kind::asked, .at = kAt + milliseconds{n - 200}}, frame);
        lines.push_back({"line " + std::to_string(i), rings.back().get()});
    }
    write(1);

    EXPECT_LE(fs::file_size(folder / "1.incident"), kMostOfLinesBefore + kMostOfLinesBehind + 4096);
    const auto records = records_in(1);
    const auto is_name = [](const trace::Record& record) { return record.head.kind == trace::Kind::line; };
    EXPECT_EQ(std::count_if(records.begin(), records.end(), is_name), 31);
    EXPECT_GT(records.size(), 31U * 30U) << "each has those that are nearest";
}

TEST_F(IncidentFolder, IsFoundAgainWithItsCountsAndNumbers)
{
    write(3);
    write(12);
    ASSERT_FALSE(write_counts(folder, {.next = 20, .counts = {{12, 5, 1'700'000'001'000'000'000}}}));

    auto found = find_incidents(folder);

    EXPECT_THAT(found.faults, IsEmpty());
    EXPECT_EQ(found.next_number, 20U);
    ASSERT_EQ(found.kept.size(), 2U);
    if (found.kept[0].number == 3) std::swap(found.kept[0], found.kept[1]);
    EXPECT_EQ(found.kept[0].count, 5U);
    EXPECT_EQ(found.kept[0].last_unix_ns, 1'700'000'001'000'000'000);
    EXPECT_EQ(found.kept[1].count, 1U);
    EXPECT_EQ(found.kept[1].key, (IncidentKey{IncidentKind::left, "unwinder", "watchdog"}));
    EXPECT_EQ(found.kept[1].first_unix_ns, 1'700'000'000'000'000'000);
    EXPECT_THAT(found.kept[1].also, ElementsAre(IncidentKey{IncidentKind::refused, "rewinder", "prm_ident"}));
}

TEST_F(IncidentFolder, ThatIsNotThereIsMadeAndEmpty)
{
    const auto found = find_incidents(folder);

    EXPECT_TRUE(fs::is_directory(folder));
    EXPECT_THAT(found.kept, IsEmpty());
    EXPECT_THAT(found.faults, IsEmpty());
    EXPECT_EQ(found.next_number, 1U);
}

TEST_F(IncidentFolder, SkipsAndNamesATruncatedFileAndUsesItsNumberForNoOther)
{
    record(kAt);
    write(7);
    const std::string whole = content(folder / "7.incident");
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
        put("7.incident", whole.substr(0, length));
        const auto found = find_incidents(folder);
        EXPECT_THAT(found.kept, IsEmpty());
        EXPECT_THAT(found.faults, ElementsAre(HasSubstr("7.incident is skipped"))) << length;
        EXPECT_EQ(found.next_number, 8U);
    }
}

TEST_F(IncidentFolder, SkipsAndNamesWhatIsForeign)
{
    write(1);
    put("notes.txt", "hello");
    put("0.incident", "x");
    put("-1.incident", "x");
    put("99999999999999999999999.incident", "x");
    put("2.incident", std::string(2 * 1024 * 1024, 'x'));
    fs::create_directories(folder / "3.incident");
    fs::create_symlink("/dev/zero", folder / "4.incident");

    const auto found = find_incidents(folder);

    EXPECT_EQ(found.kept.size(), 1U);
    EXPECT_EQ(found.faults.size(), 7U);
    for (const std::string& fault : found.faults) EXPECT_THAT(fault, HasSubstr(" is skipped: "));
}

TEST_F(IncidentFolder, SkipsCountsThatAreNoJsonAndHeadsOfAnUnknownKind)
{
    auto newer = head(2);
    newer.what.kind = "eclipse";
    ASSERT_FALSE(write_incident(folder, newer, ring, lines, kStretch));
    write(1);
    put("counts.json", "{\"next\": ");

    const auto found = find_incidents(folder);

    EXPECT_EQ(found.kept.size(), 1U);
    EXPECT_THAT(found.faults, testing::UnorderedElementsAre(HasSubstr("does not know the kind eclipse"),
                                                            HasSubstr("counts.json is skipped")));
}

TEST_F(IncidentFolder, RemovesWhatARunBeforeDidNotFinish)
{
    put("5.incident.new", "half");

    EXPECT_THAT(find_incidents(folder).faults, IsEmpty());
    EXPECT_FALSE(fs::exists(folder / "5.incident.new"));
}

TEST_F(IncidentFolder, ThatIsAFileIsSaid)
{
    std::ofstream{folder} << "in the way";

    EXPECT_THAT(find_incidents(folder).faults, ElementsAre(HasSubstr("incidents are not kept")));
    EXPECT_THAT(write_incident(folder, head(1), ring, lines, kStretch).value_or(""),
                HasSubstr("1.incident cannot be written: "));
}

/// While it exists no file can become longer than `octets`: a disk that is full.
class FullDisk {
public:
    explicit FullDisk(rlim_t octets)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit full{octets, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &full);
    }
    ~FullDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, signal_);
    }

private:
    rlimit before_{};
    void (*signal_)(int) = ::signal(SIGXFSZ, SIG_IGN);
};

TEST_F(IncidentFolder, OnAFullDiskKeepsWhatWasThereAndLeavesNothingHalf)
{
    write(1);
    const std::string before = content(folder / "1.incident");
    for (int i = 0; i < 1000; ++i) record(kAt, 100);
    {
        const FullDisk full{1000};
        EXPECT_TRUE(write_incident(folder, head(1), ring, lines, kStretch));
        EXPECT_TRUE(write_incident(folder, head(2), ring, lines, kStretch));
    }
    EXPECT_EQ(content(folder / "1.incident"), before);
    EXPECT_EQ(std::distance(fs::directory_iterator{folder}, {}), 1);
}

TEST_F(IncidentFolder, IsReadInPiecesThatMakeTheFile)
{
    for (int i = 0; i < 1000; ++i) record(kAt, 100);
    write(1);
    std::string text;
    for (;;) {
        const auto piece = read_piece(folder, 1, text.size());
        ASSERT_TRUE(piece) << piece.error();
        if (piece->octets.empty()) break;
        EXPECT_LE(piece->octets.size(), kMostInAPiece);
        EXPECT_EQ(piece->size, fs::file_size(folder / "1.incident"));
        text.append(piece->octets.begin(), piece->octets.end());
    }
    EXPECT_EQ(text, content(folder / "1.incident"));
    EXPECT_FALSE(read_piece(folder, 2, 0));
}

// ---------------------------------------------------------------- bursts

TEST(Burst, BeginsWithTenWithinASecond)
{
    Burst burst;
    EXPECT_FALSE(burst.count(1000, kAt)) << "what was counted before is no burst";
    EXPECT_FALSE(burst.count(1009, kAt + milliseconds{900}));
    EXPECT_TRUE(burst.count(1010, kAt + milliseconds{1000}));
}

TEST(Burst, IsNoneWhenTheyComeSlowly)
{
    Burst burst;
    for (int second = 0; second < 1000; ++second)
        EXPECT_FALSE(burst.count(static_cast<std::uint64_t>(second) * 8, kAt + seconds{second}));
}

TEST(Burst, LastsUntilASecondWithout)
{
    Burst burst;
    burst.count(0, kAt);
    EXPECT_TRUE(burst.count(50, kAt + milliseconds{100}));
    for (int i = 2; i < 50; ++i)
        EXPECT_FALSE(burst.count(static_cast<std::uint64_t>(i) * 50, kAt + milliseconds{100 * i}));
    EXPECT_FALSE(burst.count(49 * 50, kAt + seconds{7}));
    EXPECT_TRUE(burst.count(49 * 50 + 10, kAt + milliseconds{7100}));
}

} // namespace
} // namespace dpslave::app
