// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/uart_kind.hpp"

#include <array>
#include <utility>

namespace dpslave::io {
namespace {

constexpr auto kDrivers = std::to_array<std::pair<std::string_view, UartKind>>({
    {"serial8250", UartKind::i8250},
    {"serial", UartKind::i8250}, // PNP and PCI
    {"of_serial", UartKind::i8250},
    {"dw-apb-uart", UartKind::i8250_kin},
    {"exar_serial", UartKind::i8250_kin},
    {"omap8250", UartKind::omap},
    {"uart-pl011", UartKind::pl011},
    {"imx-uart", UartKind::imx},
    {"mt6577-uart", UartKind::mediatek},
    {"bcm2835-aux-uart", UartKind::mini},
    {"ftdi_sio", UartKind::ftdi},
    {"ftdi", UartKind::ftdi},
    {"cp210x", UartKind::usb_other},
    {"ch341", UartKind::usb_other},
    {"ch341-uart", UartKind::usb_other},
    {"ch343", UartKind::usb_other},
    {"pl2303", UartKind::usb_other},
    {"cdc_acm", UartKind::usb_other},
});

} // namespace

UartKind uart_kind(std::string_view driver)
{
    for (const auto& [name, kind] : kDrivers)
        if (name == driver) return kind;
    return UartKind::unknown;
}

bool is_usb(UartKind kind)
{
    return kind == UartKind::ftdi || kind == UartKind::usb_other;
}

bool is_8250(UartKind kind)
{
    return kind == UartKind::i8250 || kind == UartKind::i8250_kin || kind == UartKind::omap;
}

std::uint32_t idle_timeout(UartKind kind)
{
    constexpr std::uint32_t kFourCharacters = 44, kEightCharacters = 88;
    switch (kind) {
        case UartKind::i8250:
        case UartKind::i8250_kin:
        case UartKind::omap:
        case UartKind::mediatek: return kFourCharacters;
        case UartKind::pl011: return 32;
        case UartKind::imx: return kEightCharacters;
        case UartKind::pty:
        case UartKind::mini:
        case UartKind::ftdi:
        case UartKind::usb_other:
        case UartKind::unknown: break;
    }
    return 0;
}

} // namespace dpslave::io
