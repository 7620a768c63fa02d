#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# gsd_commands.sh ROOT: fails if dpctl gsd decides anything itself, so that the page could answer otherwise. It opens the configurator
# alone. gsd/type_file.hpp: files of constant text, which the page does not offer.
# It fails too if the configurator throws or catches: it is also compiled without exceptions.
set -eu
cd "$1"
own=$(grep -nHE '"dpslave/(gsd|profile)/' src/dpctl/gsd/* src/dpctl/commands/gsd/* | grep -v '"dpslave/gsd/type_file.hpp"' || true)
if [ -n "$own" ]; then
    printf 'dpctl gsd opens more than the configurator:\n%s\n' "$own" >&2
    exit 1
fi
exceptions=$(grep -rnE '\b(throw|try|catch)\b *[({]|\bthrow\b' src/configurator include/dpslave/configurator | grep -vE ':[[:space:]]*//' || true)
if [ -n "$exceptions" ]; then
    printf 'the configurator uses exceptions:\n%s\n' "$exceptions" >&2
    exit 1
fi
