// SPDX-License-Identifier: Apache-2.0
/// PROFIBUS telegrams and diagnoses in words. Pure. Source: wire reference 2, 4 and 5.
#pragma once

#include "diagnosis_texts.hpp"
#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/fdl/telegram.hpp"
#include "dpslave/profile/profile.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// One telegram, or one diagnosis, in words.
struct Decoded {
    struct Line {
        std::string name, value;
    };
    struct Octet {
        std::size_t octet = 0; ///< of the user data, counted from 1
        std::uint8_t value = 0;
        std::string meaning;
    };
    std::string kind; ///< "SD2: Set_Prm, master 2 to station 5", "Slave_Diag"
    std::string hex;
    std::vector<Line> lines;
    std::vector<Octet> octets;
    std::vector<std::string> faults; ///< what is wrong with it, a sentence each
};

/// What is known beside the octets: the device, and what telegrams of this slave say that were decoded
/// before.
struct DecodeContext {
    const profile::Profile* device = nullptr;
    std::optional<std::vector<std::uint16_t>> tags = {}; ///< of the Set_Prm
    std::optional<dp::Configuration> configuration = {}; ///< of the Chk_Cfg; of none that `device` refuses
    std::optional<std::array<std::uint16_t, 4>> demand = {}; ///< registers of the last request of Demand Data
    const DiagnosisTexts* texts = nullptr;                   ///< of the GSD of another device
};

/// "68 05 05", "680505", "0x68,0x05": octets, or a sentence that says what is none.
Result<std::vector<std::uint8_t>, std::string> read_octets(const std::vector<std::string>& words);

/// Telegrams back to back, else one diagnosis of six octets or more, else blocks of an extended diagnosis.
std::vector<Decoded> decode_all(Bytes octets, DecodeContext context);

/// Octets without a telegram around them, as `dpctl diag` prints them.
enum class Form : std::uint8_t { set_prm, chk_cfg, slave_diag };
/// "prm", "cfg", "diag".
std::optional<Form> form_called(std::string_view name);
Decoded decode_as(Form form, Bytes octets, DecodeContext context);

Json decoded_json(const Decoded& part);
Json decoded_json(const std::vector<Decoded>& parts);
std::string render_decoded(const std::vector<Decoded>& parts, Look look);
/// What stands beneath a telegram: lines, octets and faults, indented. Empty: there is nothing to say.
std::string render_details(const Decoded& part, std::size_t indent, Look look);

// Parts of the work, each in its own file.
/// One frame; `frame` has the length that its head promises, or less.
Decoded decode_telegram(Bytes frame, DecodeContext& context);
/// What its data mean; and what is wrong with FC and addresses. Precondition: telegram.has_fc().
void decode_service(const fdl::Telegram& telegram, DecodeContext& context, Decoded& into);
void decode_set_prm(Bytes data, DecodeContext& context, Decoded& into);
void decode_cfg(Bytes data, DecodeContext& context, bool check, Decoded& into);
/// False: not without a device and its configuration, or not of this length; then nothing is added but the
/// fault.
bool decode_exchange(Bytes data, bool is_request, DecodeContext& context, Decoded& into);
void decode_diagnosis(Bytes data, const DecodeContext& context, Decoded& into);
/// Blocks back to back; `at`: octets before them.
void decode_extended(Bytes blocks, std::size_t at, const DecodeContext& context, Decoded& into);
/// True: whole blocks from the first octet to the last.
bool are_blocks(Bytes octets);

/// "Set_Prm", "Slave_Diag, reply", "Data_Exchange", "request, FDL status". Precondition: telegram.has_fc().
std::string service_name(const fdl::Telegram& telegram);
/// All names that it has, but those of unknown SAPs.
std::vector<std::string> service_names();

/// "271 SPEED TRIM".
std::string tag_words(std::uint16_t tag, const profile::Profile& device);

/// "1, 8" of Group_Ident or Group_Select; empty for 0.
std::string group_list(std::uint8_t octet);

} // namespace dpslave::dpctl
