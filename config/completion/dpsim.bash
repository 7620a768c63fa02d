# SPDX-License-Identifier: Apache-2.0
# Bash completion of dpsim.

_dpsim()
{
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=''
    [ "$COMP_CWORD" -gt 1 ] || command=''
    case $prev in
        --a | --b | --port | --table | --script | --drive-port | --gsd) compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profile) words='590 584s 620 590plus 584sv 605 690plus 2408f 2404f' ;;
        --mnemonics) words='590plus ac pno' ;;
        --family) words='option-board technology-box controller' ;;
        --baud) words='9600 19200 45450 93750 187500 500000 1500000' ;;
        --bits) words='10 11' ;;
        --programs) words='0 1 4' ;;
        *)
            case $command in
                '') words='line drive master replay --help --version' ;;
                line) words='--baud --bits --a --b --any-rate --errors --delay --seed --log-a --log-b --help' ;;
                drive) words='--profile --port --baud --unit --table --mnemonics --turnaround --programs --parity --fault --log --help' ;;
                master) words='--port --baud --master --slave --gsd --modules --family --ident --prm --tags --prm-length --cfg --no-demand
                               --watchdog --no-watchdog --min-tsdr --group --no-sync-freeze --cycle --slot --retries
                               --others --sd3 --script --help' ;;
                replay) words='--port --baud --drive-port --line --drive-baud --fast --retries --slot --help'
                    [ "${cur:0:1}" = - ] || { compopt -o filenames 2>/dev/null
                        mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return; } ;;
            esac
            ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}
complete -F _dpsim dpsim
