#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# modem_manager.sh RULES POSTINST: ModemManager ignores the ports of serial adapters, also of those that were plugged in
# before the package came. A port of another kind may be a modem, and is left to it.
set -eu
rules=$1 postinst=$2
rule=$(sed -e ':join' -e '/\\$/N' -e 's/\\\n *//' -e 't join' "$rules" | grep 'ID_MM_DEVICE_IGNORE')
echo "$rule"
[ "$(echo "$rule" | wc -l)" -eq 1 ]
for driver in ftdi_sio cp210x ch341-uart pl2303; do
    echo "$rule" | grep -Eq "DRIVERS==\"([^\"]*\|)?${driver}[|\"]" || { echo "$driver is missing" && exit 1; }
done
echo "$rule" | grep -q '^SUBSYSTEM=="tty", SUBSYSTEMS=="usb-serial", .*ENV{ID_MM_DEVICE_IGNORE}="1"$'
if echo "$rule" | grep -Eq 'option|qcserial|sierra|cdc_acm'; then echo "this may be a modem" && exit 1; fi
grep -q "subsystem-match=tty --sysname-match='ttyUSB\*'" "$postinst"
