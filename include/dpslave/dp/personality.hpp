// SPDX-License-Identifier: Apache-2.0
/// The data of a device type that DP needs. A profile fills it; no code of DP depends on a product.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/units.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dpslave::dp {

/// Most octets of User_Prm_Data in one Set_Prm (wire reference 4.4).
inline constexpr std::size_t kMaxUserPrm = 237;
/// Octets of Demand Data in either direction, in front of the parameters (HA389815 ch. 7).
inline constexpr std::size_t kDemandOctets = 8;

/// A legal identifier of Cfg_Data and what it stands for: whole words, each of them one parameter. Words of
/// both directions are as many of each, and the same parameters. Source: wire reference 4.5.
struct Identifier {
    static constexpr std::size_t kLongest = 3; ///< octets: the special format without manufacturer's octets

    constexpr Identifier(std::uint8_t octet, std::uint8_t reads_words, std::uint8_t writes_words)
        : form{octet}, reads(reads_words), writes(writes_words)
    {}
    /// Precondition: 1 to kLongest octets.
    constexpr Identifier(Bytes octets_of_it, std::uint8_t reads_words, std::uint8_t writes_words)
        : length(static_cast<std::uint8_t>(octets_of_it.size())), reads(reads_words), writes(writes_words)
    {
        for (std::size_t i = 0; i < length; ++i) form[i] = octets_of_it[i];
    }

    std::array<std::uint8_t, kLongest> form{};
    std::uint8_t length = 1; ///< octets of `form` that count
    std::uint8_t reads = 0;  ///< input words
    std::uint8_t writes = 0; ///< output words

    constexpr Bytes octets() const { return Bytes{form}.first(length); }
    /// Returns with how many of its octets `cfg` begins; `length` means that it does so with all.
    constexpr std::size_t same_octets(Bytes cfg) const
    {
        std::size_t same = 0;
        while (same < length && same < cfg.size() && form[same] == cfg[same]) ++same;
        return same;
    }
    constexpr std::size_t words() const { return reads > writes ? reads : writes; } ///< parameters
    friend bool operator==(const Identifier&, const Identifier&) = default;
};

/// Says how the list of tags in User_Prm_Data ends.
enum class TagList : std::uint8_t {
    first_zero_ends, ///< fixed length, the first tag 0 ends the list, what follows is not counted (A-052)
    zeros_at_end,    ///< tags, then zeros only; a zero between tags is a fault (code 0014)
    exact,           ///< as many tags as octets say, none of them zero
    none,            ///< no tags: each identifier stands for the parameter of its place, counted from 1
};

/// Says where the tags are in User_Prm_Data (Set_Prm from octet 8 on).
struct PrmLayout {
    std::size_t tags_at = 0;    ///< offset of the first tag
    std::size_t min_length = 0; ///< octets of User_Prm_Data
    std::size_t max_length = 0;
    bool may_be_absent = false;   ///< no User_Prm_Data at all = no tags
    bool dpv1_status = false;     ///< the first three octets are DPV1_Status_1..3 (with WD_Base)
    std::uint16_t max_tag = 2047; ///< a higher tag is a Prm_Fault
    TagList list = TagList::first_zero_ends;
    friend bool operator==(const PrmLayout&, const PrmLayout&) = default;
};

/// Form of Demand Data in the first eight octets of both directions.
enum class DemandForm : std::uint8_t {
    none,
    basic,    ///< commands 0, 1, 2; tag in bits 10..0 (HA389815 ch. 7)
    extended, ///< also 3 and 4 with the tag in register 2 (2408f/2404f handbook ch. 7)
};

/// Says how the extended commands 3 and 4 are answered.
enum class ExtendedReply : std::uint8_t {
    table,   ///< as the table of the handbook: 1000 or 7000, the tag in register 2
    example, ///< as worked example 2: the request's own 3000 or 4000, and 7000 + tag for a refusal
};

struct Personality {
    std::uint16_t ident = 0;
    std::array<Tbit, kBauds.size()> max_tsdr{}; ///< per rate, in the order of kBauds; 0 = rate not supported

    std::vector<Identifier> identifiers; ///< of process parameters
    std::uint8_t demand_identifier = 0;  ///< legal in first position only; 0 = none
    std::size_t max_parameters =
        0; ///< words of process parameters, Demand Data not counted; <= kMaxParameters
    /// Inputs and outputs together, Demand Data counts 8; one more is a Cfg_Fault. 0 = no such limit. Source:
    /// 2408f/2404f handbook ch. 5; X-28.
    std::size_t max_words = 0;
    bool may_have_no_parameters = true; ///< Demand Data alone is a legal configuration

    /// The drive side has to find out whether the drive has the tags, those of outputs as well, and their
    /// scales, before the exchange begins: Stat_Diag also where no parameter is read, and nothing is written
    /// before it ends.
    bool tries_outputs = false;
    /// Stat_Diag after Chk_Cfg ends only when the drive has answered, however long that takes.
    bool waits_for_drive = false;

    PrmLayout prm;
    DemandForm demand = DemandForm::none;
    std::uint16_t demand_error_base = 0; ///< added to the error codes 0, 1, 2 (X-09)
    ExtendedReply extended_reply = ExtendedReply::table;

    bool sync = false;
    bool freeze = false;
    bool fail_safe = false;          ///< zero-length Data_Exchange in Clear is legal
    std::size_t max_diag_length = 6; ///< octets of Slave_Diag, 6..244
    /// The number of octets (1..62) after the header of the one device-related block that is always sent,
    /// from the start on and then as zeros (rows B-080, C-017). max_diag_length is at least diag_octets + 7.
    /// 0 = no block of its own.
    std::uint8_t diag_octets = 0;
    friend bool operator==(const Personality&, const Personality&) = default;
};

} // namespace dpslave::dp
