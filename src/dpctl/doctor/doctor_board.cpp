// SPDX-License-Identifier: Apache-2.0
// The option board: HA389815 ch. 9 (rows ).
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

bool is_board(const Facts& f)
{
    return f.family == Family::option_board;
}
std::string seen_external(const Facts& f)
{
    const bool waits = is_in(f, "Wait_Prm") || is_in(f, "Wait_Cfg");
    return is_board(f) && waits && refusal(f).empty() && !has_just_started(f) ? no_exchange(f)
                                                                              : std::string{};
}
std::string seen_configuration(const Facts& f)
{
    return is_board(f) && !exchanges(f) ? refusal(f) : std::string{};
}
std::string seen_internal(const Facts& f)
{
    return is_board(f) ? drive_silence(f) : std::string{};
}
std::string seen_dark(const Facts& f)
{
    return is_board(f) && is_in(f, "Power_On") ? "the station is in Power_On: it is not served" : "";
}

constexpr std::array kBoardRules = std::to_array<Rule>({
    {"board.dark", Rank::stands, "red off, green off", "No power or major fault",
     "Check the power of the gateway and of its transceiver.\n"
     "Run systemctl status dpslaved. Find out why the station is not served: journalctl -u dpslaved",
     kBoard, seen_dark},
    {"board.internal", Rank::checklist,
     "red on (620: flashing 2 Hz), green flashing 2 Hz: the drive does not answer",
     "Internal communications fault",
     "Check that PROTOCOL of the drive is what the gateway's port needs (for the board itself: OPTION).\n"
     "Check that the address is 0 to 125 (620: 1 to 125).\n"
     "620: check the connections between the PROFIBUS side and the drive. Check P3 MODE (or P1 MODE) and the baud rate.\n"
     "Check port, baud, format and unit of the line in the configuration against the drive's settings.",
     kBoard, seen_internal},
    {"board.configuration", Rank::checklist, "red on, green flashing 1 Hz: Set_Prm or Chk_Cfg was refused",
     "Configuration fault",
     "Check that the Usr_Prm_Data is declared correctly in the master. See what came: dpctl diag\n"
     "Check that the Cfg_Data is declared correctly in the master: its modules in the order of the tags.\n"
     "Read the diagnosis of the slave into the master. The station status octets show where the problem is.",
     kBoard, seen_configuration},
    {"board.external", Rank::checklist, "red on, green flashing 1 Hz: nothing was refused",
     "External communications fault",
     "Check the terminal connections: A and B of the transceiver (D-sub 8 and 3), both continuous to the master. On the old board B was terminal 3 and A was terminal 4.\n"
     "Check that the master communicates at 1.5 Mbaud or less.\n"
     "Check that the address of the station ([[station]] address, OPTION ADDRESS of the board) is the one in the master's project.\n"
     "Check that no other PROFIBUS-DP slave or master has the same address.",
     kBoard, seen_external},
});

} // namespace

std::span<const Rule> board_rules()
{
    return kBoardRules;
}

} // namespace dpslave::dpctl
