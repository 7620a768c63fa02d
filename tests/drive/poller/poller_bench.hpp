// SPDX-License-Identifier: Apache-2.0
/// A poller with drives of words in memory and a clock that only transactions and waiting move.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dpslave::drive::test {

using namespace std::chrono_literals;

inline constexpr std::chrono::nanoseconds kAnswerTime = 20ms;   ///< of one transaction with an answer
inline constexpr std::chrono::nanoseconds kSilenceTime = 220ms; ///< of one without

struct MemoryDrive {
    std::map<int, std::uint16_t> words;      ///< the tags that it has
    std::map<int, AccessError> read_errors;  ///< tags that refuse reads
    std::map<int, AccessError> write_errors; ///< tags that refuse writes
    std::set<int> silent_tags;
    std::set<int> unanswered_writes; ///< tags whose writes are done and never answered
    std::set<int> not_kept;          ///< tags whose writes are accepted and change nothing
    bool alive = true;
    int lost_answers = 0;       ///< so many transactions are done and not answered
    int not_understood = 0;     ///< so many transactions are answered with a NAK and not done
    int longest_read = 125;     ///< tags; a longer block is refused
    bool is_behind = false;     ///< each answer may be to an earlier question
    bool answers_blocks = true; ///< false: silent to a write of more than one word
    AccessError refuses_blocks = AccessError::none; ///< a write of more than one word, whatever it says
};

struct Done {
    Purpose purpose;
    Transaction::Kind kind;
    std::size_t unit;
    int tag;
    std::uint16_t count;
    std::vector<std::uint16_t> words; ///< of a write
    AccessError error;
    Instant at; ///< begin
};

class PollerBench {
public:
    explicit PollerBench(const std::vector<DriveSettings>& units, BlockRule rule = {})
        : drives(units.size()), images(units.size()), poller(units, rule)
    {}

    std::vector<MemoryDrive> drives;
    std::vector<OutputImage> images;
    Poller poller;
    Instant now{};
    std::vector<Done> log;
    bool unplugged = false;                            ///< nothing gets on the line
    std::function<void(const Transaction&)> meanwhile; ///< called while a transaction is under way

    /// A new layout: tags that are read, then tags that are written.
    void layout(std::size_t unit, Generation generation, const std::vector<int>& reads,
                const std::vector<int>& writes = {})
    {
        OutputImage& image = images[unit];
        image = {};
        image.layout.generation = generation;
        for (const int tag : reads) add(image, tag, true, false);
        for (const int tag : writes) add(image, tag, false, true);
        send_outputs(unit);
    }
    void send_outputs(std::size_t unit) { poller.set_outputs(unit, images[unit]); }
    void master_writes(std::size_t unit, int tag, int word)
    {
        OutputImage& image = images[unit];
        image.may_write = true;
        for (std::size_t i = 0; i < image.layout.count; ++i)
            if (image.layout.parameters[i].tag == tag) image.words[i] = static_cast<std::uint16_t>(word);
        send_outputs(unit);
    }
    void master_leaves(std::size_t unit)
    {
        images[unit].may_write = false;
        send_outputs(unit);
        poller.left_data_exchange(unit, {images[unit].layout.generation});
    }

    /// One transaction; false when there is nothing to do now.
    bool step()
    {
        const auto transaction = poller.next(now);
        if (!transaction) return false;
        const Instant began = now;
        if (meanwhile) meanwhile(*transaction);
        std::array<std::uint16_t, 64> words{};
        const AccessError error = unplugged ? AccessError::no_answer : carry_out(*transaction, words);
        now += error == AccessError::no_answer ? kSilenceTime : kAnswerTime;
        log.push_back({transaction->purpose,
                       transaction->kind,
                       transaction->unit,
                       transaction->tag != nullptr ? transaction->tag->number : -1,
                       transaction->count,
                       {transaction->words.begin(), transaction->words.end()},
                       error,
                       began});
        if (error != AccessError::no_answer) poller.heard(transaction->unit, now);
        poller.done({.error = error,
                     .words = std::span{words}.first(transaction->count),
                     .sent = !unplugged,
                     .may_be_older = drives[transaction->unit].is_behind},
                    now);
        return true;
    }
    void steps(int count)
    {
        for (int i = 0; i < count; ++i) step();
    }
    /// Until `duration` has passed.
    void run(std::chrono::nanoseconds duration)
    {
        const Instant end = now + duration;
        while (now < end) {
            if (step()) continue;
            now = std::min(end, std::max(now + 1us, poller.next_deadline()));
        }
    }

    std::size_t count(const std::function<bool(const Done&)>& which) const
    {
        std::size_t n = 0;
        for (const Done& done : log) n += which(done) ? 1u : 0u;
        return n;
    }
    std::size_t writes_of(int tag) const
    {
        return count([tag](const Done& d) {
            return d.kind == Transaction::Kind::write && d.tag <= tag && tag < d.tag + d.count;
        });
    }
    std::size_t reads_of(int tag) const
    {
        return count([tag](const Done& d) {
            return d.kind == Transaction::Kind::read && d.tag <= tag && tag < d.tag + d.count;
        });
    }
    /// The purposes of the log as letters: i o s d c (dpctl) w p.
    std::string purposes() const
    {
        std::string out;
        for (const Done& done : log) out += "iosdcwp"[static_cast<std::size_t>(done.purpose)];
        return out;
    }

private:
    static void add(OutputImage& image, int tag, bool reads, bool writes)
    {
        image.layout.parameters[image.layout.count++] = {static_cast<std::uint16_t>(tag), reads, writes};
    }

    AccessError carry_out(const Transaction& transaction, std::array<std::uint16_t, 64>& words)
    {
        MemoryDrive& drive = drives[transaction.unit];
        if (!drive.alive) return AccessError::no_answer;
        if (transaction.kind == Transaction::Kind::probe) return AccessError::none;
        const int tag = transaction.tag->number;
        if (drive.silent_tags.count(tag) != 0) return AccessError::no_answer;
        if (drive.not_understood > 0) {
            --drive.not_understood;
            return AccessError::not_understood;
        }
        const AccessError error = transaction.kind == Transaction::Kind::read
                                      ? read(drive, transaction, words)
                                      : write(drive, transaction);
        if (drive.lost_answers > 0) {
            --drive.lost_answers;
            return AccessError::no_answer;
        }
        const bool is_write = transaction.kind == Transaction::Kind::write;
        return is_write && drive.unanswered_writes.count(tag) != 0 ? AccessError::no_answer : error;
    }
    static AccessError read(MemoryDrive& drive, const Transaction& transaction,
                            std::array<std::uint16_t, 64>& words)
    {
        if (transaction.count > drive.longest_read) return AccessError::invalid_tag;
        for (std::uint16_t i = 0; i < transaction.count; ++i) {
            const auto refused = drive.read_errors.find(transaction.tag->number + i);
            if (refused != drive.read_errors.end()) return refused->second;
            const auto at = drive.words.find(transaction.tag->number + i);
            if (at == drive.words.end()) return AccessError::invalid_tag;
            words[i] = at->second;
        }
        return AccessError::none;
    }
    /// A block as the 2000 series takes it: the words of tags that it does not have are dropped in silence, a
    /// refused one stops it with those before it written.
    static AccessError write(MemoryDrive& drive, const Transaction& transaction)
    {
        const int first = transaction.tag->number;
        if (transaction.count > 1 && drive.refuses_blocks != AccessError::none) return drive.refuses_blocks;
        if (transaction.count > 1 && !drive.answers_blocks) return AccessError::no_answer;
        for (std::size_t i = 0; i < transaction.words.size(); ++i) {
            const int tag = first + static_cast<int>(i);
            const bool there = drive.words.count(tag) != 0;
            if (!there && transaction.count == 1) return AccessError::invalid_tag;
            const auto refused = drive.write_errors.find(tag);
            if (refused != drive.write_errors.end()) return refused->second;
            if (there && drive.not_kept.count(tag) == 0) drive.words[tag] = transaction.words[i];
        }
        return AccessError::none;
    }
};

inline TagTable table_of(const std::vector<int>& numbers)
{
    std::vector<Tag> tags;
    for (const int number : numbers) {
        Tag tag;
        tag.number = static_cast<std::uint16_t>(number);
        tag.name = "tag " + std::to_string(number);
        tags.push_back(tag);
    }
    return TagTable{tags};
}

inline TagTable table_up_to(int last)
{
    std::vector<int> numbers;
    for (int i = 0; i <= last; ++i) numbers.push_back(i);
    return table_of(numbers);
}

} // namespace dpslave::drive::test
