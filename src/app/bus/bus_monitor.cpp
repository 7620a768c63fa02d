// SPDX-License-Identifier: Apache-2.0
#include "bus_monitor.hpp"

namespace dpslave::app {

void BusMonitor::on_telegram(const fdl::Telegram& telegram, Instant at)
{
    if (count_ == noted_.size()) catch_up();
    Noted& noted = noted_[count_++];
    noted.telegram = telegram;
    noted.at = at;
    noted.data.assign(telegram.data);
    noted.telegram.data = noted.data;
}

void BusMonitor::catch_up()
{
    for (std::size_t i = 0; i < count_; ++i) members_.on_telegram(noted_[i].telegram, noted_[i].at);
    count_ = 0;
}

} // namespace dpslave::app
