# SPDX-License-Identifier: Apache-2.0
# Bash completion of dpctl. Names of stations come from the daemon, names of profiles from their folder.

# The options that every command has which asks the daemon.
_dpctl_common='--json --socket --timeout --help'

_dpctl_options()
{
    case $1 in
        '') echo "$_dpctl_common --version" ;;
        doctor) echo "$_dpctl_common --all --probe --yes" ;;
        status) echo "$_dpctl_common --follow --wait --drive --quiet" ;;
        io | events) echo "$_dpctl_common --follow" ;;
        trace) echo "$_dpctl_common --follow --incidents --incident --station --drive --service --bad --stop-on --decode --gsd --profiles --write --linktype" ;;
        'tec set') echo "$_dpctl_common --station --yes" ;;
        top) echo "$_dpctl_common --every" ;;
        plot) echo "$_dpctl_common --last --svg --csv --station" ;;
        read) echo "$_dpctl_common --every --list --station" ;;
        write) echo "$_dpctl_common --station" ;;
        metrics) echo "$_dpctl_common --write" ;;
        reload) echo "$_dpctl_common --dry-run" ;;
        survey) echo "$_dpctl_common --tags --table --for --passes --resume" ;;
        tag) echo '--json --all --table --profile --profiles --help' ;;
        hex) echo '--json --help' ;;
        decode) echo '--json --as --profile --profiles --help' ;;
        'gsd check') echo '--strict --station --table --profiles --socket --json --help' ;;
        'gsd show') echo '--profile --profiles --table --json --help' ;;
        'gsd make') echo '--profile --profiles --table --mapping --in --out --in-out --list --demand --ident --max-tsdr --description
                          --model --output --force --json --help' ;;
        'gsd import') echo '--profile --profiles --table --output --force --json --help' ;;
        'gsd diff') echo '--profile --profiles --table --json --help' ;;
        'gsd configure') echo '--page --json --help' ;;
        'gsd types') echo '--output --brief --force --json --help' ;;
        gsd) echo '--help' ;;
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
        [ "${COMP_WORDS[i]}" != --station ] || station=(--station "${COMP_WORDS[i + 1]}")
    done
    _dpctl_names read --list "${station[@]}"
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
        --socket | --table | --mapping | --page | --write | --svg) compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profiles | --output) compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profile) _dpctl_offer "$cur" < <(_dpctl_profiles); return ;;
        --linktype) mapfile -t COMPREPLY < <(compgen -W 'profibus user0' -- "$cur"); return ;;
        --as) mapfile -t COMPREPLY < <(compgen -W 'prm cfg diag' -- "$cur"); return ;;
        --station) _dpctl_offer "$cur" < <(_dpctl_stations); return ;;
        --timeout | --wait | --every | --last | --service | --stop-on | --tags | --for | --passes | --in | --out | --in-out | --ident | --max-tsdr | --description | --model) return ;;
    esac
    for ((i = 1; i < COMP_CWORD; i++)); do
        word=${COMP_WORDS[i]}
        case $word in
            --socket | --timeout | --wait | --service | --stop-on | --gsd | --profiles | --write | --linktype | --every | --last | --svg | --station | --tags | --table | --for | --passes) i=$((i + 1)) ;;
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
            '') words='status show io diag counters doctor trace bus top events plot metrics read write tec survey log-level reload tune tag hex decode gsd version' ;;
            read | plot) _dpctl_offer "$cur" < <(_dpctl_tags); return ;;
            log-level) words='debug info' ;;
            status | show | io | top | events | diag | doctor | survey) _dpctl_offer "$cur" < <(_dpctl_stations); return ;;
            tec) words='set' ;;
            'tec set') words='TYPE ADDRESS EXT_DIAGNOSTIC INT_DIAG_SELECT RIDE_THROUGH UNUSED_1' ;;
            gsd) words='check show make import diff configure types' ;;
            tune | 'gsd check' | 'gsd show' | 'gsd import' | 'gsd diff') compopt -o filenames 2>/dev/null
                mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        esac
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}
complete -F _dpctl dpctl
