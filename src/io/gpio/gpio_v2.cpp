// SPDX-License-Identifier: Apache-2.0
// GPIO through libgpiod 2 (Debian 13).
#include "gpio_chips.hpp"

#include <gpiod.h>

#include <new>

namespace dpslave::io {
namespace {

struct Free {
    void operator()(gpiod_chip* one) const noexcept { ::gpiod_chip_close(one); }
    void operator()(gpiod_chip_info* one) const noexcept { ::gpiod_chip_info_free(one); }
    void operator()(gpiod_line_info* one) const noexcept { ::gpiod_line_info_free(one); }
    void operator()(gpiod_line_settings* one) const noexcept { ::gpiod_line_settings_free(one); }
    void operator()(gpiod_line_config* one) const noexcept { ::gpiod_line_config_free(one); }
    void operator()(gpiod_request_config* one) const noexcept { ::gpiod_request_config_free(one); }
    void operator()(gpiod_line_request* one) const noexcept { ::gpiod_line_request_release(one); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

/// The library gives no object only when there is no memory left.
template <class T>
Owned<T> made(T* one)
{
    if (one == nullptr) throw std::bad_alloc{};
    return Owned<T>{one};
}

std::string label_of(const Owned<gpiod_chip>& chip)
{
    const Owned<gpiod_chip_info> info{::gpiod_chip_get_info(chip.get())};
    return info ? ::gpiod_chip_info_get_label(info.get()) : "";
}

std::string consumer_of(const Owned<gpiod_chip>& chip, unsigned line)
{
    const Owned<gpiod_line_info> info{::gpiod_chip_get_line_info(chip.get(), line)};
    const char* const name = info ? ::gpiod_line_info_get_consumer(info.get()) : nullptr;
    return name != nullptr ? name : "";
}

/// The line as an output that is inactive; empty: errno says why.
Owned<gpiod_line_request> take(const Owned<gpiod_chip>& chip, const GpioRequest& request)
{
    const auto settings = made(::gpiod_line_settings_new());
    const auto lines = made(::gpiod_line_config_new());
    const auto asked = made(::gpiod_request_config_new());
    ::gpiod_line_settings_set_active_low(settings.get(), request.active_low);
    ::gpiod_request_config_set_consumer(asked.get(), request.consumer.c_str());
    if (::gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_OUTPUT) != 0 ||
        ::gpiod_line_settings_set_output_value(settings.get(), GPIOD_LINE_VALUE_INACTIVE) != 0 ||
        ::gpiod_line_config_add_line_settings(lines.get(), &request.line, 1, settings.get()) != 0)
        return nullptr;
    return Owned<gpiod_line_request>{::gpiod_chip_request_lines(chip.get(), asked.get(), lines.get())};
}

} // namespace

struct GpioLine::Held {
    Owned<gpiod_line_request> request; // needs no chip any more
    unsigned line = 0;

    Held(Owned<gpiod_line_request> taken, unsigned offset) : request(std::move(taken)), line(offset) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held()
    {
        static_cast<void>(::gpiod_line_request_set_value(request.get(), line, GPIOD_LINE_VALUE_INACTIVE));
    }
};

GpioLine::GpioLine(std::unique_ptr<Held> held) : held_(std::move(held)) {}
GpioLine::GpioLine(GpioLine&&) noexcept = default;
GpioLine& GpioLine::operator=(GpioLine&&) noexcept = default;
GpioLine::~GpioLine() = default;

Result<GpioLine, std::string> GpioLine::request(const GpioRequest& request)
{
    auto chip = find_chip<Owned<gpiod_chip>>(
        request, [](const std::string& path) { return Owned<gpiod_chip>{::gpiod_chip_open(path.c_str())}; },
        label_of);
    if (!chip) return Failure{chip.error()};

    const Owned<gpiod_chip_info> info{::gpiod_chip_get_info(chip->get())};
    if (!info) return Failure{why_no_chip(request, errno)};
    const std::size_t lines = ::gpiod_chip_info_get_num_lines(info.get());
    if (request.line >= lines) return Failure{why_no_line(request, lines)};

    auto taken = take(*chip, request);
    if (!taken) {
        const int error = errno;
        return Failure{why_not_taken(request, error, consumer_of(*chip, request.line))};
    }
    return GpioLine{std::make_unique<Held>(std::move(taken), request.line)};
}

std::error_code GpioLine::set(bool active) noexcept
{
    const auto value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    if (::gpiod_line_request_set_value(held_->request.get(), held_->line, value) == 0) return {};
    return {errno, std::system_category()};
}

} // namespace dpslave::io
