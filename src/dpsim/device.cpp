// SPDX-License-Identifier: Apache-2.0
#include "dpsim/device.hpp"

#include <algorithm>

namespace dpslave::sim {

SimValue Parameter::at(Instant now) const
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

void Parameter::put(SimValue to)
{
    value = std::move(to);
    motion.reset();
}

Parameter* Device::find(std::uint16_t tag)
{
    const auto found =
        std::lower_bound(parameters_.begin(), parameters_.end(), tag,
                         [](const Parameter& p, std::uint16_t wanted) { return p.tag.number < wanted; });
    return found == parameters_.end() || found->tag.number != tag ? nullptr : &*found;
}

std::optional<Octets> DeviceLine::take_reply(Instant now)
{
    if (!reply_ || now < reply_->due) return std::nullopt;
    return std::exchange(reply_, std::nullopt)->octets;
}

void DeviceLine::log(const Device& device, std::string_view words)
{
    if (logging_) warn(device, words);
}

void DeviceLine::warn(const Device& device, std::string_view words)
{
    const std::string who = devices().size() > 1 ? "unit " + device.address() + ": " : std::string{};
    log_.push_back(who + std::string{words});
}

} // namespace dpslave::sim
