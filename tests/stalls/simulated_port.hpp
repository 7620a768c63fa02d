// SPDX-License-Identifier: Apache-2.0
/// The port of a simulated line as the client of the program has it: it waits in slices, gives signs, and may
/// stall, as app/line/tty_line and modbus/rtu_line do with a tty.
#pragma once

#include "drive_line/ei_line.hpp"
#include "drive_line/modbus_frames.hpp"
#include "world.hpp"

#include "dpslave/drive/backend.hpp"

namespace dpslave::stalls {

class EiPort final : public drive::SerialLine {
public:
    EiPort(World& world, drive_line::EiLine& line) : world_(world), line_(line) {}

    bool write(Bytes octets) override;
    bool may_have_left() const override { return may_have_left_; }
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override;
    Instant now() const override { return world_.now(); }
    void discard() override { line_.discard(); }
    bool takes_wire_time() const override { return line_.takes_wire_time(); }

private:
    World& world_;
    drive_line::EiLine& line_;
    bool has_unsent_ = false;
    bool may_have_left_ = false;
    unsigned opened_ = world_.times_closed();
};

class FramesPort final : public modbus::ModbusPort {
public:
    FramesPort(World& world, drive_line::ModbusFrames& line) : world_(world), line_(line) {}

    bool send(std::uint8_t unit, Bytes pdu) override;
    bool may_have_left() const override { return may_have_left_; }
    Heard receive(Instant until) override;
    Bytes frame() const override { return line_.frame(); }
    Piece piece() const override { return line_.piece(); }
    bool takes_wire_time() const override { return line_.takes_wire_time(); }
    Instant now() const override { return world_.now(); }

private:
    World& world_;
    drive_line::ModbusFrames& line_;
    bool has_unsent_ = false;
    bool may_have_left_ = false;
    unsigned opened_ = world_.times_closed();
};

/// A client with the port that is its own.
template <class Port>
class OnPort final : public drive::Backend {
public:
    OnPort(World& world, std::unique_ptr<Port> port, std::unique_ptr<drive::Backend> client)
        : world_(world), port_(std::move(port)), client_(std::move(client))
    {}
    drive::BlockRule block_rule() const override { return client_->block_rule(); }
    AccessError read(drive::UnitAddress unit, const drive::Tag& tag, std::span<std::uint16_t> words) override
    {
        return noted(unit, client_->read(unit, tag, words));
    }
    AccessError write(drive::UnitAddress unit, const drive::Tag& tag,
                      std::span<const std::uint16_t> words) override
    {
        return noted(unit, client_->write(unit, tag, words));
    }
    AccessError write_once(drive::UnitAddress unit, const drive::Tag& tag,
                           std::span<const std::uint16_t, 1> word) override
    {
        return noted(unit, client_->write_once(unit, tag, word));
    }
    bool has_sent() const override { return client_->has_sent(); }
    bool may_be_older() const override { return client_->may_be_older(); }
    unsigned questions() const override { return client_->questions(); }
    AccessError probe(drive::UnitAddress unit) override { return noted(unit, client_->probe(unit)); }
    std::string last_trouble() const override { return client_->last_trouble(); }
    void listen() override { client_->listen(); }
    drive::AnswerCounts counts(drive::UnitAddress unit) const override { return client_->counts(unit); }
    std::string_view last_answer() const override { return client_->last_answer(); }

private:
    AccessError noted(drive::UnitAddress unit, AccessError error)
    {
        if (error != AccessError::no_answer && error != AccessError::deferred)
            world_.judge().has_answered(unit.unit, world_.now());
        return error;
    }
    World& world_;
    std::unique_ptr<Port> port_;
    std::unique_ptr<drive::Backend> client_;
};

} // namespace dpslave::stalls
