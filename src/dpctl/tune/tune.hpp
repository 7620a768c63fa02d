// SPDX-License-Identifier: Apache-2.0
/// From the facts of a machine to what it can promise at each rate, and what would make it better. Pure but
/// for do_tune(). Source: wire reference 1.4, 1.5 and 11.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"
#include "machine.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/io/port_users.hpp"
#include "dpslave/report/replies.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// Bit times that the GSD of a common slave promises, by rate (class default; wire reference 1.3).
inline constexpr std::array<std::uint32_t, kBauds.size()> kDefaultMaxTsdr{60, 60, 60, 60, 60, 100, 150};
/// What masters wait at most: some refuse above 1023 (wire reference 1.4).
inline constexpr std::uint32_t kCeiling = 1000;

/// What the daemon counted since it serves the bus; all at the rate of BusFacts::baud unless that was
/// searched anew.
struct Traffic {
    std::uint64_t replies = 0;
    std::uint64_t too_late = 0;  ///< suppressed, because their window had closed, or ended behind it
    std::uint64_t overtaken = 0; ///< requests dropped, because the next one was there already
    std::uint64_t repeated = 0;  ///< requests that the master sent again, because it had not heard the reply
    /// From the read of a request's last octet to the end of the write of its reply; nothing = not reported.
    /// Interrupt, FIFO and the way to the reader come before it.
    std::optional<std::uint64_t> p999_us, highest_us;
    std::uint64_t measured = 0; ///< replies that these figures are of
    std::uint64_t page_faults = 0;
};

/// A running daemon whose bus port is the one that is judged.
struct BusFacts {
    int pid = 0;
    std::optional<Baud> baud; ///< nothing = it is being searched
    /// T_bit that all stations keep, by rate; nothing where one of them cannot do the rate at all.
    std::array<std::optional<std::uint32_t>, kBauds.size()> promised{};
    Traffic traffic;
    std::optional<io::ThreadFacts> thread; ///< of the bus
    std::optional<std::uint64_t> locked_kib;
};

struct TuneFacts {
    io::MachineFacts machine;
    io::PortFacts port;
    io::PortUsers users; ///< of the port, without the daemon
    std::optional<BusFacts> bus;
};

/// What lies between the UART and the reply: interrupt, driver, kernel worker, wake-up, processing, write.
struct SoftwarePart {
    std::uint32_t low_us = 0;  ///< as good as it gets
    std::uint32_t high_us = 0; ///< to plan with
};
SoftwarePart software_part(const TuneFacts& facts);

/// MaxTsdr that follows from an idle timeout and a software part: T_bit, rounded up, never below min T_SDR
/// (wire reference 11.6, "Minimum MaxTsdr").
std::uint32_t needed_tsdr(std::uint32_t idle_timeout_tbit, std::uint32_t software_us, Baud baud);

enum class Verdict : std::uint8_t { holds, doubtful, cannot };
std::string_view text(Verdict verdict);

struct RateJudgment {
    Baud baud = Baud::k9_6;
    Verdict verdict = Verdict::holds;
    std::uint32_t needed = 0;            ///< T_bit to promise; 0 = the UART cannot do the rate at all
    std::uint32_t promised = 0;          ///< T_bit that are promised now, or by default
    std::optional<double> error_percent; ///< of the rate; nothing = not known
    std::string reason;                  ///< a sentence without full stop
};
/// One of each rate, lowest first.
std::vector<RateJudgment> judge_rates(const TuneFacts& facts);

enum class Severity : std::uint8_t {
    mend,   ///< the bus cannot be served like this
    better, ///< costs time that can be had back
    know,   ///< nothing to do
};
std::string_view text(Severity severity);

struct TuneFinding {
    Severity severity = Severity::know;
    std::string name;
    std::string what;
    std::string cost;               ///< in bit times where they are known; empty = nothing
    std::vector<std::string> steps; ///< what to do next, with the command to type
};
/// Another program has the port, or the kernel; or whether one has it cannot be seen. Nothing: nobody has.
std::optional<TuneFinding> shared_port(const io::PortUsers& users);
/// Those to mend first.
std::vector<TuneFinding> tune_findings(const TuneFacts& facts, const std::vector<RateJudgment>& rates);

/// Whether the bus thread may meet with something that a tuned machine does not have.
bool is_tuned(const TuneFacts& facts);

/// The replies of GetInfo and GetCounters, and `bus` of GetStatus.
BusFacts bus_facts(const report::Bus& bus, const report::GetInfoReply& info,
                   const report::GetCountersReply& counters);

Json tune_json(const TuneFacts& facts, const std::vector<RateJudgment>& rates,
               const std::vector<TuneFinding>& findings);
std::string render_tune(const TuneFacts& facts, const std::vector<RateJudgment>& rates,
                        const std::vector<TuneFinding>& findings, Look look);

} // namespace dpslave::dpctl
