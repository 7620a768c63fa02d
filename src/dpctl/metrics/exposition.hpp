// SPDX-License-Identifier: Apache-2.0
/// The text exposition format of Prometheus, version 0.0.4. Pure: families and samples in, text out. Source:
/// prometheus.io/docs/instrumenting/exposition_formats.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::dpctl {

/// Names and values of labels, in the order in which they are written. A value may be any text.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// A value of a label or a help text may have any characters: line end, backslash and (in a label) quotes are
/// escaped, other control characters are written as printable() does, octets that are no UTF-8 too.
std::string escaped_label(std::string_view value);
std::string escaped_help(std::string_view text);

/// Values counted in buckets, as a histogram of Prometheus has them.
struct Buckets {
    struct Bucket {
        double upper = 0;       ///< in the unit of the family, included
        std::int64_t count = 0; ///< of all values up to it; never falls from one bucket to the next
    };
    std::vector<Bucket> buckets; ///< lowest first, without the one of +Inf
    std::int64_t count = 0;      ///< of all values
    double sum = 0;              ///< of all values
};

/// Collects samples by family and writes each family whole, as the format demands. Families come in the order
/// of their first sample.
class Exposition {
public:
    /// `name` ends with _total. Precondition, here and below: `name` and the names of labels are legal, and
    /// no sample of a family has the labels of another one.
    void counter(const std::string& name, std::string_view help, const Labels& labels, std::int64_t value);
    void gauge(const std::string& name, std::string_view help, const Labels& labels, double value);
    void histogram(const std::string& name, std::string_view help, const Labels& labels,
                   const Buckets& counted);

    std::string text() const;

private:
    std::string& family(const std::string& name, const char* type, std::string_view help);

    std::vector<std::string> families_;
    std::map<std::string, std::size_t> known_; ///< by name: the place in families_
};

} // namespace dpslave::dpctl
