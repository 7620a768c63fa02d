#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# facts.sh ROOT: fails if a page has lost a fact that misleads or endangers its reader when it is missing. One fact a line:
# page | words that follow each other there (a regular expression) | source. Emphasis and line breaks do not count.
set -eu
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cat > "$scratch/facts" <<'END'
docs/guide/wiring.md | wait at least 5 minutes | HA463561, safety
docs/guide/wiring.md | below 50 V between all power terminals and earth | HA463561, safety
docs/guide/wiring.md | [Dd]o not fit, plug or remove anything under power | HA389815, installation
docs/guide/wiring.md | No high-voltage test on wiring that is connected to the drive | HA463561, safety
docs/guide/wiring.md | not recommended with these drives. Where one is mandatory, use type B only | HA463561, safety
docs/guide/wiring.md | Do not dismantle the drive | HA463561, safety
docs/guide/wiring.md | After a drive was replaced, restore all parameters | HA463561, safety
docs/guide/wiring.md | A fieldbus is no safety function | HA463561, risk assessment
docs/guide/wiring.md | \(installation-details\.md\) | HA463561, contents of the manual's first page
docs/guide/installation-details.md | Model number .* Serial number .* Where it is installed | HA463561, installation details
docs/devices/2408f-2404f.md | HD \| common \| common .* HE \| A\(\+\) .* HF \| B\(-\) | 2408/2404 handbook, table 1-3
docs/devices/2408f-2404f.md | HB \| not used \| A'\(\+\), receives .* HC \| not used \| B'\(-\), receives | 2408/2404 handbook, table 1-3
docs/devices/2408f-2404f.md | A is positive here: the reverse of PROFIBUS | 2408/2404 handbook, table 1-3
docs/devices/2408f-2404f.md | HD \| B/B' \| RxD/TxD positive .* HE \| A/A' \| RxD/TxD negative | HA026290, wiring
docs/devices/2408f-2404f.md | mains supply and for 24 V .* mains on a 24 V controller destroys it | HA026290, wiring
docs/devices/2408f-2404f.md | proportional band 0, integral > ?time off, derivative time off | HA026290, gain scheduling
docs/devices/2408f-2404f.md | put your Ident_Number here | X-16
docs/devices/option-board.md | Not proven: P3 MODE = FIELD BUS together with EI-ASCII.* Try in this order | [DEC]
docs/devices/technology-box.md | -32768 to 32767.* 32768 to 65535 as well | B-049
docs/devices/technology-box.md | P3, no multi-drop port | product manual of the 590+
docs/devices/technology-box.md | What is not known is not guessed.* dpctl doctor --probe | [DEC]
docs/devices/technology-box.md | Any other value than 0 can compromise safety | B-047
docs/guide/wiring.md | type A, m \| 1200 \| 1200 \| 1200 \| 1000 \| 400 \| 200 .* type B, m \| 1200 \| 1200 \| 1200 \| 600 \| 200 \| not allowed | B-022
docs/guide/wiring.md | 390 Ω \]── B ──\[ 220 Ω \]── A ──\[ 390 Ω | A-025
docs/guide/wiring.md | earth the shield at one end only. Never connect it to the signal reference | B-023
docs/guide/wiring.md | Terminate both ends of a segment, and nothing in between | B-025
docs/devices/option-board.md | 1 \| 0Vext \|.* 2 \| \+5VDCext \|.* 3 \| B/B' \| RxD/TxD-P .* 4 \| A/A' \| RxD/TxD-N .* 5 \| RTS \| TTL, high while transmitting.* 6 \| 0Vext | A-020
docs/devices/option-board.md | TX- \| TBG.1 \| TBA.1 .* TX\+ \| TBG.2 \| TBA.2 .* RX- \| TBG.3 \| TBA.3 .* RX\+ \| TBG.4 \| TBA.4 | A-023
docs/devices/option-board.md | 390 Ω from terminal 2 to B, .*220 Ω between B and A, .*390 Ω from A to 0 V. That is terminal 1 on 584S and 590, terminal 6 on the 620 | A-025
docs/devices/technology-box.md | 3 \| B/B' \| RxD/TxD-P .* 4 \| A/A' \| RxD/TxD-N .* 6 \| GND \| EMC ground | B-024
docs/devices/technology-box.md | shows the terminals from the back | B-026
docs/devices/technology-box.md | set the DIL switch SW1 .* yellow/green|yellow/green .* set the DIL switch SW1 | B-027
docs/devices/2408f-2404f.md | Never connect the shield to it | C-003
docs/guide/master.md | only where the gateway's machine keeps the MaxTsdr of that GSD | wire reference 11.6
docs/guide/real-time.md | It is computed, not measured | wire reference 11.6
docs/guide/master.md | 584S, 590, 620 that we make \| 0 \| General | wire reference 9
docs/guide/master.md | the listings of HA389815 \| not stated | HA389815, appendix A
docs/guide/master.md | SONSTIGE \(OTHERS\) \| Others, not DRIVES | HA389815, appendix B
README.md | only if the machine keeps the MaxTsdr of that GSD | wire reference 11.6
README.md | first run also installs packages and builds the programs | tools/demo
README.md | /dev/serial/by-id/ | udev
gsd/README.md | if the machine keeps its MaxTsdr | wire reference 11.6
debian/README.md | only where the machine keeps its MaxTsdr | wire reference 11.6
END
for page in docs/devices/option-board.md docs/devices/technology-box.md docs/devices/2408f-2404f.md; do
    echo "$page | keeps its GSD only where the machine keeps the MaxTsdr of that GSD | wire reference 11.6"
done >> "$scratch/facts"

# missing FOLDER: the facts that its pages do not have.
missing() {
    while IFS= read -r line; do
        page=${line%% | *}
        words=${line#* | }
        words=${words% | *}
        tr '\n' ' ' < "$1/$page" | sed 's/[*`]//g; s/  */ /g' | grep -qE -e "$words" || echo "$page does not say: $words"
    done < "$scratch/facts"
}

# It would notice: pages without a word have no fact.
cut -d' ' -f1 "$scratch/facts" | sort -u | while read -r page; do
    mkdir -p "$scratch/empty/$(dirname "$page")"
    : > "$scratch/empty/$page"
done
[ "$(missing "$scratch/empty" | wc -l)" -eq "$(wc -l < "$scratch/facts")" ] || { echo "this check is blind" && exit 2; }

missing . > "$scratch/missing"
cat "$scratch/missing"
[ ! -s "$scratch/missing" ]
