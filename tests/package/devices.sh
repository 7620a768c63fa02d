#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# devices.sh UNIT RULES SYSUSERS: the group that the udev rule gives devices to is made, the service is in it, and it is not
# that of the operators. What the rule gives of /dev the unit allows.
set -eu
unit=$1 rules=$2 sysusers=$3
groups=$(grep -oE 'GROUP="[^"]+"|chgrp [^ ]+' "$rules" | sed -E 's/^chgrp //; s/^GROUP="(.*)"$/\1/' | sort -u)
echo "groups of the udev rule: $groups"
[ "$groups" = dpslaved-devices ]
grep -qx "g $groups -" "$sysusers" || { echo "the group is not made" && exit 1; }
grep -qx "SupplementaryGroups=$groups" "$unit" || { echo "the service is not in it" && exit 1; }
grep -qx 'Group=dpslaved' "$unit"
for device in char-gpiochip /dev/cpu_dma_latency; do
    grep -Eqx "DeviceAllow=$device r?w" "$unit" || { echo "the unit does not allow $device" && exit 1; }
    name=${device#/dev/}
    grep -Eq "KERNEL==\"${name#char-}" "$rules" || { echo "the rule does not give $device" && exit 1; }
done
