// SPDX-License-Identifier: Apache-2.0
/// Layer 2, Set_Prm, Chk_Cfg and the states. Section numbers are those of the wire reference.
#include "model.hpp"

#include <algorithm>

namespace model {

// ----- 6.3, B1, B2

void Slave::start()
{
    state = wait_prm;
    min_tsdr = 11;
    prm_fault = not_supported = cfg_fault = false;
    accepted_cfg.clear();
    stored = false;
}

void Slave::stop()
{
    if (state != power_on) leave();
    state = power_on;
}

void Slave::leave()
{
    if (state == data_exch) left.push_back(layout);
    if (state == data_exch && demand && (standing.kind != Order::cancel || !orders.empty())) {
        orders.clear(); // what nobody fetched is not done behind the safe state
        order(Order::cancel, 0, 0);
    }
    state = wait_prm;
    owner = kNobody;
    watchdog_on = false;
    sync = freeze = sync_wanted = freeze_wanted = false;
    groups = 0;
    user_prm.clear();
    tags.clear();
    received = active = inputs = frozen = Image{};
    has_outputs = may_write = in_force = false;
    outputs_at = -1;
    layout = 0;
    parameters.clear();
    demand = false;
    for (int i = 0; i < 4; ++i) demand_reply[i] = wanted[i] = 0;
    stat_diag = false;
    drive_found = {};
    pending = false;
}

// ----- 7.1, C2

void Slave::tick(long long now)
{
    if (state == power_on) return;
    if (watchdog_on && now >= owner_heard + watchdog) leave();
    if (outputs_at >= 0 && now > outputs_at + 2'000'000'000) outputs_at = -1;
    if (stat_diag && !device.waits_for_drive && !waited_long_enough && now >= began + 1'000'000'000) {
        waited_long_enough = true;
        if (!drive_found.holds && !drive_answers) end_stat_diag();
    }
}

long long Slave::deadline() const
{
    long long next = -1;
    if (watchdog_on) next = owner_heard + watchdog;
    if (stat_diag && !device.waits_for_drive && !waited_long_enough &&
        (next < 0 || began + 1'000'000'000 < next))
        next = began + 1'000'000'000;
    if (outputs_at >= 0 && (next < 0 || outputs_at + 2'000'000'001 < next)) next = outputs_at + 2'000'000'001;
    return next;
}

// ----- 2.6, 6.7

void Slave::request(const Request& asked)
{
    tick(asked.at);
    not_before = min_tsdr;
    not_after = std::max(device.max_tsdr, min_tsdr + 49);
    const int function = asked.fc & 0x0F;
    const int fcb = (asked.fc >> 5) & 1;
    const int fcv = (asked.fc >> 4) & 1;

    if (fcv == 0 && fcb == 0) {
        execute(asked);
    } else {
        const bool same_sequence = stored && fcv == 1 && asked.sa == sam && fcb == fcbm;
        if (same_sequence && function == stored_function && asked.dsap == stored_dsap) {
            reply = stored_reply;
        } else {
            execute(asked);
            stored = true;
            fcbm = fcb;
            sam = asked.sa;
            stored_function = function;
            stored_dsap = asked.dsap;
            stored_reply = reply;
        }
    }
    if (asked.sa == owner) owner_heard = asked.at;
}

/// 3.1
void Slave::execute(const Request& asked)
{
    const int function = asked.fc & 0x0F;
    if (function == 0x9) {
        sd1(asked, 0x00);
    } else if (function == 0xC || function == 0xD) {
        srd(asked);
    } else {
        sd1(asked, 0x03);
    }
}

void Slave::srd(const Request& asked)
{
    if (asked.dsap == kNoSap && asked.ssap == kNoSap) {
        data_exchange(asked);
        return;
    }
    if (asked.ssap != 62) {
        sd1(asked, 0x03);
        return;
    }
    Octets data;
    switch (asked.dsap) {
        case 56: // RD_Inp
        case 57: // RD_Outp
            if (state != data_exch) {
                sd1(asked, 0x03);
            } else if (asked.length != 0) {
                sd1(asked, 0x02);
            } else if (asked.dsap == 56) {
                append_inputs(data);
                in_length == 0 ? sc() : sd2(asked, 0x08, data);
            } else {
                if (demand)
                    for (const int word : active.registers) {
                        data.push_back(static_cast<std::uint8_t>(word / 256));
                        data.push_back(static_cast<std::uint8_t>(word % 256));
                    }
                for (std::size_t i = 0; i < parameters.size(); ++i) {
                    if (!parameters[i].writes) continue;
                    data.push_back(static_cast<std::uint8_t>(active.words[i] / 256));
                    data.push_back(static_cast<std::uint8_t>(active.words[i] % 256));
                }
                out_length == 0 ? sc() : sd2(asked, 0x08, data);
            }
            break;
        case 59: // Get_Cfg
            if (asked.length != 0)
                sd1(asked, 0x02);
            else if (accepted_cfg.empty())
                sc();
            else
                sd2(asked, 0x08, accepted_cfg);
            break;
        case 60: // Slave_Diag
            if (asked.length != 0) {
                sd1(asked, 0x02);
            } else {
                diagnosis(data);
                sd2(asked, 0x08, data);
                if (asked.sa == owner && !stat_diag) pending = false;
            }
            break;
        case 61: set_prm(asked); break;
        case 62: chk_cfg(asked); break;
        default: sd1(asked, 0x03); break;
    }
}

// ----- 4.4

void Slave::set_prm(const Request& asked)
{
    sc();
    if (asked.length < 7) return;
    if (owner != kNobody && asked.sa != owner) return;
    const bool lock = (asked.data[0] & 0x80) != 0;
    const bool unlock = (asked.data[0] & 0x40) != 0;
    if (!lock && !unlock) {
        if (asked.data[3] != 0) min_tsdr = std::max<int>(11, asked.data[3]);
        return;
    }
    if (unlock) {
        if (state != wait_prm) leave();
        return;
    }
    const bool wants_sync = (asked.data[0] & 0x20) != 0;
    const bool wants_freeze = (asked.data[0] & 0x10) != 0;
    const bool wants_watchdog = (asked.data[0] & 0x08) != 0;
    const bool other_ident = asked.data[4] * 256 + asked.data[5] != device.ident;
    const bool unsupported = (wants_sync && !device.sync) || (wants_freeze && !device.freeze);
    const bool no_time = wants_watchdog && (asked.data[1] == 0 || asked.data[2] == 0);
    if (other_ident || (no_time && !unsupported))
        refuse_prm(false);
    else if (unsupported)
        refuse_prm(true);
    else
        take_parameters(asked);
}

void Slave::refuse_prm(bool unsupported)
{
    if (state != wait_prm) leave();
    if (unsupported)
        not_supported = true;
    else
        prm_fault = true;
}

/// Check 8, then P3, P7, P11, P12.
void Slave::take_parameters(const Request& asked)
{
    std::vector<int> found;
    if (!user_prm_is_good(asked.data + 7, asked.length - 7, found)) {
        refuse_prm(false);
        return;
    }
    const Octets user(asked.data + 7, asked.data + asked.length);
    if (state == data_exch && user != user_prm) leave();

    owner = asked.sa;
    watchdog_on = (asked.data[0] & 0x08) != 0;
    long long base = 10'000'000;
    if (device.dpv1_status && !user.empty() && (user[0] & 0x04) != 0) base = 1'000'000;
    watchdog = base * asked.data[1] * asked.data[2];
    owner_heard = asked.at;
    if (asked.data[3] != 0) min_tsdr = std::max<int>(11, asked.data[3]);
    groups = asked.data[6];
    sync_wanted = (asked.data[0] & 0x20) != 0;
    freeze_wanted = (asked.data[0] & 0x10) != 0;
    user_prm = user;
    tags = found;
    prm_fault = false;
    not_supported = false;
    if (state == wait_prm) state = wait_cfg;

    // A master that gives them up ends them (C-21).
    if (sync && !sync_wanted) {
        active = received;
        sync = false;
        outputs_are_in_force();
    }
    if (freeze && !freeze_wanted) freeze = false;
}

bool Slave::user_prm_is_good(const std::uint8_t* user, int length, std::vector<int>& found) const
{
    if (length == 0 && device.prm_may_be_absent) return true;
    if (length < device.shortest_prm || length > device.longest_prm) return false;
    if (device.list == no_tags) return true;
    if ((length - device.tags_at) % 2 != 0) return false;
    if (device.dpv1_status) {
        const int refused = device.fail_safe ? 0xB8 : 0xF8;
        if ((user[0] & refused) != 0 || user[1] != 0 || user[2] != 0) return false;
    }
    bool ended = false;
    for (int i = device.tags_at; i < length; i += 2) {
        const int tag = user[i] * 256 + user[i + 1];
        if (tag == 0) {
            if (device.list == exact) return false;
            ended = true;
            continue;
        }
        if (ended && device.list == first_zero_ends) continue;
        if (ended) return false;
        if (tag > device.highest_tag) return false;
        found.push_back(tag);
    }
    return true;
}

// ----- 4.5

void Slave::chk_cfg(const Request& asked)
{
    if (state == wait_prm || asked.sa != owner) {
        sd1(asked, 0x03);
        return;
    }
    sc();
    const Octets said(asked.data, asked.data + asked.length);
    if (state == data_exch) {
        if (said == accepted_cfg) return;
        leave();
        cfg_fault = true;
        return;
    }
    std::vector<Parameter> found;
    bool with_demand = false;
    if (cfg_is_good(asked, found, with_demand)) {
        accepted_cfg = said;
        begin_exchange(asked, found, with_demand);
    } else {
        leave();
        cfg_fault = true;
    }
}

bool Slave::cfg_is_good(const Request& asked, std::vector<Parameter>& found, bool& with_demand) const
{
    if (asked.length == 0) return false;
    int words = 0;
    for (int i = 0; i < asked.length; ++i) {
        if (i == 0 && device.demand_identifier != 0 && asked.data[0] == device.demand_identifier) {
            with_demand = true;
            words += 8;
            continue;
        }
        bool known = false;
        for (const Identifier& one : device.identifiers) {
            if (one.octet != asked.data[i]) continue;
            known = true;
            found.push_back({0, one.reads, one.writes});
            words += (one.reads ? 1 : 0) + (one.writes ? 1 : 0);
        }
        if (!known) return false;
    }
    if (static_cast<int>(found.size()) > device.most_parameters) return false;
    if (device.most_words != 0 && words > device.most_words) return false;
    if (device.list != no_tags && found.size() != tags.size()) return false;
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i].tag = device.list == no_tags ? static_cast<int>(i) + 1 : tags[i];
    return true;
}

void Slave::begin_exchange(const Request& asked, const std::vector<Parameter>& chosen, bool with_demand)
{
    state = data_exch;
    layout = ++layouts;
    parameters = chosen;
    demand = with_demand;
    in_length = out_length = with_demand ? 8 : 0;
    bool something_to_try = device.tries_outputs && !chosen.empty();
    for (const Parameter& one : chosen) {
        if (one.reads) in_length += 2;
        if (one.writes) out_length += 2;
        if (one.reads) something_to_try = true;
    }
    cfg_fault = false;
    received = active = inputs = frozen = Image{};
    has_outputs = may_write = in_force = false;
    outputs_at = -1;
    drive_found = {};
    for (int i = 0; i < 4; ++i) demand_reply[i] = wanted[i] = 0;
    standing = Order{};
    stat_diag = something_to_try;
    waited_long_enough = has_begun = false;
    began = asked.at;
    if (stat_diag) pending = true;
}

// ----- 2.1, 2.2, 2.5

void Slave::sd1(const Request& asked, int fc)
{
    reply.resize(6);
    reply[0] = 0x10;
    reply[1] = static_cast<std::uint8_t>(asked.sa);
    reply[2] = static_cast<std::uint8_t>(address);
    reply[3] = static_cast<std::uint8_t>(fc);
    reply[4] = static_cast<std::uint8_t>(asked.sa + address + fc);
    reply[5] = 0x16;
}

void Slave::sc()
{
    reply.resize(1);
    reply[0] = 0xE5;
}

void Slave::sd2(const Request& asked, int fc, const Octets& data)
{
    const bool saps = asked.dsap != kNoSap;
    const int le = 3 + (saps ? 2 : 0) + static_cast<int>(data.size());
    reply.clear();
    reply.push_back(0x68);
    reply.push_back(static_cast<std::uint8_t>(le));
    reply.push_back(static_cast<std::uint8_t>(le));
    reply.push_back(0x68);
    reply.push_back(static_cast<std::uint8_t>(asked.sa + (saps ? 0x80 : 0)));
    reply.push_back(static_cast<std::uint8_t>(address + (saps ? 0x80 : 0)));
    reply.push_back(static_cast<std::uint8_t>(fc));
    if (saps) reply.push_back(static_cast<std::uint8_t>(asked.ssap));
    if (saps) reply.push_back(static_cast<std::uint8_t>(asked.dsap));
    for (const std::uint8_t octet : data) reply.push_back(octet);
    int sum = 0;
    for (std::size_t i = 4; i < reply.size(); ++i) sum += reply[i];
    reply.push_back(static_cast<std::uint8_t>(sum % 256));
    reply.push_back(0x16);
}

} // namespace model
