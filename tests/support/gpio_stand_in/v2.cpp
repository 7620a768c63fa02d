// SPDX-License-Identifier: Apache-2.0
// The functions of libgpiod 2 that src/io/gpio_v2.cpp uses.
#include "handle.hpp"

#include <gpiod.h>

#include <cerrno>
#include <memory>
#include <new>
#include <string>

using dpslave::stand_in::Handle;

struct gpiod_chip {
    explicit gpiod_chip(Handle* opened) : handle(opened) {}
    std::unique_ptr<Handle> handle;
};
struct gpiod_chip_info {
    std::string label;
    std::size_t lines;
};
struct gpiod_line_info {
    std::string consumer;
};
struct gpiod_line_settings {
    bool output = false, active_low = false, active = false;
};
struct gpiod_line_config {
    unsigned offset = 0;
    gpiod_line_settings settings{};
    bool given = false;
};
struct gpiod_request_config {
    std::string consumer;
};
struct gpiod_line_request {
    gpiod_line_request(Handle* mine, unsigned line) : handle(mine), offset(line) {}
    std::unique_ptr<Handle> handle;
    unsigned offset;
};

namespace {

int refuse()
{
    errno = EINVAL;
    return -1;
}

} // namespace

extern "C" {

#pragma GCC visibility push(default)

struct gpiod_chip* gpiod_chip_open(const char* path)
{
    Handle* const handle = Handle::open(path);
    return handle != nullptr ? new (std::nothrow) gpiod_chip{handle} : nullptr;
}

void gpiod_chip_close(struct gpiod_chip* chip)
{
    delete chip;
}

struct gpiod_chip_info* gpiod_chip_get_info(struct gpiod_chip* chip)
{
    return new gpiod_chip_info{chip->handle->label(), chip->handle->lines()};
}

void gpiod_chip_info_free(struct gpiod_chip_info* info)
{
    delete info;
}

const char* gpiod_chip_info_get_label(struct gpiod_chip_info* info)
{
    return info->label.c_str();
}

size_t gpiod_chip_info_get_num_lines(struct gpiod_chip_info* info)
{
    return info->lines;
}

struct gpiod_line_info* gpiod_chip_get_line_info(struct gpiod_chip* chip, unsigned int offset)
{
    return new gpiod_line_info{chip->handle->consumer(offset)};
}

void gpiod_line_info_free(struct gpiod_line_info* info)
{
    delete info;
}

const char* gpiod_line_info_get_consumer(struct gpiod_line_info* info)
{
    return info->consumer.empty() ? nullptr : info->consumer.c_str();
}

struct gpiod_line_settings* gpiod_line_settings_new(void)
{
    return new gpiod_line_settings;
}

void gpiod_line_settings_free(struct gpiod_line_settings* settings)
{
    delete settings;
}

int gpiod_line_settings_set_direction(struct gpiod_line_settings* settings,
                                      enum gpiod_line_direction direction)
{
    settings->output = direction == GPIOD_LINE_DIRECTION_OUTPUT;
    return settings->output ? 0 : refuse();
}

void gpiod_line_settings_set_active_low(struct gpiod_line_settings* settings, bool active_low)
{
    settings->active_low = active_low;
}

int gpiod_line_settings_set_output_value(struct gpiod_line_settings* settings, enum gpiod_line_value value)
{
    settings->active = value == GPIOD_LINE_VALUE_ACTIVE;
    return value == GPIOD_LINE_VALUE_ERROR ? refuse() : 0;
}

struct gpiod_line_config* gpiod_line_config_new(void)
{
    return new gpiod_line_config;
}

void gpiod_line_config_free(struct gpiod_line_config* config)
{
    delete config;
}

int gpiod_line_config_add_line_settings(struct gpiod_line_config* config, const unsigned int* offsets,
                                        size_t num_offsets, struct gpiod_line_settings* settings)
{
    if (num_offsets != 1) return refuse();
    *config = {.offset = offsets[0], .settings = *settings, .given = true};
    return 0;
}

struct gpiod_request_config* gpiod_request_config_new(void)
{
    return new gpiod_request_config;
}

void gpiod_request_config_free(struct gpiod_request_config* config)
{
    delete config;
}

void gpiod_request_config_set_consumer(struct gpiod_request_config* config, const char* consumer)
{
    config->consumer = consumer;
}

struct gpiod_line_request* gpiod_chip_request_lines(struct gpiod_chip* chip,
                                                    struct gpiod_request_config* asked,
                                                    struct gpiod_line_config* config)
{
    if (!config->given || !config->settings.output) {
        refuse();
        return nullptr;
    }
    auto request = std::make_unique<gpiod_line_request>(chip->handle->again(), config->offset);
    const gpiod_line_settings& s = config->settings;
    if (!request->handle ||
        !request->handle->take(config->offset, s.active_low, asked->consumer.c_str(), s.active))
        return nullptr;
    return request.release();
}

void gpiod_line_request_release(struct gpiod_line_request* request)
{
    request->handle->give_back(request->offset);
    delete request;
}

int gpiod_line_request_set_value(struct gpiod_line_request* request, unsigned int offset,
                                 enum gpiod_line_value value)
{
    if (offset != request->offset) return refuse();
    return request->handle->set(offset, value == GPIOD_LINE_VALUE_ACTIVE) ? 0 : -1;
}

#pragma GCC visibility pop
}
