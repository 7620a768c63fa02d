// SPDX-License-Identifier: Apache-2.0
/// The cyclic exchange, Global_Control, diagnosis and Demand Data. Section numbers are those of the wire
/// reference, rows those of manual-coverage.md.
#include "model.hpp"

#include <algorithm>

namespace model {
namespace {

void push_word(Octets& into, int word)
{
    into.push_back(static_cast<std::uint8_t>(word / 256));
    into.push_back(static_cast<std::uint8_t>(word % 256));
}

/// 5.3. 0: no block begins here.
std::size_t length_of_block(const Octets& blocks, std::size_t at)
{
    const int header = blocks[at];
    std::size_t length = 0;
    if (header / 64 == 2)
        length = 3;
    else if (header / 64 == 3)
        length = 1;
    else if (header % 64 >= 2)
        length = static_cast<std::size_t>(header % 64);
    return at + length <= blocks.size() ? length : 0;
}

} // namespace

// ----- 4.7

void Slave::data_exchange(const Request& asked)
{
    if (state != data_exch || asked.sa != owner) {
        sd1(asked, 0x03);
        return;
    }
    const bool is_right = asked.length == out_length || (asked.length == 0 && device.fail_safe);
    if (is_right && finding_scales()) outputs_at = asked.at;
    if (asked.length == out_length) {
        take_outputs(asked);
    } else if (asked.length == 0 && device.fail_safe) {
        clear();
    } else {
        leave();
        sd1(asked, 0x03);
        return;
    }
    if (in_length == 0) {
        if (pending)
            sd1(asked, 0x0A);
        else
            sc();
        return;
    }
    Octets data;
    append_inputs(data);
    sd2(asked, pending ? 0x0A : 0x08, data);
}

void Slave::take_outputs(const Request& asked)
{
    int at = 0;
    if (demand)
        for (int& word : received.registers) {
            word = asked.data[at] * 256 + asked.data[at + 1];
            at += 2;
        }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (!parameters[i].writes) continue;
        received.words[i] = asked.data[at] * 256 + asked.data[at + 1];
        at += 2;
    }
    has_outputs = true;
    if (sync) return;
    active = received;
    outputs_are_in_force();
}

/// D has become N, by the master's word: now the drive side may write. Not before the scales are known
///
void Slave::outputs_are_in_force()
{
    in_force = in_force || has_outputs;
    if (finding_scales() || !in_force) return;
    may_write = true;
    look_at_registers();
}

void Slave::clear()
{
    received = active = Image{};
    has_outputs = true;
    outputs_are_in_force();
}

Image Slave::live_inputs() const
{
    Image now = inputs;
    std::copy(demand_reply, demand_reply + 4, now.registers);
    return now;
}

void Slave::append_inputs(Octets& into) const
{
    const Image shown = freeze ? frozen : live_inputs();
    if (demand)
        for (const int word : shown.registers) push_word(into, word);
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].reads) push_word(into, shown.words[i]);
}

void Slave::set_inputs(unsigned of_layout, Found what, const int* words)
{
    drive_answers = what.answers;
    if (layout == 0 || of_layout != layout) return;
    for (std::size_t i = 0; i < parameters.size(); ++i) inputs.words[i] = words[i];
    drive_found = what;
    if (what.gone) { // A4
        if (stat_diag) return;
        has_begun = true;
        stat_diag = pending = true;
        freeze = false;
        return;
    }
    const bool time_is_over = waited_long_enough && !device.waits_for_drive;
    const bool waits = !what.every_one_tried && (what.answers || !time_is_over);
    if (stat_diag && (!what.holds || has_begun) && !waits) end_stat_diag();
}

void Slave::end_stat_diag()
{
    stat_diag = false;
    has_begun = true;
    pending = true;
    if (outputs_at >= 0 && in_force) outputs_are_in_force();
    outputs_at = -1;
}

// ----- 4.10

void Slave::sdn(const Request& said)
{
    tick(said.at);
    if (said.dsap != 58 || said.ssap != 62 || said.length != 2) return;
    if (state != data_exch || said.sa != owner) return;
    const int command = said.data[0];
    const int group = said.data[1];
    if (group != 0 && (group & groups) == 0) return;

    if ((command & 0x02) != 0) clear();
    if (sync_wanted && (command & 0x10) != 0 && sync) {
        sync = false;
        active = received;
        outputs_are_in_force();
    } else if (sync_wanted && (command & 0x30) == 0x20) {
        sync = true;
        active = received;
        outputs_are_in_force();
    }
    if (freeze_wanted && (command & 0x04) != 0) {
        freeze = false;
    } else if (freeze_wanted && (command & 0x08) != 0) {
        freeze = true;
        frozen = live_inputs();
    }
}

// ----- 5

void Slave::set_ext_diag(const Octets& blocks, bool fault)
{
    Octets kept;
    bool overflow = false;
    for (std::size_t at = 0; at < blocks.size();) {
        const std::size_t length = length_of_block(blocks, at);
        if (length == 0) break;
        if (6 + kept.size() + length > static_cast<std::size_t>(device.longest_diag)) {
            overflow = true;
            break;
        }
        for (std::size_t i = 0; i < length; ++i) kept.push_back(blocks[at + i]);
        at += length;
    }
    if (blocks.empty() && device.own_diag_octets != 0) {
        kept.assign(static_cast<std::size_t>(device.own_diag_octets) + 1, 0);
        kept[0] = static_cast<std::uint8_t>(device.own_diag_octets + 1);
    }
    const bool is_fault = fault && !kept.empty();
    const bool news = kept != ext_diag || is_fault != ext_diag_fault || overflow != ext_diag_overflow;
    ext_diag = kept;
    ext_diag_fault = is_fault;
    ext_diag_overflow = overflow;
    if (news && owner != kNobody) pending = true;
}

/// 5.1
void Slave::diagnosis(Octets& into) const
{
    int one = 0, two = 0x04, three = 0;
    if (state != data_exch) one |= 0x02;
    if (cfg_fault) one |= 0x04;
    if (ext_diag_fault) one |= 0x08;
    if (not_supported) one |= 0x10;
    if (prm_fault) one |= 0x40;
    if (state == wait_prm) two |= 0x01;
    if (stat_diag) two |= 0x02;
    if (watchdog_on) two |= 0x08;
    if (freeze) two |= 0x10;
    if (sync) two |= 0x20;
    if (ext_diag_overflow) three |= 0x80;
    into.clear();
    for (const int octet : {one, two, three, owner, device.ident / 256, device.ident % 256})
        into.push_back(static_cast<std::uint8_t>(octet));
    for (const std::uint8_t octet : ext_diag) into.push_back(octet);
}

// ----- Demand Data, C-060 to C-069

void Slave::look_at_registers()
{
    if (!demand) return;
    const int command = active.registers[0] / 4096;
    const int tag = active.registers[0] % 2048;
    const bool extended = device.extended_demand && (command == 3 || command == 4);
    const bool writes = command == 2 || (extended && command == 4);
    const int now[4] = {command, command == 0 ? 0 : tag, extended ? active.registers[1] : 0,
                        writes ? active.registers[3] : 0};
    if (std::equal(now, now + 4, wanted)) return;
    std::copy(now, now + 4, wanted);

    if (command == 0) {
        if (standing.kind != Order::cancel) order(Order::cancel, 0, 0);
        for (int& word : demand_reply) word = 0;
    } else if (command == 1 || command == 2) {
        order(command == 1 ? Order::read : Order::write, tag, now[3]);
    } else if (extended && tag == 0 && now[2] <= 16'383) {
        order(command == 3 ? Order::read : Order::write, now[2], now[3]);
    } else {
        if (standing.kind != Order::cancel) order(Order::cancel, 0, 0);
        reject(0);
    }
}

void Slave::order(Order::Kind kind, int tag, int value)
{
    standing = Order{kind, tag, value, ++orders_given, layout};
    // One that waits still: only the newest can be answered, but a write is carried out.
    if (!orders.empty() && orders.back().kind != Order::write) orders.pop_back();
    orders.push_back(standing);
}

void Slave::set_answer(unsigned number, Access how, int value)
{
    if (standing.kind == Order::cancel || number != standing.number) return;
    const bool extended = wanted[0] == 3 || wanted[0] == 4;
    switch (how) {
        case Access::no_code: break;
        case Access::invalid_tag: reject(0); break;
        case Access::read_only: reject(1); break;
        case Access::out_of_range: reject(2); break;
        case Access::taken:
            demand_reply[0] = 0x1000 + (extended ? 0 : wanted[1]);
            if (extended && device.replies_as_example) demand_reply[0] = wanted[0] * 0x1000;
            demand_reply[1] = extended ? wanted[2] : 0;
            demand_reply[2] = 0;
            demand_reply[3] = value;
            break;
    }
}

void Slave::reject(int code)
{
    const bool extended = device.extended_demand && (wanted[0] == 3 || wanted[0] == 4);
    demand_reply[0] = 0x7000 + (extended ? 0 : wanted[1]);
    if (extended && device.replies_as_example && wanted[2] <= 16'383) demand_reply[0] = 0x7000 + wanted[2];
    demand_reply[1] = extended ? wanted[2] : 0;
    demand_reply[2] = 0;
    demand_reply[3] = code + device.error_base;
}

} // namespace model
