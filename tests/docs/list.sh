#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# list.sh ROOT: docs/README.md, the list of all pages, has each page once. Each picture is on a page.
set -eu
cd "$1/docs"
listed=$(grep -oE '^\| \[[^]]+\]\([^)#]+' README.md | sed 's/.*(//' | sort)
there=$(find . -name '*.md' ! -path ./README.md | sed 's,^\./,,' | sort)
[ "$listed" = "$there" ] || { printf 'docs/README.md lists:\n%s\n\nThere are:\n%s\n' "$listed" "$there" >&2 && exit 1; }
for picture in guide/pictures/*.png internals/pictures/*.svg; do
    grep -qF "](pictures/${picture##*/})" "${picture%%/*}"/*.md || { echo "no page has the picture $picture" >&2 && exit 1; }
done
