// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/wire_form.hpp"

#include "instant_word.hpp"

namespace dpslave::trace {
namespace {

constexpr std::size_t kHead = 32;

void put(std::vector<std::uint8_t>& to, std::uint64_t value, std::size_t octets)
{
    for (std::size_t i = 0; i < octets; ++i) to.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

std::uint64_t get(Bytes octets, std::size_t at, std::size_t count)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{octets[at + i]} << 8 * i;
    return value;
}

} // namespace

void append(const Record& record, std::vector<std::uint8_t>& to)
{
    const Bytes octets = record.octets;
    put(to, octets.size(), 2);
    put(to, static_cast<std::uint8_t>(record.head.kind), 1);
    put(to, record.head.detail, 1);
    put(to, record.head.rate, 1);
    put(to, record.head.address, 1);
    put(to, record.head.more_follows ? 1 : 0, 2);
    put(to, record.number, 8);
    put(to, word_of(record.head.at), 8);
    put(to, word_of(record.head.begun), 8);
    to.insert(to.end(), octets.begin(), octets.end());
}

std::optional<Record> take_record(Bytes& octets)
{
    if (octets.size() < kHead) return std::nullopt;
    const std::size_t length = get(octets, 0, 2);
    const bool is_one = length <= Record::kMostOctets && octets[2] < kKinds && octets[4] < kBauds.size() &&
                        get(octets, 6, 2) <= 1;
    if (!is_one || octets.size() - kHead < length) return std::nullopt;
    Record record{.head = {.kind = static_cast<Kind>(octets[2]),
                           .detail = octets[3],
                           .rate = octets[4],
                           .more_follows = octets[6] != 0,
                           .address = octets[5],
                           .at = instant_of(get(octets, 16, 8)),
                           .begun = instant_of(get(octets, 24, 8))},
                  .number = get(octets, 8, 8)};
    record.octets.assign(octets.subspan(kHead, length));
    octets = octets.subspan(kHead + length);
    return record;
}

} // namespace dpslave::trace
