// SPDX-License-Identifier: Apache-2.0
/// One or more EI-ASCII drives in memory on one serial line (EI-ASCII reference, section 1).
#pragma once

#include "dpsim/common/device.hpp"
#include "ei_ascii.hpp"

#include <map>

namespace dpslave::sim {

/// The faults that a drive makes on request.
struct DriveFaults : DeviceFaults {
    std::optional<Ee> nak; ///< refuses every write with this error
};

/// One drive; its address is group and unit id, "00".
class DriveUnit : public Device {
public:
    using Device::Device;
    SimParameter* find_mnemonic(std::string_view mnemonic);

    std::map<std::uint16_t, std::string> texts; ///< of tags that answer with this text, whatever they hold

    Ee error = Ee::none;
    DriveFaults faults{};
    std::uint64_t reads = 0, writes = 0, refusals = 0, bad_messages = 0;
};

class DriveLine : public DeviceLine {
public:
    DriveLine(Model model, std::chrono::nanoseconds turnaround) : DriveLine(model, turnaround, Naming{model})
    {}
    DriveLine(Model model, std::chrono::nanoseconds turnaround, Naming naming)
        : DeviceLine(turnaround, 0x7F), model_(model), naming_(std::move(naming))
    {}

    /// A drive with this group (0-7) and unit id (0-9, A-F); false if the address is none or taken.
    bool add_unit(std::string_view address, const std::vector<SimTag>& tags);

    void on_bytes(Bytes octets, Instant now) override;
    std::vector<Device*> devices() override;

    std::vector<DriveUnit>& units() { return units_; }

private:
    enum class Phase : std::uint8_t { idle, address, body, select, check, connected };
    void on_octet(std::uint8_t octet, Instant now);
    void collect(std::uint8_t octet);
    void malformed();
    void addressed();
    void poll(std::string_view mnemonic, Instant now);
    void poll_next(Instant now);
    void selected(std::uint8_t check, Instant now);
    Ee write(std::string_view mnemonic, std::string_view data);
    void answer(Octets octets, const SimParameter* parameter, Instant now);

    Model model_;
    Naming naming_;
    std::vector<DriveUnit> units_;
    std::size_t current_ = 0; ///< the unit that the connection is with
    Phase phase_ = Phase::idle;
    std::string text_;
    std::string polled_; ///< mnemonic of the last answered poll; empty = NAK and ACK mean nothing
    Instant heard_{};
};

} // namespace dpslave::sim
