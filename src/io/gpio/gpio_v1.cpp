// SPDX-License-Identifier: Apache-2.0
// GPIO through libgpiod 1 (Debian 12).
#include "gpio_chips.hpp"

#include <gpiod.h>

namespace dpslave::io {
namespace {

struct CloseChip {
    void operator()(gpiod_chip* chip) const noexcept { ::gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

} // namespace

struct GpioLine::Held {
    Chip chip; // the line belongs to it
    gpiod_line* line = nullptr;

    Held(Chip owner, gpiod_line* one) : chip(std::move(owner)), line(one) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held()
    {
        static_cast<void>(::gpiod_line_set_value(line, 0));
        ::gpiod_line_release(line);
    }
};

GpioLine::GpioLine(std::unique_ptr<Held> held) : held_(std::move(held)) {}
GpioLine::GpioLine(GpioLine&&) noexcept = default;
GpioLine& GpioLine::operator=(GpioLine&&) noexcept = default;
GpioLine::~GpioLine() = default;

Result<GpioLine, std::string> GpioLine::request(const GpioRequest& request)
{
    auto chip = find_chip<Chip>(
        request, [](const std::string& path) { return Chip{::gpiod_chip_open(path.c_str())}; },
        [](const Chip& one) { return std::string{::gpiod_chip_label(one.get())}; });
    if (!chip) return Failure{chip.error()};

    const unsigned lines = ::gpiod_chip_num_lines(chip->get());
    if (request.line >= lines) return Failure{why_no_line(request, lines)};
    gpiod_line* const line = ::gpiod_chip_get_line(chip->get(), request.line);
    if (line == nullptr) return Failure{why_not_taken(request, errno, {})};

    gpiod_line_request_config config{};
    config.consumer = request.consumer.c_str();
    config.request_type = GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
    config.flags = request.active_low ? static_cast<int>(GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) : 0;
    if (::gpiod_line_request(line, &config, 0) != 0) {
        const int error = errno;
        const char* const consumer = ::gpiod_line_consumer(line); // as it was when the line was looked up
        return Failure{why_not_taken(request, error, consumer != nullptr ? consumer : "")};
    }
    return GpioLine{std::make_unique<Held>(std::move(*chip), line)};
}

std::error_code GpioLine::set(bool active) noexcept
{
    if (::gpiod_line_set_value(held_->line, active ? 1 : 0) == 0) return {};
    return {errno, std::system_category()};
}

} // namespace dpslave::io
