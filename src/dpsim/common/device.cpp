// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"

#include <algorithm>

namespace dpslave::sim {

SimValue SimParameter::at(Instant now) const
{
    if (!motion) return value;
    const double ratio =
        static_cast<double>((now - motion->began).count()) / static_cast<double>(motion->takes.count());
    double part = std::clamp(ratio, 0.0, 1.0);
    if (motion->back_and_forth && ratio > 0) {
        const double turn = ratio - 2.0 * static_cast<double>(static_cast<std::int64_t>(ratio / 2.0));
        part = turn <= 1.0 ? turn : 2.0 - turn;
    }
    const double counts = motion->from + (motion->to - motion->from) * part;
    return {static_cast<std::int32_t>(counts < 0 ? counts - 0.5 : counts + 0.5), {}};
}

void SimParameter::put(SimValue to)
{
    value = std::move(to);
    motion.reset();
}

SimParameter* Device::find(std::uint16_t tag)
{
    const auto found =
        std::lower_bound(parameters_.begin(), parameters_.end(), tag,
                         [](const SimParameter& p, std::uint16_t wanted) { return p.tag.number < wanted; });
    return found == parameters_.end() || found->tag.number != tag ? nullptr : &*found;
}

std::optional<Octets> DeviceLine::take_reply(Instant now)
{
    if (replies_.empty() || now < replies_.front().due) return std::nullopt;
    Octets octets = std::move(replies_.front().octets);
    replies_.pop_front();
    return octets;
}

void DeviceLine::reply(Device& device, const DeviceFaults& faults, Octets octets, Concerned concerned,
                       Instant now)
{
    if (faults.bad_check && octets.size() > 1)
        octets.back() = static_cast<std::uint8_t>(octets.back() ^ 0x01);
    if (faults.garbage)
        for (std::uint8_t& octet : octets) octet = static_cast<std::uint8_t>(random_() & most_octet_);
    const auto takes = turnaround_ + faults.slow;
    for (Departure& leaves : device.answer_faults.apply(std::move(octets), concerned, now)) {
        Instant at = now + takes + leaves.later;
        for (const Reply& other : replies_) {
            if (other.device != &device) continue;
            at = std::max(at, other.due + takes);
            leaves.is_late = leaves.is_late || other.is_late;
        }
        const auto place =
            std::upper_bound(replies_.begin(), replies_.end(), at,
                             [](Instant when, const Reply& other) { return when < other.due; });
        replies_.insert(place, {&device, std::move(leaves.octets), at, leaves.is_late});
    }
}

void DeviceLine::drop_reply()
{
    std::erase_if(replies_, [](const Reply& reply) { return !reply.is_late; });
}

void DeviceLine::log(const Device& device, std::string_view words)
{
    if (logging_) warn(device, words);
}

void DeviceLine::warn(const Device& device, std::string_view words)
{
    const std::string unit = devices().size() > 1 ? "unit " + device.address() + ": " : std::string{};
    log_.push_back(unit + std::string{words});
}

} // namespace dpslave::sim
