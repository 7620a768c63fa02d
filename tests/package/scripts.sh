#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# scripts.sh DEBIAN CASE: the maintainer scripts as dpkg calls them, with a recorder in the place of deb-systemd-invoke and a
# folder in that of /run. What debhelper puts into them is not here: that an upgrade restarts dpslaved.service only if it
# runs is the option in debian/rules, and is looked for there.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/bin" "$work/run/systemd/system"
printf '#!/bin/sh\necho "$*" >>%s/asked\n' "$work" >"$work/bin/deb-systemd-invoke"
chmod +x "$work/bin/deb-systemd-invoke"
script() {
    name=$1
    shift
    sed "s#/run/#$work/run/#g" "$debian/dpslaved.$name" >"$work/$name"
    PATH="$work/bin:$PATH" sh "$work/$name" "$@"
}
asked() {
    touch "$work/asked"
    [ "$(cat "$work/asked")" = "$1" ] || { echo "asked systemd:" && cat "$work/asked" && exit 1; }
    rm "$work/asked"
}
debian=$1
grep -q 'dh_installsystemd -pdpslaved --no-start --restart-after-upgrade dpslaved.service' "$debian/rules"
grep -q 'dh_installsystemd -pdpslaved --no-start --no-enable --restart-after-upgrade dpslaved-metrics.timer' "$debian/rules"
case $2 in
    install) # started, once
        script preinst install
        script postinst configure ''
        asked 'start dpslaved.service'
        [ ! -e "$work/run/dpslaved.new" ]
        ;;
    upgrade) # only what runs is started again: "try-restart"
        script prerm upgrade 2
        script preinst upgrade 1
        script postinst configure 1
        asked 'try-restart dpslaved@*.service'
        ;;
    again) # removed and installed again: as new, although dpkg names the version before
        script prerm remove
        asked 'stop dpslaved-metrics.timer dpslaved-metrics@*.timer dpslaved.service dpslaved@*.service'
        script preinst install 1
        script postinst configure 1
        asked 'start dpslaved.service'
        ;;
    *) echo "unknown case $2" && exit 2 ;;
esac
