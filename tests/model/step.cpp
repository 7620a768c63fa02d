// SPDX-License-Identifier: Apache-2.0
#include "step.hpp"

#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace test {
namespace {

constexpr std::array<std::string_view, 7> kKinds{"request", "sdn",  "wait",   "inputs",
                                                 "answer",  "diag", "restart"};

Step step_of(const std::string& line)
{
    std::istringstream in{line};
    std::string kind, bar;
    Step step;
    in >> kind >> step.after;
    for (int& number : step.numbers) in >> number;
    in >> bar;
    std::size_t index = 0;
    while (index < kKinds.size() && kKinds[index] != kind) ++index;
    if (!in || bar != "|" || index == kKinds.size()) throw std::invalid_argument{"no step: " + line};
    step.kind = static_cast<Step::Kind>(index);
    unsigned octet = 0;
    while (in >> std::hex >> octet) step.push(octet);
    return step;
}

} // namespace

std::string show(const Step& step)
{
    std::ostringstream out;
    out << kKinds[static_cast<std::size_t>(step.kind)] << ' ' << step.after;
    for (const int number : step.numbers) out << ' ' << number;
    out << " |";
    for (const unsigned octet : step.data()) {
        std::array<char, 4> two{};
        (void)std::snprintf(two.data(), two.size(), " %02X", octet);
        out << two.data();
    }
    return out.str();
}

Steps steps_of(std::string_view lines)
{
    Steps all;
    std::istringstream in{std::string{lines}};
    for (std::string line; std::getline(in, line);)
        if (line.find_first_not_of(' ') != std::string::npos) all.push_back(step_of(line));
    return all;
}

} // namespace test
