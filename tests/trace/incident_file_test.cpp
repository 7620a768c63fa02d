// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/incident_file.hpp"
#include "dpslave/trace/wire_form.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace dpslave;
using namespace dpslave::trace;

namespace {

/// A file by hand: the two lines, one record without octets (a change of the rate), and the CRC-32 of all
/// that, computed with zlib's crc32().
std::vector<std::uint8_t> file_by_hand()
{
    const std::string lines = "dpslaved incident 1\n{\"number\": 7}\n";
    std::vector<std::uint8_t> file{lines.begin(), lines.end()};
    std::vector<std::uint8_t> record(32);
    record[2] = 4; // rate
    record[4] = 3; // 93.75 kbit/s
    record[8] = 9; // number
    file.insert(file.end(), record.begin(), record.end());
    for (const int octet : {0x3C, 0x64, 0x30, 0xFD}) file.push_back(static_cast<std::uint8_t>(octet));
    return file;
}

std::string fault_of(const std::vector<std::uint8_t>& file)
{
    const auto read = read_incident(file);
    return read ? std::string{"none"} : read.error();
}

TEST(IncidentFile, IsHeadRecordsAndCheckSum)
{
    const auto file = file_by_hand();
    const auto read = read_incident(file);

    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->head, "{\"number\": 7}");
    Bytes rest = read->records;
    const auto record = take_record(rest);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->head.kind, Kind::rate);
    EXPECT_EQ(record->number, 9U);
    EXPECT_TRUE(rest.empty());
}

TEST(IncidentFile, IsWrittenAsItIsRead)
{
    const auto by_hand = file_by_hand();
    const std::string begin = incident_begin("{\"number\": 7}");
    std::vector<std::uint8_t> written{begin.begin(), begin.end()};
    written.insert(written.end(), by_hand.end() - 36, by_hand.end() - 4);
    Crc32 crc;
    crc.add(written);
    const auto sum = checksum_octets(crc);
    written.insert(written.end(), sum.begin(), sum.end());

    EXPECT_EQ(written, by_hand);
}

TEST(IncidentFile, ThatIsCutOffAnywhereIsRefused)
{
    const auto whole = file_by_hand();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(fault_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), "none")
            << length;
}

TEST(IncidentFile, WithAnyBitChangedIsRefused)
{
    for (std::size_t at = 0; at < file_by_hand().size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            auto file = file_by_hand();
            file[at] = static_cast<std::uint8_t>(file[at] ^ 1 << bit);
            EXPECT_NE(fault_of(file), "none") << at;
        }
}

TEST(IncidentFile, OfAnotherProgramSaysSo)
{
    EXPECT_EQ(fault_of({'P', 'K', 3, 4}), "it is no incident that this version of dpslaved wrote");
}

TEST(IncidentFile, WithAHeadWithoutEndIsRefused)
{
    const std::string text = std::string{kIncidentMark} + std::string(2 * kLongestHead, 'x') + "\n";

    EXPECT_EQ(fault_of({text.begin(), text.end()}), "its head has no end");
}

TEST(IncidentFile, WithWhatIsNoRecordIsRefusedEvenWithARightCheckSum)
{
    const std::string begin = incident_begin("{}") + "?";
    std::vector<std::uint8_t> file{begin.begin(), begin.end()};
    Crc32 crc;
    crc.add(file);
    const auto sum = checksum_octets(crc);
    file.insert(file.end(), sum.begin(), sum.end());

    EXPECT_EQ(fault_of(file), "it holds what is no record");
}

} // namespace
