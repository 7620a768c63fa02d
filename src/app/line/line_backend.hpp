// SPDX-License-Identifier: Apache-2.0
/// The port of a drive line and the back-end that speaks over it, by the protocol of the line.
#pragma once

#include "app/bus/driver_guard.hpp"
#include "app/links/links.hpp"
#include "tty_line.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

class LineBackend {
public:
    /// What a back-end tells of itself. All of it outlives the back-end.
    struct Listeners {
        /// When the port vanishes and returns in service, not that it was opened now, which may be a trial.
        std::atomic<bool>& is_open;
        io::TransceiverCounts& transceiver;
        drive::FrameListener& frames;                 ///< is told each frame
        LineHappenings& happenings;                   ///< is told what happens to the port
        std::atomic<std::uint64_t>& settings_changed; ///< LineLink's, and the next one too
        Mailbox<io::ChangedSettings>& changed_settings;
        /// LineLink's: from then on the guard of the driver enable lets nothing be active.
        const std::atomic<Instant>& ends_by;
    };
    explicit LineBackend(const Listeners& listeners)
        : listeners_(listeners) {} ///< without a port: see open()
    /// Opens the port with the driver enable of its transceiver, and starts the guard of that. The error is a
    /// sentence.
    static Result<std::unique_ptr<LineBackend>, std::string> open(const config::LineConfig& line,
                                                                  const Listeners& listeners);

    /// Of the back-end that this line has, or will have once its port can be opened.
    static drive::BlockRule block_rule(const config::LineConfig& line);

    drive::Backend& backend() { return *backend_; }
    /// The port has stalled: what it has not sent is discarded, and it is opened again at once. What the
    /// drives still owe stays owed.
    void reopen();
    /// What another program has changed of the settings of the port; nullopt: nothing, or there is no port.
    std::optional<io::ChangedSettings> changed_settings() const;
    /// Sets them again; an error: the port does not take them.
    std::error_code set_again(const io::ChangedSettings& changed);
    /// Readable between two questions: Backend::listen() is due. -1: the port is gone.
    int fd() const;
    /// What happened to the port since the last call.
    void tell_port_messages();
    /// The drives from now on.
    void set_units(const std::vector<DriveUnit>& units);
    /// Who switches the transceiver, for the log; empty: it switches by itself.
    std::string driver_in_words() const;

private:
    io::SwitchedPort& port() const;
    void start_guard(const config::LineConfig& line, io::TransceiverCounts& counts);

    const Listeners listeners_;
    std::unique_ptr<TtyLine> tty_;             ///< of EI-ASCII; a Modbus back-end has its port itself
    drive::EiAsciiClient* ei_ascii_ = nullptr; ///< the back-end, if it is one
    modbus::ModbusRtu* modbus_ = nullptr;      ///< the same
    std::unique_ptr<drive::Backend> backend_;
    std::optional<DriverGuard> guard_; ///< behind the port that it watches
    bool is_gone_told_ = false;        ///< of a Modbus port
};

/// What a back-end in service tells to the link of its line.
inline LineBackend::Listeners listeners_of(LineLink& link)
{
    return {.is_open = link.port_open,
            .transceiver = link.transceiver,
            .frames = *link.trace,
            .happenings = link.happenings,
            .settings_changed = link.settings_changed,
            .changed_settings = link.changed_settings,
            .ends_by = link.ends_by};
}

} // namespace dpslave::app
