// SPDX-License-Identifier: Apache-2.0
/// A capture that is being written: pcapng, one interface for the bus and one for each drive line, statistics
/// at its end.
#pragma once

#include "line_entry.hpp"
#include "trace_text.hpp"

#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

class TraceFile {
public:
    /// When packets are written: as they come, or at the end in the order of their times. The second is for
    /// records of several rings that are read one after the other.
    enum class Order : std::uint8_t { as_they_come, by_time };

    /// Makes the file anew. The error is a sentence with its path.
    static Result<TraceFile, std::string> create(const std::string& path, pcapng::LinkType bus_link_type,
                                                 Order order);

    /// From now on the bus has an interface, also if no packet comes.
    void add_bus() { bus(); }
    /// One entry; `note` becomes a comment. What was lost is written with the packet behind it.
    void add(const trace::Entry& entry, const TraceWords& words, UnixOffset offset,
             std::string_view note = {});
    void add(const LineEntry& entry, UnixOffset offset, std::string_view note = {});
    /// What was written as it came is in the file: it ends with a whole packet.
    void flush() { file_.flush(); }
    /// The end: what was received and lost. The error is a sentence with the path.
    std::optional<std::string> finish(std::int64_t unix_ns);

    std::uint64_t packets() const;

private:
    struct Counted {
        pcapng::Interface interface;
        std::uint64_t received = 0, dropped = 0;
        std::uint64_t dropped_before = 0; ///< since the last packet
    };
    TraceFile(std::string path, std::ofstream file, pcapng::LinkType bus_link_type, Order order)
        : path_(std::move(path)), file_(std::move(file)), bus_link_type_(bus_link_type), order_(order)
    {}
    std::uint32_t interface(const std::string& name, pcapng::LinkType link_type,
                            const std::string& description);
    std::uint32_t bus() { return interface("bus", bus_link_type_, "PROFIBUS"); }
    void lost(std::uint32_t interface, std::uint64_t count);
    void add(std::uint32_t interface, pcapng::Packet packet);
    void write(const pcapng::Octets& octets);

    std::string path_;
    std::ofstream file_;
    pcapng::LinkType bus_link_type_;
    Order order_;
    std::vector<Counted> interfaces_;
    std::vector<pcapng::Packet> kept_; ///< to be written at the end
};

} // namespace dpslave::dpctl
