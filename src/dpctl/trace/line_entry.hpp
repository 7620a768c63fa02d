// SPDX-License-Identifier: Apache-2.0
/// Frames of a drive line in a trace: from records to words, lines of text, JSON and packets of a capture.
/// Pure, but for the time zone. Source: docs/reference/drive-protocols.md.
#pragma once

#include "trace_text.hpp"

#include "dpslave/drive/frame_notes.hpp"
#include "dpslave/trace/record.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
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
    std::uint8_t drive = 0; ///< as drive::TracedFrame has it
    drive::Judgement judgement = drive::Judgement::taken;
    bool is_judged = true;   ///< else nobody said how: a capture of another program
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
/// The frame of a packet that packet_of() made, whose interface has the name of the line behind "drive ".
/// `asked`: the drive of the question before it. Of another program's packet without a judgement. Nothing: it
/// is of no drive line, or nothing says who sent it.
std::optional<LineEntry> line_entry_of(const pcapng::Packet& packet, const pcapng::Interface& interface,
                                       std::uint8_t asked);
/// The line of an interface that TraceFile made; nothing: it is of none.
std::optional<std::string> line_called(const pcapng::Interface& interface);

/// What prints entries, those of the bus and those of the drive lines, with a note or none.
struct EntryPrinter {
    std::function<void(const trace::Entry&, UnixOffset, std::string_view note)> telegram;
    std::function<void(const LineEntry&, UnixOffset, std::string_view note)> frame;
};

} // namespace dpslave::dpctl
