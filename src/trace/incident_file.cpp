// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/incident_file.hpp"

#include "dpslave/trace/wire_form.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace dpslave::trace {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table()
{
    constexpr std::uint32_t kPolynomial = 0xEDB8'8320;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        std::uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ kPolynomial : crc >> 1;
        table[i] = crc;
    }
    return table;
}
constexpr std::array<std::uint32_t, 256> kTable = crc_table();

std::string_view text_of(Bytes octets)
{
    return {reinterpret_cast<const char*>(octets.data()), octets.size()};
}

} // namespace

void Crc32::add(Bytes octets)
{
    for (const std::uint8_t octet : octets) crc_ = crc_ >> 8 ^ kTable[(crc_ ^ octet) & 0xFF];
}

std::array<std::uint8_t, kChecksumOctets> checksum_octets(const Crc32& crc)
{
    std::array<std::uint8_t, kChecksumOctets> octets{};
    for (std::size_t i = 0; i < octets.size(); ++i)
        octets[i] = static_cast<std::uint8_t>(crc.value() >> 8 * i);
    return octets;
}

std::string incident_begin(std::string_view head)
{
    return std::string{kIncidentMark}.append(head) + '\n';
}

Result<std::string_view, std::string> incident_head(Bytes begin)
{
    std::string_view text = text_of(begin);
    if (!text.starts_with(kIncidentMark))
        return Failure{std::string{"it is no incident that this version of dpslaved wrote"}};
    text.remove_prefix(kIncidentMark.size());
    const std::size_t end = text.substr(0, kLongestHead).find('\n');
    if (end == std::string_view::npos) return Failure{std::string{"its head has no end"}};
    return text.substr(0, end);
}

Result<IncidentFile, std::string> read_incident(Bytes file)
{
    const auto head = incident_head(file);
    if (!head) return Failure{head.error()};
    const std::size_t begin = kIncidentMark.size() + head->size() + 1;
    if (file.size() < begin + kChecksumOctets) return Failure{std::string{"it is cut off"}};
    const Bytes checked = file.first(file.size() - kChecksumOctets);
    Crc32 crc;
    crc.add(checked);
    const Bytes said = file.subspan(checked.size());
    const auto computed = checksum_octets(crc);
    if (!std::equal(said.begin(), said.end(), computed.begin()))
        return Failure{std::string{"it is cut off or damaged: its checksum is wrong"}};
    Bytes rest = checked.subspan(begin);
    const IncidentFile read{.head = *head, .records = rest};
    while (take_record(rest)) {
    }
    if (!rest.empty()) return Failure{std::string{"it holds what is no record"}};
    return read;
}

} // namespace dpslave::trace
