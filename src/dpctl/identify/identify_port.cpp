// SPDX-License-Identifier: Apache-2.0
#include "identify_port.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/wire_time.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/io/port_settings.hpp"
#include "dpslave/io/switched_port.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <fmt/format.h>
#include <grp.h>
#include <sys/stat.h>

#include <atomic>

namespace dpslave::dpctl {
namespace {

/// A port for one question: one that goes is silent.
class PortLine final : public drive::SerialLine {
public:
    explicit PortLine(io::SwitchedPort& port) : port_(port) {}

    bool write(Bytes octets) override { return !port_.write(octets); }
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override
    {
        if (!port_.is_open() || !port_.tty().wait_readable(timeout)) return 0;
        const auto chunk = port_.tty().read(into);
        if (chunk) return chunk->octets.size();
        port_.lose(now());
        return 0;
    }
    Instant now() const override { return io::monotonic_now(); }
    bool takes_wire_time() const override
    {
        return port_.is_open() && drive::takes_wire_time(drive::WireTime::automatic, port_.tty().is_pty());
    }
    void discard() override
    {
        if (port_.is_open()) static_cast<void>(port_.tty().discard_input());
    }

private:
    io::SwitchedPort& port_;
};

/// Whether a question was heard back.
class EchoListener final : public drive::FrameListener {
public:
    void on_frame(const drive::TracedFrame& frame) override
    {
        has_echo = has_echo || (frame.what == drive::TracedFrame::What::heard &&
                                frame.judgement == drive::Judgement::echo);
    }
    bool has_echo = false;
};

/// The group whose members may open `path`, by its name or its number. Empty: no group may.
std::string group_of(const std::string& path)
{
    struct stat what {};
    constexpr mode_t kBoth = S_IRGRP | S_IWGRP;
    if (::stat(path.c_str(), &what) < 0 || (what.st_mode & kBoth) != kBoth) return {};
    const group* const found = ::getgrgid(what.st_gid);
    return found != nullptr ? found->gr_name : std::to_string(what.st_gid);
}

} // namespace

std::string port_sentence(const std::string& path, const std::error_code& why)
{
    if (why == std::errc::no_such_file_or_directory || why == std::errc::not_a_directory)
        return path + " is not there: plug the adapter in, and look under /dev/serial/by-id for its name";
    if (why == std::errc::permission_denied || why == std::errc::operation_not_permitted) {
        const std::string group = group_of(path);
        if (group.empty()) return path + ": this user may not open it, and no group may: use sudo";
        return fmt::format(
            "{0}: this user may not open it: `sudo usermod -aG {1} $USER` adds you to the group {1} that owns it; then log in again",
            path, group);
    }
    if (why == std::errc::device_or_resource_busy)
        return fmt::format(
            "{0} is used by another program: `fuser {0}` shows which it is; stop it first. If it is dpslaved, ask that: dpctl doctor --probe",
            path);
    if (why == std::errc::inappropriate_io_control_operation)
        return path + " is no serial port: name a tty, such as /dev/ttyUSB0";
    return fmt::format("{} cannot be opened ({}): check the adapter, and that there is a UART behind it",
                       path, why.message());
}

Result<IdentifyPort::Asked, std::string> IdentifyPort::ask_ei(const drive::SearchQuestion& question) const
{
    const drive::LineSetting& setting = question.setting;
    io::TtySettings settings;
    settings.baud = setting.baud;
    settings.data_bits = setting.format.data_bits;
    settings.parity = setting.format.parity;
    settings.stop_bits = setting.format.stop_bits;
    settings.prompt = true;
    auto port = io::SwitchedPort::open(path_, settings, {.driver = driver_});
    if (!port) return Failure{port.error()};
    EchoListener listener;
    PortLine line{*port};
    const drive::LineTiming rules{
        .settle = {}, .hold_back = port->tty().hold_back(), .echo = EchoMode::automatic, .frames = &listener};
    drive::EiAsciiClient client{line, {.baud = setting.baud, .timeout = timeout_, .rules = rules}, {}};
    const drive::Sight sight = client.look(question.unit, question.look);
    return Asked{sight, listener.has_echo};
}

Result<IdentifyPort::Asked, std::string> IdentifyPort::ask_modbus(const drive::SearchQuestion& question) const
{
    const drive::LineSetting& setting = question.setting;
    EchoListener listener;
    modbus::RtuSettings settings;
    settings.port = path_;
    settings.baud = setting.baud;
    settings.data_bits = setting.format.data_bits;
    settings.parity = setting.format.parity;
    settings.stop_bits = setting.format.stop_bits;
    settings.timeout = timeout_;
    settings.rules = {.settle = {}, .hold_back = {}, .echo = EchoMode::automatic, .frames = &listener};
    settings.transceiver = {.driver = driver_};
    std::atomic<bool> is_open{true};
    const auto client = modbus::ModbusRtu::open(settings, is_open);
    if (!client) return Failure{client.error()};
    const drive::Sight sight = (*client)->look(question.unit, question.look);
    return Asked{sight, listener.has_echo};
}

Result<drive::Sight, std::string> IdentifyPort::ask(const drive::SearchQuestion& question)
{
    const bool is_modbus = question.setting.protocol == drive::LineProtocol::modbus_rtu;
    auto asked = is_modbus ? ask_modbus(question) : ask_ei(question);
    // An adapter that was pulled is silent in the middle of a question.
    if (const auto trouble = io::port_trouble(path_))
        return Failure{path_ + " has gone: check the adapter and its cable, then begin again"};
    if (asked) {
        was_open_ = true;
        hears_itself_ = hears_itself_ || asked->has_echo;
        return asked->sight;
    }
    // The same reason at two rates has nothing to do with the rate.
    const auto first = refused_.emplace(asked.error(), question.setting.baud).first;
    if (first->second != question.setting.baud) return Failure{asked.error()};
    return drive::Sight{};
}

std::set<std::string> IdentifyPort::refused() const
{
    std::set<std::string> all;
    for (const auto& [sentence, baud] : refused_) all.insert(sentence);
    return all;
}

} // namespace dpslave::dpctl
