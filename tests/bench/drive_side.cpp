// SPDX-License-Identifier: Apache-2.0
#include "drive_side.hpp"

#include <algorithm>
#include <stdexcept>

namespace dpslave::bench {
namespace {

drive::TagTable make_table()
{
    std::vector<drive::Tag> rows;
    for (std::uint16_t number = 1; number <= kDemandTag; ++number) {
        drive::Tag tag;
        tag.number = number;
        tag.decimals = 2;
        tag.mnemonic = mnemonic_of(number);
        rows.push_back(tag);
    }
    return drive::TagTable{rows};
}

} // namespace

std::string mnemonic_of(std::uint16_t tag)
{
    return {static_cast<char>('a' + tag / 10), static_cast<char>('0' + tag % 10)};
}

EiAsciiDrive::EiAsciiDrive(std::uint32_t baud)
    : line(baud), client(line, {.baud = baud}, {{{0, 1}, drive::MnemonicRule::none}})
{
    line.drives = {&drive};
    drive.turnaround = kTurnaround;
    for (std::uint16_t tag = 1; tag <= kDemandTag; ++tag) drive.parameters[mnemonic_of(tag)].text = kText;
}

DriveSide::DriveSide(drive::Backend& backend, Instant& clock, bool compares)
    : table_(make_table()),
      backend_(backend),
      clock_(clock),
      poller_(settings(compares), backend.block_rule())
{}

std::vector<drive::DriveSettings> DriveSide::settings(bool compares) const
{
    drive::DriveSettings unit;
    unit.tags = &table_;
    unit.output_refresh = std::chrono::nanoseconds{0}; // every parameter in every cycle
    unit.compare_outputs = compares;
    return {unit};
}

std::chrono::nanoseconds DriveSide::step(Instant limit)
{
    const Instant began = clock_;
    const auto next = poller_.next(began);
    if (!next) {
        clock_ = std::clamp(poller_.next_deadline(), clock_, std::max(clock_, limit));
        return std::chrono::nanoseconds{0};
    }
    if (const AccessError error = carry_out(*next); error != AccessError::none)
        throw std::runtime_error{backend_.last_trouble()};
    poller_.done({AccessError::none, words_, backend_.last_answer()}, clock_);
    return clock_ - began;
}

AccessError DriveSide::carry_out(const drive::Transaction& transaction)
{
    using Kind = drive::Transaction::Kind;
    constexpr drive::UnitAddress kUnit{0, 1};
    words_.resize(transaction.count);
    switch (transaction.kind) {
        case Kind::read: return backend_.read(kUnit, *transaction.tag, words_);
        case Kind::write: return backend_.write(kUnit, *transaction.tag, transaction.words);
        case Kind::probe: break;
    }
    return backend_.probe(kUnit);
}

} // namespace dpslave::bench
