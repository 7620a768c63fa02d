// SPDX-License-Identifier: Apache-2.0
#include "bus_station.hpp"

#include <utility>

namespace dpslave::app {

BusStation::BusStation(const config::StationConfig& config, std::shared_ptr<StationLink> link)
    : link_(std::move(link)),
      personality_(config.personality),
      slave_(*personality_, config.address),
      line_(config.loss.after),
      leaves_when_lost_(config.loss.when == drive::WhenLost::silent),
      is_diagnosed_when_lost_(config.loss.when == drive::WhenLost::diagnosis)
{
    orders_.address = config.address;
    take_departure();
}

void BusStation::fetch()
{
    if (link_->inputs.fresh()) take_inputs();
    if (link_->demand_answer.fresh()) slave_.set_demand_answer(link_->demand_answer.latest());
    take_orders();
}

void BusStation::take_inputs()
{
    if (!is_diagnosed_when_lost_ || !line_.is_stalled()) {
        slave_.set_inputs(link_->inputs.latest());
        return;
    }
    InputImage image = link_->inputs.latest();
    image.drive_gone = true;
    image.every_input_tried = false;
    slave_.set_inputs(image);
}

/// The stall is known to the line before the station is judged by what the line says.
void BusStation::judge_line(Instant now)
{
    if (!link_->line_sign) return;
    const std::uint32_t noted = link_->stalls_noted.load(std::memory_order_acquire);
    if (!line_.look(link_->line_sign->last(), noted, now)) return;
    link_->stalls.store(line_.stalls(), std::memory_order_release);
    static_cast<void>(link_->inputs.fresh());
    take_inputs();
}

bool BusStation::take_orders()
{
    if (!link_->bus_orders.fresh()) return false;
    orders_ = link_->bus_orders.latest();
    line_.set_after(orders_.drive_lost_after);
    slave_.set_ext_diag(orders_.ext_diag, orders_.ext_diag_fault);
    return true;
}

bool BusStation::take_departure()
{
    const std::uint32_t now = link_->departures.load(std::memory_order_acquire);
    return std::exchange(departures_, now) != now;
}

fdl::Answer BusStation::srd(const fdl::Indication& request, fdl::ReplyData& reply)
{
    fetch();
    return slave_.srd(request, reply);
}

void BusStation::sdn(const fdl::Indication& request)
{
    fetch(); // Freeze holds the inputs as they are at the command
    slave_.sdn(request);
}

void BusStation::on_time(Instant now)
{
    fetch();
    slave_.on_time(now);
}

bool BusStation::forward()
{
    while (const auto left = slave_.take_left())
        link_->ended.store(left->generation, std::memory_order_release);
    if (const auto outputs = slave_.take_outputs()) link_->outputs.publish(*outputs);

    if (!waiting_order_) waiting_order_ = slave_.take_demand_order();
    while (waiting_order_ && link_->demand_orders.push(*waiting_order_))
        waiting_order_ = slave_.take_demand_order();

    while (const auto event = slave_.take_event()) {
        link_->events.push(*event); // full: counted by the ring; the log is not worth a lost telegram
    }
    return !waiting_order_;
}

} // namespace dpslave::app
