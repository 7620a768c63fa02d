// SPDX-License-Identifier: Apache-2.0
#include "run.hpp"

#include "devices.hpp"
#include "generator.hpp"
#include "pair.hpp"

#include <algorithm>

namespace test {
namespace {

Reached all_reached;

std::size_t device_of(std::uint64_t seed)
{
    return seed % model_devices().size();
}

void count(const Step& step, const model::Slave& slave)
{
    ++all_reached.steps;
    ++all_reached.in_state[slave.state];
    std::size_t kind = 4;
    if (step.kind == Step::Kind::request) {
        const model::Octets& reply = slave.reply;
        kind = reply[0] == 0xE5 ? 0 : reply[0] == 0x10 ? 1 : reply[6] == 0x08 ? 2 : 3;
    }
    ++all_reached.replies[kind];
}

std::string kind_of(const std::string& difference)
{
    return difference.substr(0, difference.find(':'));
}

} // namespace

Reached reached()
{
    return all_reached;
}

std::optional<Finding> run_seed(std::uint64_t seed, std::uint64_t steps)
{
    const std::size_t device = device_of(seed);
    Generator generator{seed};
    Pair pair{model_devices()[device]};
    Step step;
    for (std::uint64_t i = 0; i < steps; ++i) {
        generator.next(pair.model(), pair.now(), step);
        if (pair.take(step)) [[likely]] {
            count(step, pair.model());
            continue;
        }
        // Once more, and this time the steps are kept.
        Generator again{seed};
        Pair same{model_devices()[device]};
        Steps taken;
        do {
            again.next(same.model(), same.now(), step);
            taken.push_back(step);
        } while (same.take(step) && taken.size() <= i);
        taken = shrunk(device, std::move(taken));
        return Finding{seed, device, taken, difference_in(device, taken).value_or("not to be repeated")};
    }
    return std::nullopt;
}

std::optional<std::string> difference_in(std::size_t device, const Steps& steps)
{
    Pair pair{model_devices().at(device)};
    for (const Step& step : steps)
        if (!pair.take(step)) return pair.difference();
    return std::nullopt;
}

Steps shrunk(std::size_t device, Steps steps)
{
    const auto wanted = difference_in(device, steps);
    if (!wanted) return steps;
    for (std::size_t piece = std::max<std::size_t>(1, steps.size() / 2); piece > 0; piece /= 2) {
        for (std::size_t end = steps.size(); end > 0;) {
            const std::size_t begin = end > piece ? end - piece : 0;
            Steps fewer(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(begin));
            fewer.insert(fewer.end(), steps.begin() + static_cast<std::ptrdiff_t>(end), steps.end());
            const auto found = difference_in(device, fewer);
            if (found && kind_of(*found) == kind_of(*wanted)) steps = std::move(fewer);
            end = std::min(begin, steps.size());
        }
    }
    return steps;
}

std::string show(const Finding& finding)
{
    std::string all = "seed " + std::to_string(finding.seed) + ", device " + std::to_string(finding.device) +
                      " (" + model_devices()[finding.device].name + "), " +
                      std::to_string(finding.steps.size()) + " steps are enough:\n";
    for (const Step& step : finding.steps) all += show(step) + "\n";
    return all + finding.difference + "\n";
}

} // namespace test
