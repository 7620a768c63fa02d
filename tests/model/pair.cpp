// SPDX-License-Identifier: Apache-2.0
#include "pair.hpp"

#include "devices.hpp"

#include <algorithm>

namespace test {

using namespace dpslave;
using model::Access;

namespace {

/// What Demand Data makes of an answer of the drive side.
Access access_of(AccessError error)
{
    switch (error) {
        case AccessError::none:
        case AccessError::not_kept: return Access::taken;
        case AccessError::invalid_tag:
        case AccessError::unsupported_type:
        case AccessError::no_scale:
        case AccessError::contradicted: return Access::invalid_tag;
        case AccessError::read_only:
        case AccessError::not_stopped:
        case AccessError::not_config_mode: return Access::read_only;
        case AccessError::out_of_range:
        case AccessError::does_not_fit:
        case AccessError::value_not_encoded: return Access::out_of_range;
        case AccessError::no_answer:
        case AccessError::deferred:
        case AccessError::not_understood:
        case AccessError::not_known: break;
    }
    return Access::no_code;
}

fdl::Telegram telegram_of(const Step& step)
{
    const auto sap = [](int number) {
        return number < 0 ? std::nullopt : std::optional{static_cast<std::uint8_t>(number)};
    };
    return {.delimiter = fdl::kSD2,
            .da = Pair::kAddress,
            .sa = static_cast<std::uint8_t>(step.numbers[1]),
            .fc = static_cast<std::uint8_t>(step.numbers[0]),
            .dsap = sap(step.numbers[2]),
            .ssap = sap(step.numbers[3]),
            .data = step.data()};
}

} // namespace

Pair::Pair(const model::Device& of_slave, const model::Device& of_model)
    : personality_(personality_of(of_slave)), slave_(personality_, kAddress), model_(of_model, kAddress)
{
    slave_.start(instant());
    stations_.attach(kAddress, slave_, personality_.max_tsdr);
    stations_.on_time(instant());
    model_.set_ext_diag({}, false);
    model_.start();
}

Instant Pair::instant() const
{
    return Instant{std::chrono::nanoseconds{now_}};
}

bool Pair::take(const Step& step)
{
    now_ += step.after;
    switch (step.kind) {
        case Step::Kind::request:
        case Step::Kind::sdn: send(step); break;
        case Step::Kind::wait:
            stations_.on_time(instant());
            model_.tick(now_);
            break;
        case Step::Kind::inputs: give_inputs(step); break;
        case Step::Kind::answer: give_answer(step); break;
        case Step::Kind::diag: give_diag(step); break;
        case Step::Kind::restart:
            slave_.stop(instant());
            stations_.detach(kAddress);
            slave_.start(instant());
            stations_.attach(kAddress, slave_, personality_.max_tsdr);
            stations_.on_time(instant());
            model_.stop();
            model_.start();
            break;
    }
    return equal_ && compare_states() && compare_deadlines() && compare_outputs() && compare_orders() &&
           compare_snapshots();
}

void Pair::send(const Step& step)
{
    const fdl::Telegram telegram = telegram_of(step);
    const model::Request request{.fc = step.numbers[0],
                                 .da = kAddress,
                                 .sa = step.numbers[1],
                                 .dsap = step.numbers[2],
                                 .ssap = step.numbers[3],
                                 .data = step.octets.data(),
                                 .length = static_cast<int>(step.length),
                                 .at = now_};
    if (step.kind == Step::Kind::sdn) {
        stations_.on_sdn(telegram, instant());
        model_.sdn(request);
        return;
    }
    const auto reply = stations_.on_request(telegram, instant(), Baud::k187_5);
    model_.request(request);
    equal_ = compare_reply(reply);
}

void Pair::give_inputs(const Step& step)
{
    const unsigned layout = model_.layouts - std::min(model_.layouts, static_cast<unsigned>(step.numbers[0]));
    InputImage image{.generation = layout,
                     .every_input_tried = (step.numbers[1] & 1) != 0,
                     .drive_answers = (step.numbers[1] & 2) != 0,
                     .hold = (step.numbers[2] & 1) != 0 ? StartHold::denied : StartHold::none,
                     .drive_gone = (step.numbers[2] & 2) != 0};
    int words[117] = {};
    for (std::size_t i = 0; i + 1 < step.length; i += 2) {
        words[i / 2] = step.octets[i] * 256 + step.octets[i + 1];
        if (i / 2 < image.words.size()) image.words[i / 2] = static_cast<std::uint16_t>(words[i / 2]);
    }
    slave_.set_inputs(image);
    model_.set_inputs(
        layout,
        {image.every_input_tried, image.drive_answers, image.hold != StartHold::none, image.drive_gone},
        words);
}

void Pair::give_answer(const Step& step)
{
    const auto [number, of_model] = orders_[static_cast<std::size_t>(step.numbers[0]) % orders_.size()];
    const auto error = static_cast<AccessError>(step.numbers[1]);
    slave_.set_demand_answer({number, error, static_cast<std::uint16_t>(step.numbers[2])});
    model_.set_answer(of_model, access_of(error), step.numbers[2]);
}

void Pair::give_diag(const Step& step)
{
    const Bytes blocks = step.data();
    (void)slave_.set_ext_diag(blocks, step.numbers[0] != 0);
    model_.set_ext_diag(model::Octets(blocks.begin(), blocks.end()), step.numbers[0] != 0);
}

bool Pair::compare_reply(const fdl::Stations::Reply& reply)
{
    return same("reply", reply.octets, model_.reply) &&
           same("earliest begin of the reply", reply.not_before.count, model_.not_before) &&
           same("latest begin of the reply", reply.not_after.count, model_.not_after);
}

bool Pair::compare_states()
{
    return same("state", static_cast<int>(slave_.state()), model_.state) &&
           same("min T_SDR", slave_.min_tsdr().count, model_.min_tsdr);
}

/// Not sooner than the model says, and at most 10 ms later (wire reference 7.1).
bool Pair::compare_deadlines()
{
    const Instant due = slave_.next_deadline();
    const long long expected = model_.deadline();
    if (due == kNever || expected < 0) return same("a deadline", due != kNever, expected >= 0);
    const long long late = due.time_since_epoch().count() - expected;
    return (late >= 0 && late <= 10'000'000) || same("deadline", due.time_since_epoch().count(), expected);
}

bool Pair::compare_snapshots()
{
    const dp::Snapshot seen = slave_.snapshot();
    model::Octets diagnosis;
    model_.diagnosis(diagnosis);
    bool equal = same("diagnosis", seen.diagnosis, diagnosis) &&
                 same("diagnosis pending", seen.diag_pending, model_.pending) &&
                 same("Master_Add", seen.master, model_.owner) &&
                 same("T_WD", seen.watchdog_on ? seen.watchdog.count() : 0,
                      model_.watchdog_on ? model_.watchdog / 1'000'000 : 0) &&
                 same("Group_Ident", seen.groups, model_.groups) &&
                 same("Demand Data", seen.demand_data, model_.demand) &&
                 same("parameters", seen.layout.count, static_cast<long long>(model_.parameters.size()));
    for (std::size_t i = 0; equal && i < model_.parameters.size(); ++i)
        equal = same("output in force", model_.parameters[i].writes ? seen.outputs[i] : 0,
                     model_.active.words[i]);
    for (std::size_t i = 0; equal && i < 4; ++i)
        equal = same("register of Demand Data", seen.demand_request[i], model_.received.registers[i]);
    return equal;
}

bool Pair::compare_outputs()
{
    if (const auto newest = slave_.take_outputs()) outputs_ = *newest;
    const Layout& layout = outputs_.layout;
    bool equal = same("layout", layout.generation, model_.layout) &&
                 same("parameters of the drive side", layout.count,
                      static_cast<long long>(model_.parameters.size())) &&
                 same("may write", outputs_.may_write, model_.may_write);
    for (std::size_t i = 0; equal && i < model_.parameters.size(); ++i) {
        const model::Parameter& one = model_.parameters[i];
        equal = same("tag", layout.parameters[i].tag, one.tag) &&
                same("reads", layout.parameters[i].reads, one.reads) &&
                same("writes", layout.parameters[i].writes, one.writes) &&
                (!one.writes || same("output", outputs_.words[i], model_.active.words[i]));
    }
    return equal;
}

bool Pair::compare_orders()
{
    bool equal = true;
    std::size_t taken = 0;
    for (; equal && taken < model_.orders.size(); ++taken) {
        const model::Order& expected = model_.orders[taken];
        const auto order = slave_.take_demand_order();
        if (!order) return same("orders of Demand Data", 0, 1);
        equal = same("order", static_cast<int>(order->kind), expected.kind) &&
                same("tag of an order", order->tag, expected.tag) &&
                same("value of an order", order->value, expected.value) &&
                same("layout of an order", order->generation, expected.layout);
        std::copy_backward(orders_.begin(), orders_.end() - 1, orders_.end());
        orders_[0] = {order->number, expected.number};
    }
    model_.orders.clear();
    for (const unsigned layout : model_.left) {
        const auto left = slave_.take_left();
        equal = equal && same("layout that was left", left ? left->generation : 0, layout);
    }
    model_.left.clear();
    return equal && same("further orders", slave_.take_demand_order().has_value(), 0) &&
           same("further layouts that were left", slave_.take_left().has_value(), 0);
}

/// True: they are the same. Else `difference_` says what is not.
bool Pair::same(const char* what, long long slave, long long model)
{
    if (slave == model) [[likely]]
        return true;
    equal_ = false;
    difference_ = std::string{what} + ": the slave has " + std::to_string(slave) + ", the model " +
                  std::to_string(model);
    return false;
}

bool Pair::same(const char* what, Bytes slave, const model::Octets& model)
{
    if (std::equal(slave.begin(), slave.end(), model.begin(), model.end())) [[likely]]
        return true;
    equal_ = false;
    difference_ = std::string{what} + ":\n  slave " + hex(slave) + "\n  model " + hex(Bytes{model});
    return false;
}

} // namespace test
