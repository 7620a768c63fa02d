// SPDX-License-Identifier: Apache-2.0
/// Tells what a master sends for a GSD file: the ident, Set_Prm and Chk_Cfg, each octet with its line of the
/// file. It does not judge whether a station accepts it. Source: wire reference 4.4, 4.5, 9.1.
#pragma once

#include "dpslave/gsd/document.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::gsd {

/// Octets, and for each the line that it comes from; 0: no line says it.
struct LinedOctets {
    std::vector<std::uint8_t> octets = {};
    std::vector<unsigned> lines = {};

    void add(std::uint8_t octet, unsigned line);
};

struct Sent {
    std::uint16_t ident = 0;           ///< 0: the file has none
    bool sync = false, freeze = false; ///< a master may ask for them
    LinedOctets user = {};             ///< User_Prm_Data, at most 237 octets
    LinedOctets cfg = {};              ///< Chk_Cfg
    // Lines; 0: the file does not say it.
    unsigned ident_line = 0, sync_line = 0, freeze_line = 0;
    unsigned length_line = 0; ///< of what says how long User_Prm_Data is
};

/// Returns what is sent with `modules` plugged, in this order. User_Prm_Data of the old style is cut or
/// filled to its length. User_Prm_Data of the new style has the constants and the defaults. Then comes what
/// each module adds, in all up to Max_User_Prm_Data_Len (less may be sent: Felser, PROFIBUS manual, on this
/// keyword).
Sent sent_by_master(const Document& document, const std::vector<const Module*>& modules);

/// Returns the octets that this module adds to User_Prm_Data.
std::vector<std::uint8_t> own_parameters(const Document& document, const Module& module);
/// Returns whether any module adds something: then Set_Prm depends on the list of modules.
bool any_own_parameters(const Document& document);

/// The Set_Prm of it: locked, with Sync_Req and Freeze_Req where a master may ask for them, no watchdog,
/// group 0.
std::vector<std::uint8_t> set_prm_of(const Sent& sent);

/// Says how the modules get into Chk_Cfg.
enum class Plugging : std::uint8_t {
    fixed,  ///< a compact station, or FixPresetModules with preset ones
    choice, ///< the master's tool puts them together, within the limits
};
Plugging plugging_of(const Document& document);

/// The limits of a list of modules.
struct Limits {
    std::size_t modules = 0;               ///< Max_Module, without it one in a compact station; up to 244
    std::size_t in = 0, out = 0, data = 0; ///< octets; of a compact station no keyword limits them
};
Limits limits_of(const Document& document);
/// Returns a sentence about the limit that a list breaks, with its line (unless the file is not written yet)
/// and what the list has; empty if it breaks none.
std::string broken_limit(const Document& document, const std::vector<const Module*>& modules,
                         bool with_line = true);

/// Returns the modules that are plugged without an order of the user: the one of a compact station, else with
/// FixPresetModules the preset ones. If a compact station has several, no source says which one is plugged:
/// that is a choice as well.
std::vector<const Module*> plugged_modules(const Document& document);
/// Those that the master's tool begins with, fixed or not.
std::vector<const Module*> preset_modules(const Document& document);

/// Finds modules by their names, in the order of the names; any case. Returns nullopt and a sentence in `why`
/// if no module has the name, or a limit is broken. "#3" is the third module of the file, however it is
/// called.
std::optional<std::vector<const Module*>>
modules_named(const Document& document, const std::vector<std::string>& names, std::string& why);
/// Returns the modules that `cfg` is made of, as few as can be, whatever the limits; nullopt if there is no
/// such list.
std::optional<std::vector<const Module*>> modules_in(const Document& document,
                                                     const std::vector<std::uint8_t>& cfg);

} // namespace dpslave::gsd
