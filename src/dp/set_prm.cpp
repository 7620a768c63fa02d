// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/set_prm.hpp"

#include <algorithm>
#include <optional>

namespace dpslave::dp {
namespace {

// Octet 1, Station_status.
constexpr std::uint8_t kLockReq = 0x80;
constexpr std::uint8_t kUnlockReq = 0x40;
constexpr std::uint8_t kSyncReq = 0x20;
constexpr std::uint8_t kFreezeReq = 0x10;
constexpr std::uint8_t kWdOn = 0x08;

// Octet 8, DPV1_Status_1.
constexpr std::uint8_t kFailSafe = 0x40;
constexpr std::uint8_t kWdBase1ms = 0x04;
// A device without DP-V1 cannot do these: DPV1_Enable, Fail_Safe, Publisher_Enable and the reserved bits. The
// two lowest bits concern the ASIC's start and stop bit check; they are no business of ours and do no harm.
constexpr std::uint8_t kDpv1Only = 0xF8;

/// nullopt means that there is no objection.
using Objection = std::optional<Failure<RefusalDetail>>;

Objection check_length(const PrmLayout& prm, std::size_t length)
{
    if (length == 0 && prm.may_be_absent) return std::nullopt;
    if (length < prm.min_length) return refuse(Refusal::prm_length, 0, prm.min_length, length);
    if (length > prm.max_length) return refuse(Refusal::prm_length, 0, prm.max_length, length);
    if (length < prm.tags_at) return refuse(Refusal::prm_length, 0, prm.tags_at, length);
    const bool odd = (length - prm.tags_at) % 2 != 0;
    if (odd && prm.list != TagList::none) return refuse(Refusal::prm_length, 0, length - 1, length);
    return std::nullopt;
}

Objection check_dpv1_status(const Personality& personality, Bytes user)
{
    if (!personality.prm.dpv1_status || user.size() < kDpv1Status) return std::nullopt;
    const unsigned impossible = personality.fail_safe ? kDpv1Only & ~unsigned{kFailSafe} : kDpv1Only;
    const std::array<unsigned, kDpv1Status> forbidden{impossible, 0xFF, 0xFF};
    for (std::size_t i = 0; i < kDpv1Status; ++i)
        if ((user[i] & forbidden[i]) != 0)
            return refuse(Refusal::prm_dpv1, kPrmHeader + i + 1, user[i] & ~forbidden[i], user[i]);
    return std::nullopt;
}

Objection read_tags(const PrmLayout& prm, Bytes user, SetPrm& taken)
{
    if (prm.list == TagList::none) return std::nullopt;
    std::size_t zero_at = 0; // octet of Set_Prm; 0 = no zero yet
    for (std::size_t at = prm.tags_at; at + 2 <= user.size(); at += 2) {
        const std::size_t octet = kPrmHeader + at + 1;
        const std::uint16_t tag = be16(user, at);
        if (tag == 0) {
            if (prm.list == TagList::first_zero_ends) return std::nullopt;
            if (prm.list == TagList::exact) return refuse(Refusal::prm_zero_tag, octet, 1, 0);
            if (zero_at == 0) zero_at = octet;
            continue;
        }
        if (zero_at != 0) return refuse(Refusal::prm_zero_tag, zero_at, 1, 0);
        if (tag > prm.max_tag) return refuse(Refusal::prm_tag_too_large, octet, prm.max_tag, tag);
        if (taken.tag_count == kMaxParameters)
            return refuse(Refusal::prm_length, 0, prm.tags_at + 2 * kMaxParameters, user.size());
        taken.tag_list[taken.tag_count++] = tag;
    }
    return std::nullopt;
}

} // namespace

Lock lock_of(Bytes telegram)
{
    if ((telegram[0] & kUnlockReq) != 0) return Lock::unlock;
    return (telegram[0] & kLockReq) != 0 ? Lock::lock : Lock::neither;
}

Tbit min_tsdr_of(Bytes telegram, Tbit old)
{
    const Tbit wanted{telegram[3]};
    return wanted == Tbit{0} ? old : std::max(wanted, kSmallestMinTsdr);
}

std::chrono::milliseconds watchdog_of(Bytes telegram, bool dpv1_status)
{
    const bool fine_base = dpv1_status && telegram.size() >= kPrmHeader + kDpv1Status &&
                           (telegram[kPrmHeader] & kWdBase1ms) != 0;
    return std::chrono::milliseconds{fine_base ? 1 : 10} * (telegram[1] * telegram[2]);
}

Result<SetPrm, RefusalDetail> check_set_prm(const Personality& personality, Bytes telegram)
{
    const std::uint8_t status = telegram[0];
    const std::uint16_t ident = be16(telegram, 4);
    if (ident != personality.ident) return refuse(Refusal::prm_ident, 5, personality.ident, ident);

    SetPrm taken;
    taken.sync_requested = (status & kSyncReq) != 0;
    taken.freeze_requested = (status & kFreezeReq) != 0;
    unsigned possible = 0xFF;
    if (!personality.sync) possible &= ~unsigned{kSyncReq};
    if (!personality.freeze) possible &= ~unsigned{kFreezeReq};
    if ((status & ~possible) != 0) return refuse(Refusal::prm_not_supported, 1, status & possible, status);

    taken.watchdog_on = (status & kWdOn) != 0;
    for (const std::size_t factor : {std::size_t{1}, std::size_t{2}})
        if (taken.watchdog_on && telegram[factor] == 0)
            return refuse(Refusal::prm_watchdog, factor + 1, 1, 0);

    const Bytes user = telegram.subspan(kPrmHeader);
    if (const auto wrong = check_length(personality.prm, user.size())) return *wrong;
    if (const auto wrong = check_dpv1_status(personality, user)) return *wrong;
    if (const auto wrong = read_tags(personality.prm, user, taken)) return *wrong;
    if (!taken.user.assign(user)) return refuse(Refusal::prm_length, 0, kMaxUserPrm, user.size());

    taken.watchdog = watchdog_of(telegram, personality.prm.dpv1_status);
    taken.groups = telegram[6];
    return taken;
}

} // namespace dpslave::dp
