// SPDX-License-Identifier: Apache-2.0
#include "words.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <ctime>

namespace dpslave::dpctl {

std::string rate(std::int64_t baud)
{
    if (baud >= 1'000'000) return fmt::format("{} Mbit/s", static_cast<double>(baud) / 1e6);
    return fmt::format("{} kbit/s", static_cast<double>(baud) / 1e3);
}

std::string age(std::optional<double> milliseconds)
{
    if (!milliseconds) return "-";
    const double ms = *milliseconds;
    if (ms < 1000) return fmt::format("{:.0f} ms", ms);
    if (ms < 60'000) return fmt::format("{:.1f} s", ms / 1000);
    const auto minutes = static_cast<std::int64_t>(ms / 60'000);
    if (minutes < 60) return fmt::format("{} min", minutes);
    if (minutes < 60 * 24) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
    return fmt::format("{} d {} h", minutes / (60 * 24), minutes / 60 % 24);
}

std::string word(std::optional<std::int64_t> raw)
{
    if (!raw) return "-";
    return fmt::format("{} (0x{:04X})", *raw, *raw);
}

namespace {

std::tm local_time(std::chrono::system_clock::time_point when)
{
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::floor<std::chrono::seconds>(when));
    std::tm parts{};
    ::localtime_r(&seconds, &parts);
    return parts;
}

} // namespace

std::string time_of_day(std::chrono::system_clock::time_point when, std::size_t digits)
{
    const std::tm parts = local_time(when);
    const auto part = when - std::chrono::floor<std::chrono::seconds>(when);
    const std::string fraction =
        fmt::format("{:06}", std::chrono::floor<std::chrono::microseconds>(part).count());
    return fmt::format("{:02}:{:02}:{:02}.{}", parts.tm_hour, parts.tm_min, parts.tm_sec,
                       fraction.substr(0, digits));
}

std::string date_and_time(std::chrono::system_clock::time_point when)
{
    const std::tm parts = local_time(when);
    return fmt::format("{:04}-{:02}-{:02} {}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                       time_of_day(when));
}

std::string yes_no(bool yes)
{
    return yes ? "yes" : "no";
}

std::string plural(std::int64_t count, const char* one)
{
    return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string plural(std::int64_t count, const char* one, const char* many)
{
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string json_text(const Json& value)
{
    return printable_json(value.dump(2, ' ', false, Json::error_handler_t::replace));
}

Json printable_texts(Json value)
{
    if (value.is_string()) return printable(value.get_ref<const std::string&>());
    if (value.is_array())
        for (Json& item : value) item = printable_texts(std::move(item));
    if (!value.is_object()) return value;
    Json out = Json::object();
    for (auto& [key, item] : value.items()) out[printable(key)] = printable_texts(std::move(item));
    return out;
}

} // namespace dpslave::dpctl
