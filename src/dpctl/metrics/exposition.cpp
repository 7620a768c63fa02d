// SPDX-License-Identifier: Apache-2.0
#include "exposition.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

std::string escaped(std::string_view text, bool with_quotes)
{
    std::string out;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        for (const char c : printable(text.substr(at, end - at))) {
            if (c == '\\' || (with_quotes && c == '"')) out += '\\';
            out += c;
        }
        if (end < text.size()) out += "\\n";
        at = end + 1;
    }
    return out;
}

/// `more` stands behind the others; empty: there is none.
std::string in_braces(const Labels& labels, const std::string& more = {})
{
    std::string all;
    for (const auto& [name, value] : labels)
        all += fmt::format("{}{}=\"{}\"", all.empty() ? "" : ",", name, escaped_label(value));
    if (!more.empty()) all += (all.empty() ? "" : ",") + more;
    return all.empty() ? all : '{' + all + '}';
}

} // namespace

std::string escaped_label(std::string_view value)
{
    return escaped(value, true);
}

std::string escaped_help(std::string_view text)
{
    return escaped(text, false);
}

std::string& Exposition::family(const std::string& name, const char* type, std::string_view help)
{
    const auto [known, is_new] = known_.emplace(name, families_.size());
    if (is_new)
        families_.push_back(
            fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, escaped_help(help), name, type));
    return families_[known->second];
}

void Exposition::counter(const std::string& name, std::string_view help, const Labels& labels,
                         std::int64_t value)
{
    family(name, "counter", help) += fmt::format("{}{} {}\n", name, in_braces(labels), value);
}

void Exposition::gauge(const std::string& name, std::string_view help, const Labels& labels, double value)
{
    family(name, "gauge", help) += fmt::format("{}{} {}\n", name, in_braces(labels), value);
}

void Exposition::histogram(const std::string& name, std::string_view help, const Labels& labels,
                           const Buckets& counted)
{
    std::string& out = family(name, "histogram", help);
    for (const Buckets::Bucket& one : counted.buckets)
        out += fmt::format("{}_bucket{} {}\n", name, in_braces(labels, fmt::format("le=\"{}\"", one.upper)),
                           one.count);
    out += fmt::format("{}_bucket{} {}\n", name, in_braces(labels, "le=\"+Inf\""), counted.count);
    out += fmt::format("{0}_sum{1} {2}\n{0}_count{1} {3}\n", name, in_braces(labels), counted.sum,
                       counted.count);
}

std::string Exposition::text() const
{
    std::string out;
    for (const std::string& one : families_) out += one;
    return out;
}

} // namespace dpslave::dpctl
