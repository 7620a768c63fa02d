# SPDX-License-Identifier: Apache-2.0
# Bash completion of dpslaved.

_dpslaved()
{
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
    compopt -o filenames 2>/dev/null
    case $prev in
        --config) mapfile -t COMPREPLY < <(compgen -f -- "$cur"); return ;;
        --profiles) mapfile -t COMPREPLY < <(compgen -d -- "$cur"); return ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W '--config --profiles --check --is-configured --release --version --help' -- "$cur")
}
complete -F _dpslaved dpslaved
