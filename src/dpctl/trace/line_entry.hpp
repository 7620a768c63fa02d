// SPDX-License-Identifier: Apache-2.0
/// Frames of a drive line in a trace: from records to words, lines of text, JSON and packets of a capture.
/// Pure, but for the time zone. Source: docs/reference/drive-protocols.md.
#pragma once

#include "trace_text.hpp"

#include "dpslave/drive/line_frames.hpp"
#include "dpslave/trace/record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dpslave::dpctl {

struct LineEntry {
    enum class What : std::uint8_t {
        question,
        answer,  ///< what was heard, judged
        silence, ///< the wait for the answer is over
        lost,    ///< `count` records were overwritten before they were read
    };
    What what = What::question;
    std::string line; ///< its name
    drive::LineProtocol protocol = drive::LineProtocol::ei_ascii;
    std::uint8_t drive = 0; ///< as drive::LineFrame has it
    drive::Judgement judgement = drive::Judgement::taken;
    Instant first{}, last{}; ///< begin of the first and end of the last character
    std::vector<std::uint8_t> octets;
    std::uint64_t count = 0;
};

/// Nothing: it is no record of a drive line.
std::optional<LineEntry> line_entry_of(const trace::Record& record, const std::string& line);
/// `count` records are missing before `next`.
LineEntry gap_before(const LineEntry& next, std::uint64_t count);

/// What it is and how it was judged: "read PV", "PV = 16.4, BCC right: taken".
std::string words_of(const LineEntry& entry);
/// By TraceFilter::bad and ::service.
bool passes(const TraceFilter& filter, const LineEntry& entry, const std::string& words);
/// One line: time, seconds since the entry before, ">" to or "<" from the drive, words, octets.
std::string line_of(const LineEntry& entry, const std::string& words, UnixOffset offset,
                    std::optional<Instant> before);
Json json_of(const LineEntry& entry, const std::string& words, UnixOffset offset);
/// Nothing: it is no packet (a gap in the records).
std::optional<pcapng::Packet> packet_of(const LineEntry& entry, UnixOffset offset);
pcapng::LinkType link_type_of(drive::LineProtocol protocol);

} // namespace dpslave::dpctl
