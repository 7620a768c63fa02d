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
bool BusStation::judge_line(Instant now)
{
    if (!link_->line_sign) return false;
    const std::uint32_t noted = link_->stalls_noted.load(std::memory_order_acquire);
    if (!line_.look(link_->line_sign->last(), noted, now)) return false;
    link_->stalls.store(line_.stalls(), std::memory_order_release);
    if (line_.is_stalled()) link_->line_sign->give_up();
    static_cast<void>(link_->inputs.fresh());
    take_inputs();
    return true;
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

    const bool is_done = forward_orders();
    while (const auto event = slave_.take_event()) {
        link_->events.push(*event); // full: counted by the ring; the log is not worth a lost telegram
    }
    return is_done;
}

bool BusStation::forward_orders()
{
    if (line_.is_stalled()) {
        keep_newest_order();
        return true; // judge_line() says when it goes on
    }
    if (!waiting_order_) waiting_order_ = slave_.take_demand_order();
    while (waiting_order_ && link_->demand_orders.push(*waiting_order_))
        waiting_order_ = slave_.take_demand_order();
    return !waiting_order_;
}

/// What the master has given up for a newer order is not carried out when the line goes round again, neither
/// what is here nor what the line has fetched before it stalled.
void BusStation::keep_newest_order()
{
    while (const auto order = slave_.take_demand_order()) {
        if (waiting_order_ && waiting_order_->kind == DemandOrder::Kind::write)
            link_->orders_dropped.fetch_add(1, std::memory_order_relaxed);
        waiting_order_ = order;
    }
    if (waiting_order_) link_->stands_from.store(waiting_order_->number, std::memory_order_release);
}

} // namespace dpslave::app
