#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# sentences.sh ROOT: fails if a text of the configurator, or of a library that it judges with, names dpctl or an option of its command line.
# The page shows the same sentences and has no options: src/dpctl/gsd adds them by the code of a finding.
# survey_text.cpp: only dpctl survey reads it. gsd_command.cpp writes the command of a mapping into the GSD.
set -eu
cd "$1"
found=$(find src/configurator src/gsd src/profile src/input include/dpslave/configurator include/dpslave/gsd include/dpslave/profile include/dpslave/input \
             -name '*.?pp' ! -name survey_text.cpp ! -name gsd_command.cpp 2>/dev/null | sort |
    while read -r file; do sed -E 's#(^|[[:space:]])//.*##' "$file" | grep -nE '"((.*["( ])?--[a-z]|.*\bdpctl\b)' | sed "s|^|$file:|" || true; done)
if [ -n "$found" ]; then
    echo "sentences that the page shows too, with words of the command line:" >&2
    printf '%s\n' "$found" >&2
    exit 1
fi
