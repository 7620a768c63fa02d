// SPDX-License-Identifier: Apache-2.0
/// A device type read from config/profiles/NAME.toml and its tag table from config/tags/*.csv: checked
/// completely, then constant.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/drive/tag.hpp"
#include "dpslave/input/fault.hpp"
#include "dpslave/input/text_source.hpp"
#include "dpslave/led/pattern.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::profile {

/// The content of the extended diagnosis of a device type.
enum class DiagForm : std::uint8_t {
    none,
    trip_code,   ///< four octets: trip code of the drive, EXT DIAGNOSTIC (HA463561U002)
    tripped,     ///< the same, the trip code only 0 or 31 (590+)
    status_word, ///< three octets: a status word of the device (2408f/2404f handbook ch. 4)
};

/// A lamp of the drive as one bit of a tag: "272.3", "!272.3" (lit while the bit is 0), "12" (any bit);
/// "none".
struct MirroredLamp {
    std::uint16_t tag = 0; ///< 0 = none
    std::uint16_t mask = 0xFFFF;
    bool inverted = false;
    friend bool operator==(const MirroredLamp&, const MirroredLamp&) = default;
};
/// Returns nullopt if the text is no such lamp.
std::optional<MirroredLamp> parse_lamp(std::string_view text);

/// The place where a drive reports its trip: a tag whose low octet is the code, or a bit that is set while it
/// has tripped ("272.3", "!537.11"), which is reported as 31.
struct TripSource {
    MirroredLamp bit; ///< tag 0 = not known
    bool is_code = true;
    friend bool operator==(const TripSource&, const TripSource&) = default;
};

/// The facts of a GSD beyond the personality, key by key.
struct GsdFacts {
    std::string vendor;                    ///< Vendor_Name
    std::string model;                     ///< Model_Name
    std::string revision;                  ///< Revision
    std::string hardware;                  ///< Hardware_Release
    std::string software;                  ///< Software_Release
    std::string description;               ///< Info_Text; may be empty
    std::uint16_t min_slave_interval = 20; ///< Min_Slave_Intervall, 100 us
    std::uint8_t family = 0;               ///< Slave_Family: 0 general, 1 drives, 5 controllers
    std::uint8_t repeater = 2;             ///< Repeater_Ctrl_Sig: 2 = TTL
    std::string demand_module;             ///< names of the modules, by what they do
    std::string in_module;
    std::string out_module;
    std::string in_out_module;          ///< empty where no identifier does both
    std::string file;                   ///< name of the file that is shipped; empty: none, the ident is open
    std::vector<std::uint16_t> in_tags; ///< mapping that `dpctl gsd make` uses when none is given
    std::vector<std::uint16_t> out_tags;
    friend bool operator==(const GsdFacts&, const GsdFacts&) = default;
};

struct Profile {
    std::string name;                   ///< "590"
    std::string device;                 ///< in words: "Eurotherm Drives 590 with PROFIBUS-DP option board"
    std::string order_code;             ///< for `dpctl show` (A-002)
    std::string firmware;               ///< of the host that the board needs: "V4.2 onwards" (A-003)
    std::string manual;                 ///< "HA389815"
    std::optional<std::uint16_t> ident; ///< none: the station must say it
    dp::Personality personality;        ///< its ident is *ident, or 0 where open
    std::uint8_t min_address = 0, max_address = 125;
    drive::TagTable tags;
    std::string tag_file; ///< its path
    bool tags_only_from_table = false;
    drive::MnemonicRule mnemonics = drive::MnemonicRule::none;
    std::string mnemonic_source;    ///< where the rule comes from; empty: nothing is said
    bool mnemonics_assumed = false; ///< no source says that this device follows the rule (X-52)
    drive::DeniedHold denied_holds = drive::DeniedHold::where_one; ///< X-48; a technology box: never
    drive::ZeroAfter zero_after = std::chrono::nanoseconds{0}; ///< with a TEC OPTION block RIDE THROUGH rules
    bool has_tec = false;                                      ///< the device has a TEC OPTION function block
    MirroredLamp health, run; ///< of a TEC OPTION block; a station may say otherwise
    TripSource trip;          ///< likewise
    DiagForm diagnosis = DiagForm::none;
    std::uint16_t status_tag = 0;       ///< of DiagForm::status_word
    std::uint16_t fault_mask = 0;       ///< bits of the status word that are faults (Ext_Diag, X-15)
    bool selectable_resolution = false; ///< key `resolution` of a station
    /// The tags in which such a device says its resolution (0 full, 1 integer) and the decimals of its
    /// display; 0 = it does not.
    std::uint16_t resolution_tag = 0, display_decimals_tag = 0;
    std::vector<std::uint16_t> never_written; ///< tags that are never written
    bool has_function_4 = false;              ///< of Modbus: it reads what function 3 reads
    bool has_function_8 = false;              ///< of Modbus: the loopback, sub code 0
    std::string option_software; ///< release of the option that is emulated: "Version 3.x" (B-011)
    GsdFacts gsd;
    led::Language leds = led::Language::option_board;
    std::optional<std::uint32_t> recommended_baud; ///< of the drive line; another rate is a warning (A-037)
    std::vector<std::string> protocols;            ///< legal back-ends: "ei-ascii"
    friend bool operator==(const Profile&, const Profile&) = default;
};

/// Reads `folder`/NAME.toml and the table it names (../tags/FILE beside the folder). All faults of both files
/// in one list.
Result<Profile, input::Faults> load_profile(const input::TextSource& source, const std::string& folder,
                                            const std::string& name);

/// Reads a tag table.
Result<drive::TagTable, input::Faults> load_tags(const input::TextSource& source, const std::string& file);
/// Reads the table from its text, with or without a byte order mark; `file` is for the faults.
Result<drive::TagTable, input::Faults> read_tags(std::string_view content, const std::string& file);

} // namespace dpslave::profile
