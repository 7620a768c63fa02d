# SPDX-License-Identifier: Apache-2.0
# All tests in the container, in the order of a life: installed, configured, in service, disturbed, upgraded, removed.
# shellcheck shell=bash source-path=SCRIPTDIR
# shellcheck source=world.sh
source /host/world.sh || exit 1

# The ports are ptys of the host, which udev knows nothing of.
chown root:dialout /dev/tty{PB,DRIVE}[12]
chmod 0660 /dev/tty{PB,DRIVE}[12]

subject /host/install.sh
subject /host/installed_programs.sh # they take the configuration as it was shipped

# The unit allows serial ports; ptys are no such. Where the host lets a container enforce it, this is needed.
drop_in dpslaved.service ptys $'[Service]\nDeviceAllow=char-pts rw'
drop_in dpslaved@.service ptys $'[Service]\nDeviceAllow=char-pts rw'

subject /host/faulty_starts.sh
subject /host/start.sh
for part in disturbances reload rights sandbox second_bus disk upgrade; do
    require "(everything is in service for: ${part//_/ })" in_service
    subject "/host/$part.sh"
done
finish
