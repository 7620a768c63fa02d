#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# keys.sh ROOT: fails if config/dpslaved.toml has a key, or a table of keys, of which dpslaved.toml(5) knows nothing
# under that table's heading, or the page has a key that the file does not have, or no page has a column of tag tables.
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# "table key", one a line. A key stands as `key = value` behind at most "# ".
awk '/^#?\[/ { table = $0; gsub(/[#\[\]]/, "", table); next }
     /^# --- Tag tables/ { exit }
     table != "" && match($0, /^(# ?)?[a-z][a-z_0-9]* = /) {
         key = substr($0, 1, RLENGTH - 3); sub(/^# ?/, "", key); print table, key }' config/dpslaved.toml |
    sort -u >"$work/file"
# In the page: `*key* =` in the section of its table, and the lamps, which stand in a sentence there.
awk '/^# / { table = ""; if (match($0, /^# \[+[A-Z.]+\]+$/)) { table = tolower(substr($0, 3)); gsub(/[\[\]]/, "", table) } next }
     table != "" {
         key = table == "station.leds" && /^[A-Z]/ ? "\\*[a-z]+\\*" : /^\*/ ? "\\*[a-z_0-9]+\\* =" : "^$"
         rest = $0
         while (rest != "" && match(rest, key)) {
             word = substr(rest, RSTART, RLENGTH); gsub(/[* =]/, "", word); print table, word
             rest = substr(rest, RSTART + RLENGTH) } }' \
    docs/man/dpslaved.toml.5.scd | sort -u >"$work/page"

[ "$(wc -l <"$work/file")" -gt 30 ] || { echo "found next to no keys in config/dpslaved.toml" && exit 1; }
# The columns of a tag table, as the program knows them: in the page and in config/tags/README.md.
columns=$(sed -n '/kColumnNames{/,/};/p' src/profile/tag_row.hpp | grep -oE '"[a-z]+"' | tr -d '"')
[ "$(echo "$columns" | wc -l)" -ge 14 ] || { echo "found next to no columns in src/profile/tag_row.hpp" && exit 1; }
for column in $columns; do
    sed -n '/^# TAG TABLES/,/^# EXAMPLE/p' docs/man/dpslaved.toml.5.scd | grep -qE "^\\*(.*\\*, \\*)?$column\\*" ||
        { echo "dpslaved.toml(5) does not have the column $column" && exit 1; }
    sed -n '/^# --- Tag tables/,$p' config/dpslaved.toml | grep -qE "^#   (.*, )?$column\b" ||
        { echo "config/dpslaved.toml does not have the column $column" && exit 1; }
    grep -qF "\`$column\`" config/tags/README.md ||
        { echo "config/tags/README.md does not have the column $column" && exit 1; }
done

missing=$(comm -23 "$work/file" "$work/page")
unknown=$(comm -13 "$work/file" "$work/page")
[ -z "$missing" ] || printf 'dpslaved.toml(5) does not have:\n%s\n' "$missing"
[ -z "$unknown" ] || printf 'config/dpslaved.toml does not have:\n%s\n' "$unknown"
[ -z "$missing$unknown" ]
