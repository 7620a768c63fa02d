// SPDX-License-Identifier: Apache-2.0
/// The port of a drive line and the back-end that speaks over it, by the protocol of the line.
#pragma once

#include "app/links.hpp"
#include "tty_line.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace dpslave::app {

class LineBackend {
public:
    /// Opens the port. `is_open` says when it vanishes and returns in service, not that it was opened
    /// now, which may be a trial; `frames` is told each frame. Both outlive the back-end. The error is a
    /// sentence.
    static Result<std::unique_ptr<LineBackend>, std::string>
    open(const config::LineConfig& line, std::atomic<bool>& is_open, drive::FrameListener& frames);

    /// Of the back-end that this line has, or will have once its port can be opened.
    static drive::BlockRule block_rule(const config::LineConfig& line);

    drive::Backend& backend() { return *backend_; }
    /// Readable between two questions: Backend::listen() is due. -1: the port is gone.
    int fd() const;
    /// What happened to the port since the last call goes to `log`.
    void log_port_messages(LimitedLog& log, Instant now);
    /// The drives from now on.
    void set_units(const std::vector<DriveUnit>& units);

private:
    std::unique_ptr<TtyLine> tty_;             ///< of EI-ASCII; a Modbus back-end has its port itself
    drive::EiAsciiClient* ei_ascii_ = nullptr; ///< the back-end, if it is one
    modbus::ModbusRtu* modbus_ = nullptr;      ///< the same
    std::unique_ptr<drive::Backend> backend_;
};

} // namespace dpslave::app
