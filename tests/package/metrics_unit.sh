#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# metrics_unit.sh UNIT INSTALLED BUILT: fails if the unit may write more than the folder of its file, or if its command
# does not write that file without a daemon, or ends then with a status that the unit takes for a failure.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
value() { sed -n "s/^$1=//p" "$unit"; }
unit=$1
command=$(value ExecStart)
file=${command##*--output }
[ "$(value ReadWritePaths)" = "$(dirname "$file")" ] || { echo "may write $(value ReadWritePaths)" && exit 1; }
[ "$(value ProtectSystem)" = strict ] || { echo "may write more" && exit 1; }
case $file in
    *.prom) ;;
    *) echo "node_exporter does not read $file" && exit 1 ;;
esac
# As systemd calls it, with the file elsewhere. Nobody serves that socket in the place where tests run.
status=0
# shellcheck disable=SC2046 # words
"$3/dpctl" $(echo "${command#"$2"/dpctl }" | sed "s# --socket [^ ]*# --socket $work/none#; s#^--socket [^ ]*#--socket $work/none#; s#$file#$work/a.prom#") \
    >"$work/out" 2>&1 || status=$?
grep -q "nothing answers" "$work/out" || { cat "$work/out" && exit 1; }
[ "$(value SuccessExitStatus)" = $status ] || { echo "without a daemon it ends with $status" && exit 1; }
grep -qx "dpslaved_up{socket=\"$work/none\"} 0" "$work/a.prom" || { cat "$work/a.prom" && exit 1; }
