// SPDX-License-Identifier: Apache-2.0
/// A DP master by the second hand, at whatever stands for a wire.
#pragma once

#include "wire.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace test {

inline constexpr std::uint8_t kUs = 5; ///< the address of the slave under test, unless a test says another

/// What a master has before it.
class Wire {
public:
    /// Sends one telegram and waits for the reply; nothing: there was none within the slot time.
    virtual std::optional<Octets> ask(const Octets& telegram) = 0;
    /// Sends one telegram that has no acknowledgement. An answer is a failure of the test.
    virtual void send(const Octets& telegram) = 0;

protected:
    ~Wire() = default;
};

/// Keeps its frame count bit. Requests are answered in a short form: "SC", "RS", "RR", "DL 12 34", "DH
/// 12 34"; "-" is silence.
class Master {
public:
    Master(Wire& wire, std::uint8_t address, std::uint8_t slave = kUs)
        : wire_(wire), address_(address), slave_(slave)
    {}

    std::string asks(std::uint8_t dsap, const Octets& data = {}, std::uint8_t ssap = 62);
    std::string data_exchange(const Octets& outputs);
    std::string data_exchange(std::string_view outputs) { return data_exchange(octets(outputs)); }
    std::string rd_inp(const Octets& data = {}) { return asks(56, data); }
    std::string rd_outp(const Octets& data = {}) { return asks(57, data); }
    std::string get_cfg(const Octets& data = {}) { return asks(59, data); }
    std::string slave_diag(const Octets& data = {}) { return asks(60, data); }
    std::string set_prm(const Octets& prm) { return asks(61, prm); }
    std::string set_prm(std::string_view prm) { return set_prm(octets(prm)); }
    std::string chk_cfg(const Octets& cfg) { return asks(62, cfg); }
    std::string chk_cfg(std::string_view cfg) { return chk_cfg(octets(cfg)); }
    /// Global_Control to all stations: control command, group select.
    void control(const Octets& data);
    void control(std::string_view data) { control(octets(data)); }
    std::string fdl_status();
    /// The last request once more, as after a lost reply.
    std::string repeats();
    /// One telegram, written out, and the reply to it in octets ("-": none).
    std::string says(std::string_view telegram);
    /// One telegram that is no turn of the frame count bit.
    std::string sends(const Octets& telegram);

    /// FC of an SRD with the next frame count bit: 6D begins a sequence, then 5D and 7D in turn.
    std::uint8_t next_fc();
    std::uint8_t address() const { return address_; }

private:
    Wire& wire_;
    std::uint8_t address_;
    std::uint8_t slave_;
    std::uint8_t fc_ = 0;
    Octets last_;
};

} // namespace test
