// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/ring.hpp"

#include "instant_word.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace dpslave::trace {
namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);

constexpr std::uint64_t words_of(std::size_t octets)
{
    return (octets + kWord - 1) / kWord;
}

/// The first word of a record. The octets are counted in 16 bits, so no length makes a reader leave the ring.
std::uint64_t head_word(const Head& head, std::size_t octets)
{
    return octets | std::uint64_t{static_cast<std::uint8_t>(head.kind)} << 16 |
           std::uint64_t{head.detail} << 24 | std::uint64_t{head.rate} << 32 |
           std::uint64_t{head.address} << 40 | std::uint64_t{head.more_follows ? 1U : 0U} << 48;
}

std::size_t octets_of(std::uint64_t head)
{
    return head & 0xFFFF;
}

} // namespace

Ring::Ring(std::size_t octets)
{
    if (octets == 0) return;
    capacity_ = std::bit_ceil(std::max(octets, kLeast)) / kWord;
    // Not a page is touched yet: the start of the daemon does not wait for megabytes of them.
    words_ = std::make_unique_for_overwrite<std::uint64_t[]>(capacity_);
}

/// The store releases, so that who reads this word finds begin_ moved. On x86 this is a plain store.
void Ring::write(std::uint64_t at, std::uint64_t value) noexcept
{
    word(at).store(value, std::memory_order_release);
}

void Ring::put(const Head& head, Bytes octets) noexcept
{
    if (!is_on()) return;
    octets = octets.first(std::min(octets.size(), Record::kMostOctets));
    const std::uint64_t length = kHeadWords + words_of(octets.size());
    const std::uint64_t number = done_.load(std::memory_order_relaxed);
    begun_.store(number + 1, std::memory_order_relaxed);
    const std::uint64_t at = end_.load(std::memory_order_relaxed);
    std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (at + length - begin > capacity_) {
        while (at + length - begin > capacity_)
            begin += kHeadWords + words_of(octets_of(word(begin).load(std::memory_order_relaxed)));
        begin_.store(begin, std::memory_order_relaxed);
    }
    write(at, head_word(head, octets.size()));
    write(at + 1, number);
    write(at + 2, word_of(head.at));
    write(at + 3, word_of(head.begun));
    for (std::uint64_t to = at + kHeadWords; !octets.empty(); ++to) {
        std::uint64_t value = 0;
        const std::size_t some = std::min(octets.size(), kWord);
        std::memcpy(&value, octets.data(), some);
        write(to, value);
        octets = octets.subspan(some);
    }
    end_.store(at + length, std::memory_order_release);
    done_.store(number + 1, std::memory_order_release);
}

Ring::Reader::Reader(const Ring& ring, From from) : ring_(&ring)
{
    if (!ring.is_on()) return;
    if (from == From::oldest) {
        at_ = ring.begin_.load(std::memory_order_acquire);
        return;
    }
    // Both counts are the same while no record is being written: then the end belongs to them.
    std::uint64_t count = 0;
    do {
        count = ring.done_.load(std::memory_order_acquire);
        at_ = ring.end_.load(std::memory_order_acquire);
    } while (count != ring.begun_.load(std::memory_order_acquire));
    expected_ = count;
}

/// Copies the record at at_. It returns false if the writer has come to it meanwhile, and the copy is
/// invalid.
bool Ring::Reader::copy(Record& into) const
{
    const auto read = [this](std::uint64_t at) { return ring_->word(at).load(std::memory_order_acquire); };
    const std::uint64_t head = read(at_);
    into.head.kind = static_cast<Kind>(head >> 16 & 0xFF);
    into.head.detail = static_cast<std::uint8_t>(head >> 24);
    into.head.rate = static_cast<std::uint8_t>(head >> 32);
    into.head.address = static_cast<std::uint8_t>(head >> 40);
    into.head.more_follows = (head >> 48 & 1) != 0;
    into.number = read(at_ + 1);
    into.head.at = instant_of(read(at_ + 2));
    into.head.begun = instant_of(read(at_ + 3));
    into.octets.clear();
    std::array<std::uint8_t, kWord> some{};
    for (std::size_t left = std::min(octets_of(head), Record::kMostOctets), at = kHeadWords; left != 0;
         ++at) {
        const std::uint64_t value = read(at_ + at);
        std::memcpy(some.data(), &value, kWord);
        const std::size_t taken = std::min(left, kWord);
        into.octets.append(Bytes{some}.first(taken));
        left -= taken;
    }
    return ring_->begin_.load(std::memory_order_acquire) <= at_;
}

bool Ring::Reader::next(Record& into)
{
    if (!ring_->is_on()) return false;
    for (;;) {
        at_ = std::max(at_, ring_->begin_.load(std::memory_order_acquire));
        if (at_ == ring_->end_.load(std::memory_order_acquire)) return false;
        if (!copy(into)) continue;
        at_ += kHeadWords + words_of(into.octets.size());
        lost_ += into.number - expected_.value_or(into.number);
        expected_ = into.number + 1;
        return true;
    }
}

} // namespace dpslave::trace
