// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/samples.hpp"

#include <algorithm>

namespace dpslave::trace {
namespace {

constexpr std::uint8_t kLayout = 0, kValues = 1, kEndedValues = 2;
constexpr std::uint8_t kReads = 1, kWrites = 2;
constexpr std::size_t kSampleHead = 10, kOfParameter = 3;
constexpr auto kLastState = static_cast<std::uint8_t>(WordState::refused);
static_assert(kLastState < 16, "two states are one octet");
static_assert(kSampleHead + kMaxParameters * kOfParameter <= Record::kMostOctets);

using Octets = ByteBuffer<Record::kMostOctets>;

void push32(Octets& to, std::uint32_t value)
{
    to.push16(static_cast<std::uint16_t>(value >> 16));
    to.push16(static_cast<std::uint16_t>(value & 0xFFFF));
}

std::uint32_t be32(Bytes from, std::size_t at)
{
    return std::uint32_t{be16(from, at)} << 16 | be16(from, at + 2);
}

Octets begun(std::uint8_t kind, std::size_t count, const SampleOf& of)
{
    Octets octets;
    octets.push(kind);
    octets.push(static_cast<std::uint8_t>(count));
    push32(octets, of.station);
    push32(octets, of.generation);
    return octets;
}

std::size_t octets_of_states(std::size_t count)
{
    return (count + 1) / 2;
}

bool read_parameters(Bytes from, Sample& into)
{
    if (from.size() != into.count * kOfParameter) return false;
    for (std::size_t i = 0; i < into.count; ++i) {
        const std::uint8_t ways = from[i * kOfParameter + 2];
        if (ways > (kReads | kWrites)) return false;
        into.parameters[i] = {be16(from, i * kOfParameter), (ways & kReads) != 0, (ways & kWrites) != 0};
    }
    return true;
}

bool read_values(Bytes from, Sample& into)
{
    if (from.size() != 2U * into.count + octets_of_states(into.count)) return false;
    for (std::size_t i = 0; i < into.count; ++i) {
        const std::uint8_t two = from[2U * into.count + i / 2];
        const auto state = static_cast<std::uint8_t>(i % 2 == 0 ? two & 15 : two >> 4);
        if (state > kLastState) return false;
        into.words[i] = be16(from, 2 * i);
        into.states[i] = static_cast<WordState>(state);
    }
    return true;
}

} // namespace

void put_layout(Ring& ring, std::uint32_t station, const Layout& layout, Instant at) noexcept
{
    Octets octets = begun(kLayout, layout.count, {station, layout.generation});
    for (std::size_t i = 0; i < layout.count; ++i) {
        const LayoutEntry& one = layout.parameters[i];
        octets.push16(one.tag);
        octets.push(static_cast<std::uint8_t>((one.reads ? kReads : 0) | (one.writes ? kWrites : 0)));
    }
    ring.put({.at = at}, octets);
}

void put_values(Ring& ring, const SampleOf& of, const SampledValues& values, Instant at) noexcept
{
    const std::size_t count = std::min({values.words.size(), values.states.size(), kMaxParameters});
    Octets octets = begun(values.has_ended ? kEndedValues : kValues, count, of);
    for (std::size_t i = 0; i < count; ++i) octets.push16(values.words[i]);
    for (std::size_t i = 0; i < count; i += 2) {
        const auto first = static_cast<unsigned>(values.states[i]);
        const unsigned second = i + 1 < count ? static_cast<unsigned>(values.states[i + 1]) : 0U;
        octets.push(static_cast<std::uint8_t>(first | second << 4));
    }
    ring.put({.at = at}, octets);
}

std::optional<Sample> sample_of(const Record& record)
{
    const Bytes octets = record.octets;
    if (octets.size() < kSampleHead || octets[0] > kEndedValues || octets[1] > kMaxParameters)
        return std::nullopt;
    Sample sample;
    sample.is_layout = octets[0] == kLayout;
    sample.has_ended = octets[0] == kEndedValues;
    sample.count = octets[1];
    sample.of = {be32(octets, 2), be32(octets, 6)};
    const Bytes rest = octets.subspan(kSampleHead);
    const bool is_one = sample.is_layout ? read_parameters(rest, sample) : read_values(rest, sample);
    return is_one ? std::optional{sample} : std::nullopt;
}

} // namespace dpslave::trace
