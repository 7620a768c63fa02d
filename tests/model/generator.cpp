// SPDX-License-Identifier: Apache-2.0
#include "generator.hpp"

#include <algorithm>

namespace test {

using Kind = Step::Kind;

unsigned Generator::below(unsigned end)
{
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    mixed ^= mixed >> 31;
    return static_cast<unsigned>(((mixed >> 32) * end) >> 32);
}

void Generator::next(const model::Slave& slave, std::int64_t now, Step& step)
{
    step.length = 0;
    step.numbers = {};
    step.after = below(400'000);
    pick(slave, step);
    if (step.kind == Kind::request) last_request_ = step;
    if (step.kind == Kind::wait || one_in(25)) let_time_pass(slave, now, step);
}

void Generator::pick(const model::Slave& slave, Step& step)
{
    const unsigned dice = below(1000);
    if (dice < 60) {
        step.kind = Kind::wait;
    } else if (dice < 120) {
        give_inputs(slave, step);
    } else if (dice < 165) {
        give_answer(step);
    } else if (dice < 190) {
        give_diag(step);
    } else if (dice < 192) {
        step.kind = Kind::restart;
    } else if (dice < 230 && last_request_.numbers[0] != 0) {
        step = last_request_; // a retry
        step.after = below(400'000);
    } else if (dice < 300) {
        global_control(slave, step);
    } else {
        step.kind = Kind::request;
        choose_master(slave, step);
        pick_service(slave, step);
        choose_fc(step);
    }
}

void Generator::pick_service(const model::Slave& slave, Step& step)
{
    const unsigned dice = below(100);
    const bool start = slave.state != model::data_exch;
    if (dice < (slave.state == model::wait_prm ? 50u : 6u)) {
        set_prm(slave, step);
    } else if (dice < (slave.state == model::wait_cfg ? 60u : 11u)) {
        chk_cfg(slave, step);
    } else if (dice < (start ? 65u : 70u)) {
        data_exchange(slave, step);
    } else if (dice < 80) {
        ask(step, 60);
    } else if (dice < 90) {
        ask(step, 56 + static_cast<int>(below(2)));
    } else if (dice < 93) {
        ask(step, 59);
    } else {
        other_request(step);
    }
    if (step.numbers[2] >= 56 && step.numbers[2] <= 60 && one_in(12)) noise(step, 3);
}

void Generator::choose_master(const model::Slave& slave, Step& step)
{
    const unsigned dice = below(20);
    int master = dice < 14 ? 2 : 9;
    if (dice == 19) master = static_cast<int>(below(127));
    if (slave.owner != model::kNobody && dice < 17) master = slave.owner;
    if (master == 5) master = 2; // our own address
    step.numbers[1] = master;
}

void Generator::ask(Step& step, int dsap, int ssap)
{
    step.numbers[2] = dsap;
    step.numbers[3] = ssap;
}

/// SRD with a frame count bit as a master keeps it, or not; other functions as other_request() chose them.
void Generator::choose_fc(Step& step)
{
    int& last = fc_[static_cast<std::size_t>(step.numbers[1])];
    if (step.numbers[0] == 0) {
        int bits = last == 0 ? 0x60 : (last == 0x50 ? 0x70 : 0x50);
        const unsigned dice = below(40);
        if (dice == 0) bits = 0x40;
        if (dice == 1) bits = 0x60;
        if (dice == 2 && last != 0) bits = last;
        if (bits != 0x40) last = bits;
        step.numbers[0] = bits | (one_in(10) ? 0x0C : 0x0D);
    }
}

/// FDL status, Ident, LSAP status, SDA, MSRD, and SAPs that are not served, or not for this caller.
void Generator::other_request(Step& step)
{
    constexpr std::array<int, 8> kUncounted{0x49, 0x49, 0x49, 0x49, 0x4E, 0x4F, 0x45, 0x47};
    const unsigned dice = below(4);
    ask(step, -1, -1);
    if (dice < 2) {
        step.numbers[0] = kUncounted[below(8)];
    } else if (dice == 2) {
        ask(step, static_cast<int>(below(64)), one_in(4) ? static_cast<int>(below(64)) : 62);
        noise(step, 12);
    } else {
        ask(step, 55 + static_cast<int>(below(8)), one_in(2) ? -1 : static_cast<int>(below(64)));
        if (one_in(3)) ask(step, -1, 62);
        if (one_in(4)) step.numbers[0] = 0x55 | static_cast<int>(below(2) << 5);
    }
}

void Generator::let_time_pass(const model::Slave& slave, std::int64_t now, Step& step)
{
    constexpr std::array<std::int64_t, 6> kAround{-10'000'000, -1, 0, 1, 10'000'000, 0};
    const std::int64_t due = slave.deadline();
    const unsigned dice = below(10);
    if (dice < 3 && due >= 0)
        step.after = std::max<std::int64_t>(0, due - now + kAround[below(6)]);
    else if (dice < 8)
        step.after = below(12'000'000);
    else if (dice < 9)
        step.after = below(1'100) * 1'000'000LL;
    else
        step.after = one_in(10) ? 700'000'000'000 : below(3'000'000'000u);
}

void Generator::noise(Step& step, unsigned most)
{
    const unsigned length = below(most + 1);
    for (unsigned i = 0; i < length; ++i) step.push(octet());
}

/// One of `one_of` times: another octet, one more or one less, or all of it noise.
void Generator::spoil(Step& step, unsigned one_of)
{
    if (!one_in(one_of)) return;
    switch (below(6)) {
        case 0:
            step.length = 0;
            noise(step, 244);
            break;
        case 1: step.push(one_in(2) ? 0 : octet()); break;
        case 2: step.length -= step.length > 0 ? 1 : 0; break;
        case 3: step.length = below(static_cast<unsigned>(step.length) + 1); break;
        default:
            if (step.length > 0)
                step.octets[below(static_cast<unsigned>(step.length))] = static_cast<std::uint8_t>(octet());
            break;
    }
}

void Generator::set_prm(const model::Slave& slave, Step& step)
{
    ask(step, 61);
    prm_header(slave, step);
    if (one_in(2) && last_prm_.length >= 7)
        for (std::size_t i = 7; i < last_prm_.length; ++i) step.push(last_prm_.octets[i]);
    else
        user_prm(slave.device, step);
    spoil(step, 12);
    last_prm_ = step;
}

void Generator::prm_header(const model::Slave& slave, Step& step)
{
    constexpr std::array<unsigned, 6> kMinTsdr{0, 0, 11, 5, 60, 255};
    constexpr std::array<unsigned, 12> kFactors{1, 1, 2, 3, 5, 20, 1, 2, 10, 0, 255, 4};
    const model::Device& device = slave.device;
    unsigned status = 0x80;
    if (one_in(12)) status = below(4) << 6;
    if (one_in(2)) status |= 0x08;
    if (!one_in(3) && (device.sync || one_in(10))) status |= 0x20;
    if (!one_in(3) && (device.freeze || one_in(10))) status |= 0x10;
    if (one_in(10)) status |= below(8);
    step.push(status);
    step.push(kFactors[below(12)]);
    step.push(kFactors[below(12)]);
    step.push(kMinTsdr[below(6)]);
    const auto ident = static_cast<unsigned>(device.ident);
    step.push(ident / 256);
    step.push(one_in(30) ? octet() : ident % 256);
    step.push(one_in(2) ? octet() : 1);
}

void Generator::user_prm(const model::Device& device, Step& step)
{
    if (device.list == model::no_tags) return noise(step, 4);
    if (device.prm_may_be_absent && one_in(10)) return;
    const unsigned first = device.dpv1_status && one_in(4) ? (one_in(6) ? octet() : below(8)) : 0;
    for (int i = 0; i < device.tags_at; ++i) step.push(i == 0 ? first : (one_in(60) ? octet() : 0));
    const unsigned tags = how_many_tags(device);
    for (unsigned i = 0; i < tags; ++i) {
        const unsigned highest = static_cast<unsigned>(device.highest_tag);
        unsigned tag = 1 + below(one_in(4) ? highest : 40);
        if (one_in(100)) tag = one_in(2) ? 0 : highest + below(2);
        step.push(tag / 256);
        step.push(tag % 256);
    }
    const auto full = static_cast<std::size_t>(device.longest_prm) + 7;
    const bool pads =
        device.list == model::first_zero_ends || (device.list == model::zeros_at_end && one_in(2));
    const std::size_t zeros = pads && step.length < full ? (full - step.length) / 2 : 0;
    for (std::size_t i = 0; i < zeros; ++i) {
        step.push(0);
        step.push(i > 0 && one_in(200) ? octet() : 0);
    }
}

/// Mostly few; else as many as the telegram takes, or about as many as the device takes.
unsigned Generator::how_many_tags(const model::Device& device)
{
    if (!one_in(20)) return below(5);
    const int room = (device.longest_prm - device.tags_at) / 2;
    const int limits[] = {room, device.most_parameters, device.most_words, device.most_words - 8};
    const int chosen = limits[below(4)];
    if (chosen <= 0 || one_in(3)) return below(static_cast<unsigned>(room) + 1);
    return static_cast<unsigned>(std::min(room + 1, chosen + static_cast<int>(below(2))));
}

void Generator::chk_cfg(const model::Slave& slave, Step& step)
{
    const model::Device& device = slave.device;
    ask(step, 62);
    if (slave.state == model::data_exch && !one_in(3)) {
        for (const unsigned one : slave.accepted_cfg) step.push(one);
    } else if (last_cfg_.length != 0 && one_in(4)) {
        for (const unsigned one : last_cfg_.data()) step.push(one);
    } else {
        if (device.demand_identifier != 0 && one_in(2))
            step.push(static_cast<unsigned>(device.demand_identifier));
        std::size_t parameters = slave.tags.size();
        if (device.list == model::no_tags) parameters = below(one_in(20) ? 12 : 6);
        for (std::size_t i = 0; i < parameters; ++i)
            step.push(static_cast<unsigned>(
                device.identifiers[below(static_cast<unsigned>(device.identifiers.size()))].octet));
    }
    spoil(step, slave.state == model::data_exch ? 4 : 14);
    last_cfg_ = step;
}

void Generator::data_exchange(const model::Slave& slave, Step& step)
{
    ask(step, -1, -1);
    const auto length = static_cast<std::size_t>(slave.state == model::data_exch ? slave.out_length : 4);
    if (slave.demand && one_in(2)) registers(step);
    const bool again = last_exchange_.length == length && one_in(3);
    while (step.length < length) step.push(again ? last_exchange_.octets[step.length] : octet());
    if (one_in(60)) spoil(step, 1);
    if (one_in(40)) step.length = 0;
    last_exchange_ = step;
}

/// Few commands, tags and values, so that the same ones come again.
void Generator::registers(Step& step)
{
    constexpr std::array<unsigned, 12> kFirst{0x00, 0x00, 0x10, 0x10, 0x20, 0x20,
                                              0x30, 0x40, 0x18, 0x70, 0x30, 0x40};
    step.push(kFirst[below(12)]);
    step.push(one_in(3) ? 0 : below(3));
    step.push(one_in(8) ? octet() : 0);
    step.push(below(3));
    step.push(one_in(4) ? octet() : 0);
    step.push(0);
    step.push(0);
    step.push(below(3));
}

void Generator::global_control(const model::Slave& slave, Step& step)
{
    step.kind = Kind::sdn;
    choose_master(slave, step);
    step.numbers[0] = one_in(2) ? 0x46 : 0x44;
    ask(step, one_in(20) ? static_cast<int>(below(64)) : 58, one_in(20) ? static_cast<int>(below(64)) : 62);
    constexpr std::array<unsigned, 8> kCommands{0x20, 0x20, 0x10, 0x08, 0x08, 0x04, 0x02, 0x00};
    step.push(one_in(3) ? octet() : kCommands[below(8)]);
    step.push(one_in(3) ? octet() : (one_in(2) ? 0 : 1));
    if (one_in(20)) spoil(step, 1);
}

void Generator::give_inputs(const model::Slave& slave, Step& step)
{
    step.kind = Kind::inputs;
    step.numbers[0] = one_in(8) ? static_cast<int>(below(4)) : 0;
    step.numbers[1] = (one_in(3) ? 0 : 1) + (one_in(3) ? 2 : 0);
    step.numbers[2] = slave.device.tries_outputs && one_in(3) ? 1 : 0;
    if (slave.device.waits_for_drive && one_in(4)) step.numbers[2] += 2;
    for (std::size_t i = 0; i < slave.parameters.size(); ++i) {
        step.push(octet());
        step.push(octet());
    }
}

void Generator::give_answer(Step& step)
{
    step.kind = Kind::answer;
    step.numbers[0] = one_in(6) ? static_cast<int>(below(4)) : 0;
    step.numbers[1] = one_in(2) ? 0 : static_cast<int>(below(14));
    step.numbers[2] = static_cast<int>(below(65'536));
}

/// Blocks of all four kinds, some of them cut short.
void Generator::give_diag(Step& step)
{
    step.kind = Kind::diag;
    step.numbers[0] = static_cast<int>(below(2));
    const unsigned blocks = below(4);
    for (unsigned i = 0; i < blocks; ++i) {
        const unsigned length = one_in(8) ? 2 + below(30) : 2 + below(4);
        switch (below(4)) {
            case 0:
            case 1:
                step.push((one_in(3) ? 0x40 : 0) + length);
                for (unsigned k = 1; k < length; ++k) step.push(one_in(2) ? 0 : below(3));
                break;
            case 2:
                step.push(0x80 + below(64));
                step.push(octet());
                step.push(octet());
                break;
            default: step.push(0xC0 + below(64)); break;
        }
    }
    spoil(step, 8);
}

} // namespace test
