// SPDX-License-Identifier: Apache-2.0
#include "proc_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>

namespace dpslave::io {
namespace {

template <class Number>
std::optional<Number> number_of(std::string_view text)
{
    Number value{};
    const auto begins = text.find_first_not_of(" \t");
    if (begins == std::string_view::npos) return std::nullopt;
    text.remove_prefix(begins);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    return value;
}

/// Numbers of the policy in proc(5), stat, field 41.
Policy policy_of(long number)
{
    switch (number) {
        case 1: return Policy::fifo;
        case 2: return Policy::round_robin;
        case 6: return Policy::deadline;
        default: return Policy::ordinary;
    }
}

} // namespace

std::optional<std::string> file_text(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (file.bad()) return std::nullopt;
    if (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

std::optional<long> file_number(const std::filesystem::path& path)
{
    const auto text = file_text(path);
    return text ? number_of<long>(*text) : std::nullopt;
}

std::string line_value(std::string_view text, std::string_view name)
{
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto colon = line.find(':');
        if (colon == std::string_view::npos ||
            line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) != name)
            continue;
        line.remove_prefix(colon + 1);
        const auto begins = line.find_first_not_of(" \t");
        return begins == std::string_view::npos ? std::string{} : std::string{line.substr(begins)};
    }
    return {};
}

std::vector<std::string> names_in(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        names.push_back(it->path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<int> numbers_in(const std::filesystem::path& folder)
{
    std::vector<int> numbers;
    for (const std::string& name : names_in(folder))
        if (name.find_first_not_of("0123456789") == std::string::npos)
            if (const auto number = number_of<int>(name)) numbers.push_back(*number);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

std::optional<ThreadFacts> read_thread(const std::filesystem::path& folder)
{
    // "PID (name) S 2 0 ...": the name may hold blanks and brackets, so the fields begin behind the last one.
    const auto stat = file_text(folder / "stat");
    if (!stat) return std::nullopt;
    const auto opened = stat->find('('), closed = stat->rfind(')');
    if (opened == std::string::npos || closed == std::string::npos || closed < opened) return std::nullopt;

    constexpr std::size_t kFirst = 3; // number of the field behind the name in proc(5)
    constexpr std::size_t kLast = 41;
    std::array<long long, kLast + 1> field{};
    std::string_view rest = std::string_view{*stat}.substr(closed + 1);
    for (std::size_t n = kFirst; n <= kLast; ++n) {
        const auto begins = rest.find_first_not_of(' ');
        if (begins == std::string_view::npos) return std::nullopt;
        rest.remove_prefix(begins);
        field[n] = number_of<long long>(rest.substr(0, rest.find(' '))).value_or(0);
        rest.remove_prefix(std::min(rest.find(' '), rest.size()));
    }
    constexpr long long kKernelThread = 0x0020'0000; // PF_KTHREAD of linux/sched.h, in field 9
    ThreadFacts thread;
    thread.id = number_of<int>(*stat).value_or(0);
    thread.name = stat->substr(opened + 1, closed - opened - 1);
    thread.kernel = (field[9] & kKernelThread) != 0;
    thread.major_faults = static_cast<std::uint64_t>(std::max(field[12], 0LL));
    thread.policy = policy_of(static_cast<long>(field[41]));
    thread.priority = thread.is_realtime() ? static_cast<int>(field[40]) : 0;
    thread.cpus = line_value(file_text(folder / "status").value_or(""), "Cpus_allowed_list");
    return thread;
}

} // namespace dpslave::io
