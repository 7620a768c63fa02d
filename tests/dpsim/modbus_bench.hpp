// SPDX-License-Identifier: Apache-2.0
/// Instruments on a Modbus RTU line with a simulated clock; the master is what the test writes.
#pragma once

#include "dpsim/instrument/instrument_commands.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

#include <array>

namespace dpslave::sim {

/// CRC by table: another hand than the one under test.
inline std::uint16_t table_crc(const Octets& octets)
{
    static const auto table = [] {
        std::array<std::uint16_t, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            std::size_t c = i;
            for (int k = 0; k < 8; ++k) c = c % 2 == 1 ? c / 2 ^ 0xA001 : c / 2;
            t[i] = static_cast<std::uint16_t>(c);
        }
        return t;
    }();
    std::uint16_t crc = 0xFFFF;
    for (const std::uint8_t octet : octets)
        crc = static_cast<std::uint16_t>(crc >> 8 ^ table[static_cast<std::uint8_t>(crc ^ octet)]);
    return crc;
}

/// A small instrument: what the tests need of chapter 8, and the whole program store as words.
inline std::string instrument_table()
{
    std::string table = "tag,name,type,decimals,min,max,access,values,start,notes\n"
                        "1,Process variable,REAL,display,,,,,18.3\n"
                        "2,Target setpoint,REAL,display,,,rw,,\n"
                        "3,Output power,REAL,1,-100.0,100.0,rw,,0.0\n"
                        "5,Working setpoint,REAL,display,,,ro,,\n"
                        "8,Integral time,INT,0,0,65535,rw,,40000,time type\n"
                        "15,Select setpoint,ENUM,,0,15,rw,,0\n"
                        "22,Program number,INT,0,1,4,rw,,\n"
                        "23,Program status,ENUM,,,,rw,1=Reset;2=Run;4=Hold;16=Complete,\n"
                        "24,Setpoint 1,REAL,display,0.0,500.0,rw,,\n"
                        "25,Setpoint 2,REAL,display,0.0,500.0,rw,,\n"
                        "36,Segment time remaining in seconds,INT,0,0,65535,,,90,time type\n"
                        "63,Segment time remaining in minutes,INT,0,0,65535,,,3,time type\n"
                        "80,Heater current,REAL,0,,,,,7\n"
                        "74,Fast status,WORD,,,,ro,,\n"
                        "75,Summary output status,WORD,,,,ro,,\n"
                        "76,Control status,WORD,,,,ro,,\n"
                        "122,Ident,WORD,,,,ro,,\n"
                        "164,Setpoint 3,INT,0,,,rw,,0\n"
                        "165,Setpoint 4,INT,0,,,rw,,0\n"
                        "166,Setpoint 5,INT,0,,,rw,,0\n"
                        "199,Instrument mode,ENUM,,,,ro,,0\n"
                        "220,Skip read only,ENUM,,0,1,rw,,0\n"
                        "270,Autotune,ENUM,,0,1,rw,0=No tune;1=Tune,0\n"
                        "273,Manual,ENUM,,0,1,rw,0=Auto;1=Manual,0\n"
                        "525,Decimals,ENUM,,0,2,rw,,1\n"
                        "12550,Resolution,ENUM,,0,1,rw,0=Full;1=Integer,0\n";
    for (unsigned tag = 8192; tag <= 8871; ++tag)
        table += std::to_string(tag) + ",Program store,WORD,,,,rw,,\n";
    return table;
}

class InstrumentBench : public testing::Test {
protected:
    explicit InstrumentBench(unsigned programs = 1)
    {
        EXPECT_TRUE(line.add({1, 0x2480, *parse_tags(instrument_table(), "2400.csv"), programs}));
        line.set_logging(true);
    }
    /// What comes back to these octets within 2 s; empty = silence.
    Octets hears(const Octets& octets)
    {
        now += std::chrono::milliseconds{100};
        line.on_bytes(octets, now);
        if (line.next_deadline() > now + std::chrono::seconds{2}) return {};
        now = line.next_deadline();
        return line.take_reply(now).value_or(Octets{});
    }
    /// A request without its CRC, and the reply without its own, in hexadecimal; "" = silence.
    std::string asks(const std::string& request)
    {
        Octets octets = wire(request);
        const std::uint16_t crc = table_crc(octets);
        octets.insert(octets.end(), {low(crc), high(crc)});
        Octets reply = hears(octets);
        if (reply.empty()) return {};
        const Octets body(reply.begin(), reply.end() - 2);
        const std::uint16_t own = table_crc(body);
        EXPECT_EQ(reply[reply.size() - 2], low(own)) << hex(reply);
        EXPECT_EQ(reply[reply.size() - 1], high(own)) << hex(reply);
        return hex(body);
    }
    std::vector<std::string> type(const std::string& text) { return commands.command(text, now); }

    Instant now{std::chrono::seconds{1}};
    ModbusLine line{std::chrono::milliseconds{5}};
    InstrumentCommands commands{line};
};

} // namespace dpslave::sim
