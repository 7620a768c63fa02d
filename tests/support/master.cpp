// SPDX-License-Identifier: Apache-2.0
#include "master.hpp"

namespace test {
namespace {

/// The reply in the short form.
std::string in_short(const std::optional<Octets>& reply)
{
    if (!reply) return "-";
    const auto telegram = heard(*reply);
    if (!telegram) return "not a telegram: " + show(*reply);
    if (telegram->delimiter == 0xE5) return "SC";
    std::string name;
    switch (telegram->fc) {
        case 0x00: name = "OK"; break;
        case 0x01: name = "UE"; break;
        case 0x02: name = "RR"; break;
        case 0x03: name = "RS"; break;
        case 0x08: name = "DL"; break;
        case 0x0A: name = "DH"; break;
        default: name = "FC " + show({telegram->fc}); break;
    }
    return telegram->data.empty() ? name : name + " " + show(telegram->data);
}

} // namespace

std::uint8_t Master::next_fc()
{
    fc_ = fc_ == 0 ? 0x6D : (fc_ == 0x5D ? 0x7D : 0x5D);
    return fc_;
}

std::string Master::sends(const Octets& telegram)
{
    last_ = telegram;
    return in_short(wire_.ask(telegram));
}

std::string Master::asks(std::uint8_t dsap, const Octets& data, std::uint8_t ssap)
{
    return sends(sd2(slave_, address_, next_fc(), Saps{dsap, ssap}, data));
}

std::string Master::data_exchange(const Octets& outputs)
{
    return sends(outputs.empty() ? sd1(slave_, address_, next_fc())
                                 : sd2(slave_, address_, next_fc(), outputs));
}

void Master::control(const Octets& data)
{
    wire_.send(sd2(127, address_, 0x46, Saps{58, 62}, data));
}

std::string Master::fdl_status()
{
    return sends(sd1(slave_, address_, 0x49));
}

std::string Master::repeats()
{
    return sends(last_);
}

std::string Master::says(std::string_view telegram)
{
    const auto reply = wire_.ask(octets(telegram));
    return reply ? show(*reply) : "-";
}

} // namespace test
