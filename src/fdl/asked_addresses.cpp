// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/asked_addresses.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::fdl {

void AskedAddresses::on_telegram(const Telegram& telegram, Instant at)
{
    const auto asked_before = std::exchange(last_, std::nullopt);
    if (!telegram.has_fc()) {
        if (telegram.delimiter == kSC && asked_before) answered(*asked_before);
        return;
    }
    if (!telegram.is_request()) {
        if (telegram.sa < asked_.size()) answered(telegram.sa);
        return;
    }
    const Function function = telegram.function();
    const bool wants_data = function == Function::srd_low || function == Function::srd_high ||
                            function == Function::sda_low || function == Function::sda_high;
    if (!wants_data || telegram.da >= asked_.size()) return;
    Asked& asked = asked_[telegram.da];
    asked.by = telegram.sa;
    ++asked.requests;
    asked.last = at;
    last_ = telegram.da;
}

AskedAddresses::List AskedAddresses::unanswered() const
{
    List list{};
    for (std::size_t address = 0; address < asked_.size(); ++address) {
        const Asked& one = asked_[address];
        if (one.requests <= list.back().requests) continue;
        list.back() = {.address = static_cast<std::uint8_t>(address),
                       .master = one.by,
                       .requests = one.requests,
                       .last = one.last};
        for (std::size_t i = list.size() - 1; i > 0 && list[i - 1].requests < list[i].requests; --i)
            std::swap(list[i - 1], list[i]);
    }
    return list;
}

} // namespace dpslave::fdl
