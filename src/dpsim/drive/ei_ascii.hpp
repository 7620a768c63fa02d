// SPDX-License-Identifier: Apache-2.0
/// EI-ASCII of a drive (ANSI X3.28, subcategory 2.5; EI-ASCII reference, sections 1 to 4): checksums,
/// mnemonics and forms of text, written a second time. Shares nothing with the daemon.
#pragma once

#include "dpsim/common/tag_file.hpp"
#include "dpsim/common/telegram.hpp"

#include <string_view>

namespace dpslave::sim {

inline constexpr std::uint8_t kStx = 0x02, kEtx = 0x03, kEot = 0x04, kEnq = 0x05, kAck = 0x06, kNak = 0x15;

/// EE, last error (EI-ASCII reference, section 4).
enum class Ee : std::uint16_t {
    none = 0x00C0,
    invalid_mnemonic = 0x01C7,
    checksum = 0x02C2,
    write_only = 0x04C8,
    read_only = 0x05C8,
    message_format = 0x07C7,
    invalid_data = 0x07C8,
    out_of_range = 0x08C8,
};

/// The drive that the option board or the technology box belongs to.
enum class Model : std::uint8_t {
    dc590,  ///< "590", "590plus": ENUM in hexadecimal
    ac584s, ///< "584s": ENUM decimal with a point, both forms taken
    dc620,  ///< "620": ENUM in hexadecimal, both forms taken (no table names one)
    ac,     ///< "584sv", "605", "690plus": mnemonics of the AC drives, ENUM decimal with a point, both forms
            ///< taken
};
std::optional<Model> model_of(std::string_view name);

/// Exclusive OR of what follows STX, ETX included.
std::uint8_t block_check(Bytes after_stx);

/// STX, mnemonic, data, ETX, BCC.
Octets reply_frame(std::string_view mnemonic, std::string_view data);

/// Rules by which a tag becomes two characters (EI-ASCII reference, section 3).
enum class Rule : std::uint8_t {
    dc_590plus, ///< "590plus"; its PNO 0..127 are tags 1000..1127
    ac,         ///< "ac"
    pno,        ///< "pno": the PNO in hexadecimal, as 590 and 590SP name parameters; tag 0..127 is its PNO
};
std::optional<Rule> rule_of(std::string_view name);
Rule rule_of(Model model); ///< as the profiles have it

/// The two characters of a tag; empty = none.
std::string mnemonic_of(Rule rule, std::uint16_t tag);

/// Knows how a drive names its tags.
class Naming {
public:
    /// Names by the column `mnemonic` of its table, else by the rule of its model.
    explicit Naming(Model model) : rule_(rule_of(model)), table_first_(true) {}
    /// Names by this rule, whatever its table says.
    explicit Naming(Rule rule) : rule_(rule) {}
    /// Only as these rows say, whatever its table says: tag and mnemonic.
    explicit Naming(std::vector<SimTag> rows) : rows_(std::move(rows)) {}

    std::string name(const SimTag& tag) const; ///< empty: it has none

private:
    std::optional<Rule> rule_;
    std::vector<SimTag> rows_;
    bool table_first_ = false;
};

/// A value as the drive sends it: "30.", "-0.5", ">1B0B", ">01".
std::string drive_text(Model model, const SimTag& tag, const SimValue& value);

/// A value as the master writes it; the error that EE shows if the drive does not take it. Limits included.
Result<SimValue, Ee> drive_value(Model model, const SimTag& tag, std::string_view data);

} // namespace dpslave::sim
