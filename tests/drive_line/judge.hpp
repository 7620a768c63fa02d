// SPDX-License-Identifier: Apache-2.0
/// Says whether what the drive side shows and writes is true. It knows what every tag of every drive held,
/// and when, and what the master wanted; it uses no codec and no judgement of the program.
///
/// Each word on the bus was held by that tag of that drive at or after the moment at which the word shown
/// before was sampled. It is 0 only before the first reading of a layout, or where the drive denied the tag.
/// What is written was wanted there, and never an older word after a newer one. An answer to an order is one
/// to this order. What is shown as good was sampled by the last attempt to read it, and none while the drive
/// owes the answer to whatever it was asked last.
#pragma once

#include "simulated_line.hpp"

#include "dpslave/drive/poller.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace dpslave::drive_line {

class Judge {
public:
    explicit Judge(SimulatedLine& line);

    // What the master and the operator do.
    void set_outputs(std::size_t drive, const OutputImage& image);
    void left(std::size_t drive, bool goes_to_zero);
    void ordered(std::size_t drive, const DemandOrder& order);
    void operates(const drive::OperateOrder& order);

    /// What became of a transaction that has just ended.
    void attempted(const drive::Transaction& transaction, AccessError error, Instant began);

    // What the drive side shows.
    void shown(std::size_t drive, const InputImage& image);
    void shown(std::size_t drive, const drive::DriveSnapshot& snapshot,
               const std::vector<std::uint16_t>& watched);
    void answered(std::size_t drive, const DemandAnswer& answer);
    void answered(const drive::OperateAnswer& answer);

    /// After the faults have ended and the line has settled: what is still wrong; empty: nothing.
    std::string not_settled(std::size_t drive, const drive::DriveSnapshot& snapshot);

    const std::optional<std::string>& violation() const { return violation_; }

private:
    struct Wanted {
        std::uint16_t word = 0;
        Instant at{};
    };
    struct TagRecord {
        std::size_t shown = 0; ///< place in the history of the oldest sample that the last word can be
        std::size_t watched = 0;
        std::size_t ordered = 0;
        std::vector<Wanted> wanted;
        std::size_t written = 0; ///< place in `wanted` of the newest that the drive has taken
        bool is_output = false;  ///< the master writes it in its exchange
        bool was_written = false;
        std::set<std::uint16_t> written_words{}; ///< but 0; each word is wanted once
        Instant written_at{};
        bool was_refreshed = false; ///< by the last cyclic read
        Instant sampled_from{};     ///< in which its sample cannot be older than this
        /// The first question since then whose answer did not come: a later one may be taken for it.
        std::optional<Instant> unanswered_at;
    };
    struct Order {
        std::size_t drive = 0;
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool is_write = false;
        Instant at{};
    };
    struct DriveRecord {
        std::map<std::uint16_t, TagRecord> tags;
        OutputImage image;                            ///< of the last set_outputs()
        std::array<bool, kMaxParameters> was_shown{}; ///< a word other than 0, in this layout
        std::map<std::uint32_t, Order> orders;
        bool in_doubt = false; ///< it has not answered the last transaction
    };

    void report_violation(const std::string& text);
    void was_written(std::size_t drive, const SimulatedTag& tag, std::uint16_t word, Instant at);
    /// The first place from `from` on at which the tag held the word; nothing: it never did.
    std::optional<std::size_t> held(const SimulatedTag& tag, std::uint16_t word, std::size_t from) const;
    SimulatedTag& tag_of(std::size_t drive, std::uint16_t number);
    void judge_good(std::size_t drive, std::size_t place, std::uint16_t word);
    void judge_word(std::size_t drive, std::size_t place, std::uint16_t word);
    void judge_answer(const Order& order, AccessError error, std::uint16_t word);
    bool outputs_now(std::size_t drive, std::uint16_t number) const;
    static bool was_denied(const SimulatedTag& tag, const TagRecord& known);

    SimulatedLine& line_;
    std::vector<DriveRecord> drives_;
    std::map<std::uint32_t, Order> operates_;
    std::optional<std::string> violation_;
};

} // namespace dpslave::drive_line
