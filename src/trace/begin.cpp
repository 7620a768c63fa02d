// SPDX-License-Identifier: Apache-2.0
#include "begin.hpp"

#include "dpslave/fdl/telegram.hpp"

#include <algorithm>

namespace dpslave::trace {
namespace {

using fdl::Flaw;
using fdl::Telegram;

/// It is the longest telegram without its first octet. With one more octet after it everything is known.
constexpr std::size_t kLongestEnd = fdl::kMaxTelegram - 1;
constexpr std::size_t kEnough = kLongestEnd + fdl::kMaxTelegram;

/// Telegrams back to back.
enum class Row : std::uint8_t {
    broken, ///< something in it is no telegram
    open,   ///< the last one is not complete yet
    whole,  ///< nothing is left over, and none of them has a checksum
    proven, ///< up to one with a right checksum
};

/// The end of a telegram with SD1 to SD3 looks like a token from station 22, 0x16, if the octet before its
/// checksum is 0xDC. A token is one if its receiver goes on, or its sender repeats it.
bool is_passed_on(const Telegram& token, const Telegram& next)
{
    const bool is_repeated = next.delimiter == fdl::kSD4 && next.da == token.da && next.sa == token.sa;
    return is_repeated || (next.delimiter != fdl::kSC && next.sa == token.da);
}

/// Returns whether it has a right checksum, though its contents may not be understood.
bool is_checked(const Result<Telegram, Flaw>& telegram, std::uint8_t delimiter)
{
    if (delimiter == fdl::kSC || delimiter == fdl::kSD4) return false;
    return telegram || (telegram.error() != Flaw::checksum && telegram.error() != Flaw::end_delimiter);
}

/// `may_be_damaged`: also the first of them, if it has its delimiters in their places.
Row row_from(Bytes octets, bool may_be_damaged)
{
    std::optional<Telegram> doubtful; // a token that may be none
    for (std::size_t at = 0; at < octets.size(); may_be_damaged = true) {
        const Bytes rest = octets.subspan(at);
        const auto length = fdl::frame_length(rest);
        if (!length) return Row::broken;
        if (*length == 0 || rest.size() < *length) return Row::open;
        const auto telegram = fdl::decode(rest.first(*length));
        if (telegram && telegram->delimiter == fdl::kSD4 &&
            std::max(telegram->da, telegram->sa) >= fdl::kBroadcast)
            return Row::broken;
        if (doubtful && (!telegram || !is_passed_on(*doubtful, *telegram))) return Row::broken;
        if (is_checked(telegram, rest[0])) return Row::proven;
        if (!telegram && (!may_be_damaged || telegram.error() != Flaw::checksum)) return Row::broken;
        doubtful.reset();
        if (telegram && telegram->delimiter == fdl::kSD4 && telegram->sa == fdl::kED) doubtful = *telegram;
        at += *length;
    }
    return doubtful ? Row::open : Row::whole;
}

/// A head whose four octets agree is none by chance.
bool is_head(Bytes octets)
{
    return octets.size() >= 4 && octets[0] == fdl::kSD2 && octets[3] == fdl::kSD2 && octets[1] == octets[2];
}

/// Returns whether the first `count` octets may be the end of a telegram.
bool may_be_end(Bytes octets, std::size_t count)
{
    if (count == 0 || octets[count - 1] == fdl::kED) return true;
    const auto is_address = [](std::uint8_t octet) { return octet < fdl::kBroadcast; };
    return count <= 2 &&
           std::all_of(octets.begin(), octets.begin() + static_cast<std::ptrdiff_t>(count), is_address);
}

/// The receiver of a token, which has gone on, is the first of its two addresses.
bool fits_behind(Bytes octets, std::size_t count)
{
    if (count != 2 || octets[1] == fdl::kED) return true;
    const auto next = fdl::decode(octets.subspan(2).first(*fdl::frame_length(octets.subspan(2))));
    return !next ||
           (next->delimiter != fdl::kSC && next->sa == octets[0]); // a damaged one has a head of four
}

Row row_behind(Bytes octets, std::size_t count)
{
    const Bytes rest = octets.subspan(count);
    const bool is_behind_end = count != 0 && octets[count - 1] == fdl::kED;
    const Row row = row_from(rest, is_behind_end || is_head(rest));
    const bool is_there = row == Row::proven || (row == Row::whole && !rest.empty());
    return is_there && !fits_behind(octets, count) ? Row::broken : row;
}

/// Noise is between the end of the telegram and the first one that is known.
std::size_t end_before_noise(Bytes octets, std::size_t first_telegram)
{
    std::size_t end = std::min(first_telegram, kLongestEnd);
    while (end > 0 && octets[end - 1] != fdl::kED) --end;
    return end;
}

/// Decides if nothing is proven, and nothing more comes.
std::size_t without_proof(Bytes octets, Behind behind)
{
    const std::size_t most = std::min(octets.size(), kLongestEnd);
    for (std::size_t count = 0; count <= most; ++count) {
        const bool is_all = count == octets.size();
        if (is_all && behind == Behind::gap) return count;
        if (!may_be_end(octets, count) || (is_all && octets[count - 1] != fdl::kED)) continue;
        const Row row = row_behind(octets, count);
        if (row == Row::whole || (row == Row::open && behind == Behind::gap)) return count;
    }
    return 0;
}

} // namespace

std::optional<std::size_t> cut_off(Bytes octets, Behind behind)
{
    if (octets.empty()) return behind == Behind::more ? std::nullopt : std::optional<std::size_t>{0};
    const bool is_waited_for = behind == Behind::more && octets.size() < kEnough;
    const std::size_t most = std::min(octets.size() - 1, kLongestEnd);
    for (std::size_t count = 0; count <= most; ++count) {
        if (!may_be_end(octets, count)) continue;
        const Row row = row_behind(octets, count);
        if (row == Row::proven) return count;
        if (row != Row::broken && is_waited_for) return std::nullopt;
    }
    for (std::size_t at = 1; at < octets.size(); ++at)
        if (row_from(octets.subspan(at), false) == Row::proven) return end_before_noise(octets, at);
    if (is_waited_for) return std::nullopt;
    return without_proof(octets, behind);
}

} // namespace dpslave::trace
