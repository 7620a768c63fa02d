// SPDX-License-Identifier: Apache-2.0
// The functions of libgpiod 1 that src/io/gpio_v1.cpp uses.
#include "handle.hpp"

#include <gpiod.h>

#include <array>
#include <cerrno>
#include <memory>
#include <new>

using dpslave::stand_in::Handle;

struct gpiod_line {
    gpiod_chip* chip = nullptr;
    unsigned offset = 0;
    bool taken = false;
};

struct gpiod_chip {
    explicit gpiod_chip(Handle* opened) : handle(opened) {}
    std::unique_ptr<Handle> handle;
    std::array<gpiod_line, dpslave::stand_in::kMostLines> lines{};
};

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

const char* gpiod_chip_label(struct gpiod_chip* chip)
{
    return chip->handle->label();
}

unsigned int gpiod_chip_num_lines(struct gpiod_chip* chip)
{
    return chip->handle->lines();
}

struct gpiod_line* gpiod_chip_get_line(struct gpiod_chip* chip, unsigned int offset)
{
    if (offset >= chip->handle->lines()) {
        errno = EINVAL;
        return nullptr;
    }
    gpiod_line& line = chip->lines[offset];
    line.chip = chip;
    line.offset = offset;
    return &line;
}

const char* gpiod_line_consumer(struct gpiod_line* line)
{
    const char* const consumer = line->chip->handle->consumer(line->offset);
    return *consumer != '\0' ? consumer : nullptr;
}

int gpiod_line_request(struct gpiod_line* line, const struct gpiod_line_request_config* config, int value)
{
    if (config->request_type != GPIOD_LINE_REQUEST_DIRECTION_OUTPUT) {
        errno = EINVAL;
        return -1;
    }
    const bool active_low = (config->flags & static_cast<int>(GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW)) != 0;
    line->taken = line->chip->handle->take(line->offset, active_low, config->consumer, value != 0);
    return line->taken ? 0 : -1;
}

int gpiod_line_set_value(struct gpiod_line* line, int value)
{
    if (!line->taken) {
        errno = EPERM;
        return -1;
    }
    return line->chip->handle->set(line->offset, value != 0) ? 0 : -1;
}

void gpiod_line_release(struct gpiod_line* line)
{
    if (line->taken) line->chip->handle->give_back(line->offset);
    line->taken = false;
}

#pragma GCC visibility pop
}
