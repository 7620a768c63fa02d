// SPDX-License-Identifier: Apache-2.0
/// The EI-ASCII master on one serial line with one or several drives. One attempt per call: the poller
/// repeats.
#pragma once

#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/ei_ascii.hpp"
#include "dpslave/drive/line_timing.hpp"
#include "dpslave/drive/serial_line.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::drive {

namespace ei {
class Access;
}

/// One drive of the line: its address and how its family names tags. The form of an ENUM goes with the rule.
struct EiDrive {
    UnitAddress address{};
    MnemonicRule mnemonics = MnemonicRule::none;
};

class EiForms;

struct EiTiming {
    std::uint32_t baud = 9600; ///< bit/s, not 0; ten bits a character
    std::chrono::milliseconds timeout{
        200}; ///< from the end of the request to the first character of the answer
    LineTiming rules{};
};

class EiAsciiClient final : public Backend {
public:
    /// `line` outlives the client. A unit that is not among `units` has only the mnemonics of the tag table.
    EiAsciiClient(SerialLine& line, EiTiming timing, std::vector<EiDrive> units);
    ~EiAsciiClient() override;
    /// The drives from now on.
    void set_units(std::vector<EiDrive> units);

    BlockRule block_rule() const override { return {}; }
    AccessError read(UnitAddress unit, const Tag& tag, std::span<std::uint16_t> words) override;
    AccessError write(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t> words) override;
    AccessError write_once(UnitAddress unit, const Tag& tag, std::span<const std::uint16_t, 1> word) override;
    bool has_sent() const override { return has_sent_; }
    bool may_be_older() const override;
    unsigned questions() const override;
    AccessError probe(UnitAddress unit) override;
    Sight look(UnitAddress unit, const Look& what) override;
    std::string last_trouble() const override { return trouble_; }
    AnswerCounts counts(UnitAddress unit) const override;
    void listen() override;
    std::string_view last_answer() const override { return answer_; }

private:
    std::optional<ei::Mnemonic> mnemonic_for(UnitAddress unit, const Tag& tag);
    AccessError write_word(UnitAddress unit, const Tag& tag, std::uint16_t word, bool once);
    AccessError take_value(UnitAddress unit, const Tag& tag, const std::string& text, std::uint16_t& word);
    MnemonicRule rule_of(UnitAddress unit) const;

    std::unique_ptr<ei::Access> access_;
    std::vector<EiDrive> units_;
    std::unique_ptr<EiForms> forms_;
    std::string trouble_;
    bool has_sent_ = false;
    unsigned asked_before_ = 0; ///< the last call
    std::string answer_;        ///< of the last read: its value, or how it was denied
};

} // namespace dpslave::drive
