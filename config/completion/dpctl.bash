# SPDX-License-Identifier: Apache-2.0
# Bash completion of dpctl. Names of stations come from the daemon, names of profiles from their folder.

# The options that every command has which asks the daemon.
_dpctl_common='--json --field --socket --timeout --help'

_dpctl_options()
{
    case $1 in
        '') echo "$_dpctl_common --version" ;;
        doctor) echo "$_dpctl_common --station --rules --probe --yes" ;;
        status) echo "$_dpctl_common --station --follow --wait --with-drive --quiet" ;;
        io | events) echo "$_dpctl_common --station --follow" ;;
        show | diag) echo "$_dpctl_common --station" ;;
        trace) echo "$_dpctl_common --follow --read --incidents --incident --station --line --service --bad --stop-on --decode --gsd --profile --profiles --output --linktype" ;;
        'tec set') echo "$_dpctl_common --station --yes" ;;
        top) echo "$_dpctl_common --station --every" ;;
        plot) echo "$_dpctl_common --last --output --csv --station" ;;
        read) echo "$_dpctl_common --every --names --station" ;;
        write) echo "$_dpctl_common --station --yes" ;;
        metrics) echo "$_dpctl_common --output" ;;
        reload) echo "$_dpctl_common --dry-run --careful --yes" ;;
        survey) echo "$_dpctl_common --station --tags --output --rule --for --passes --resume" ;;
        tag) echo '--json --field --all --table --profile --profiles --help' ;;
        identify) echo '--json --field --baud --format --unit --protocol --rule --tags --table --profiles --timeout --direction
                        --gpio-chip --gpio-line --gpio-active-low --help' ;;
        hex) echo '--json --field --help' ;;
        decode) echo '--json --field --as --profile --profiles --help' ;;
        'gsd check') echo '--strict --profile --modules --tags-at --identifiers --mapping --ident --station --table --profiles --socket --timeout --json --field
                           --help' ;;
        'gsd show') echo '--profile --modules --profiles --table --json --field --help' ;;
        'gsd make') echo '--profile --profiles --table --mapping --in --out --in-out --order --tags --tags-at --identifiers --demand --ident --max-tsdr --description
                          --model --output --force --json --field --help' ;;
        'gsd import') echo '--profile --cfg --lossy --station --socket --timeout --profiles --table --output --force --json --field --help' ;;
        'gsd diff') echo '--profile --profiles --table --json --field --help' ;;
        'gsd configure') echo '--page --json --field --help' ;;
        'gsd types') echo '--output --brief --force --json --field --help' ;;
        gsd) echo '--json --field --help' ;;
        *) echo "$_dpctl_common" ;;
    esac
}

# The names in what dpctl prints with these arguments, of the daemon behind the socket that the line names; nothing if it does
# not answer at once.
_dpctl_names()
{
    local i socket=()
    for ((i = 1; i < COMP_CWORD; i++)); do
        [ "${COMP_WORDS[i]}" != --socket ] || socket=(--socket "${COMP_WORDS[i + 1]}")
    done
    dpctl "${socket[@]}" --timeout 1 --json "$@" 2>/dev/null |
        grep -oE '"name": *"[^"]*"' | sed -E 's/^"name": *"(.*)"$/\1/'
}

_dpctl_stations()
{
    _dpctl_names status
}

# Of the tag table of the station that the line names, or of the only one.
_dpctl_tags()
{
    local i station=()
    for ((i = 1; i < COMP_CWORD; i++)); do
        [[ ${COMP_WORDS[i]} != --station && ${COMP_WORDS[i]} != -s ]] || station=(--station "${COMP_WORDS[i + 1]}")
    done
    _dpctl_names read --names "${station[@]}"
}

_dpctl_profiles()
{
    local i folder=/usr/share/dpslaved/profiles file
    for ((i = 1; i < COMP_CWORD; i++)); do
        [ "${COMP_WORDS[i]}" != --profiles ] || folder=${COMP_WORDS[i + 1]}
    done
    for file in "$folder"/*.toml; do
        [ ! -e "$file" ] || basename "$file" .toml
    done
}

# Those lines of standard input that begin as the word does; a name may have blanks.
_dpctl_offer()
{
    local line
    while IFS= read -r line; do
        [[ $line != "$1"* ]] || COMPREPLY+=("$(printf %q "$line")")
    done
}

_dpctl()
{
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command='' i word words=''
    COMPREPLY=()
    case $prev in
        --socket | --table | --mapping | --page | --read) compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profiles | --output | -o | --gsd) compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profile) _dpctl_offer "$cur" < <(_dpctl_profiles); return ;;
        --linktype) mapfile -t COMPREPLY < <(compgen -W 'profibus user0' -- "$cur"); return ;;
        --rule) mapfile -t COMPREPLY < <(compgen -W '590plus ac pno none' -- "$cur"); return ;;
        --protocol) mapfile -t COMPREPLY < <(compgen -W 'ei-ascii modbus-rtu' -- "$cur"); return ;;
        --direction) mapfile -t COMPREPLY < <(compgen -W 'none gpio kernel rts' -- "$cur"); return ;;
        --as) mapfile -t COMPREPLY < <(compgen -W 'prm cfg diag' -- "$cur"); return ;;
        --station | -s) _dpctl_offer "$cur" < <(_dpctl_stations); return ;;
        --baud | --format | --unit | --gpio-chip | --gpio-line | --timeout | --field | --wait | --every | --last | --service | --stop-on | --tags | --for | --passes | --in | --out | --in-out | --order | --line | --incident | --ident | --max-tsdr | --description | --model) return ;;
    esac
    for ((i = 1; i < COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]}
        case $word in
            --baud | --format | --unit | --protocol | --direction | --gpio-chip | --gpio-line | --socket | --timeout | --field | --wait | --service | --stop-on | --gsd | --profiles | --profile | --output | -o | --read | --line | --incident | --linktype | --every | --last | --station | -s | --tags | --table | --rule | --for | --passes) i=$((i + 1)) ;;
            -*) ;;
            *)
                case "$command" in
                    '') command=$word ;;
                    gsd) command="gsd $word" ;;
                    tec) [ "$word" != set ] || command='tec set' ;;
                esac
                ;;
        esac
    done
    if [[ $cur == -* ]]; then
        words=$(_dpctl_options "$command")
    else
        case $command in
            '') words='status show io diag counters doctor trace bus top events plot metrics read write tec survey log-level reload tune tag identify hex decode gsd version' ;;
            read | write | plot) _dpctl_offer "$cur" < <(_dpctl_tags); return ;;
            log-level) words='debug info' ;;
            status | show | io | top | events | diag | doctor | survey | trace) _dpctl_offer "$cur" < <(_dpctl_stations); return ;;
            tec) words='set' ;;
            'tec set') words='TYPE ADDRESS EXT_DIAGNOSTIC INT_DIAG_SELECT RIDE_THROUGH UNUSED_1' ;;
            gsd) words='check show make import diff configure types' ;;
            tune | identify | 'gsd check' | 'gsd show' | 'gsd import' | 'gsd diff') compopt -o filenames 2>/dev/null
                mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        esac
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}
complete -F _dpctl dpctl
