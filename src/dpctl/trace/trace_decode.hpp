// SPDX-License-Identifier: Apache-2.0
/// What stands beneath each telegram of `dpctl trace --decode`: one level deeper. Pure. What it knows of a
/// slave comes from outside and from the telegrams that it has seen.
#pragma once

#include "dpctl/decode/decode.hpp"
#include "dpctl/decode/diagnosis_texts.hpp"

#include "dpslave/profile/profile.hpp"
#include "dpslave/trace/telegrams.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace dpslave::dpctl {

/// The slave whose meaning of Data_Exchange may change with this telegram; nothing: none.
std::optional<std::uint8_t> layout_changed_by(const trace::Entry& entry);

/// What the time of a telegram leaves open, where that is more than a character: the port may have held back
/// what it heard.
std::optional<std::string> how_exact(const trace::Entry& entry);

class TraceDecoder {
public:
    /// From now on the slave at `address` is this device.
    void set_device(std::uint8_t address, profile::Profile device);
    /// The Set_Prm and Chk_Cfg that are in force for it; empty: none. Telegrams that are seen later count
    /// more.
    void set_layout(std::uint8_t address, Bytes prm, Bytes cfg);
    /// What the GSD of the devices with this Ident_Number says.
    void add_texts(std::uint16_t ident, DiagnosisTexts texts) { texts_[ident] = std::move(texts); }

    /// What the telegram says. Nothing: it has nothing that its line does not show.
    std::optional<Decoded> decode(const trace::Entry& entry);

private:
    struct Slave {
        std::unique_ptr<const profile::Profile> device;
        DecodeContext context;
    };
    static std::optional<Decoded> decode_piece(Bytes octets);
    void learn_ident(const fdl::Telegram& telegram, Slave& slave) const;

    std::array<Slave, 128> slaves_; ///< by address
    std::map<std::uint16_t, DiagnosisTexts> texts_;
};

} // namespace dpslave::dpctl
