#!/usr/bin/env bash
# cli_help.sh PROGRAM: the help of a command is about it alone: no word of other commands stands among its options.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"

options() { "$program" "$1" --help | sed -n '/^Options:/,/^$/p'; }
mapfile -t commands < <("$program" --help | awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }')
for command in "${commands[@]}"; do
    options "$command" >shown
    for other in "${commands[@]}"; do
        ! grep -qE "(^|[^a-z-])$other: " shown || complain "$command --help says what holds for $other: $(grep "$other: " shown)"
    done
    ! grep -q '[{}]' shown || complain "$command --help has braces: $(grep '[{}]' shown)"
    ((${#commands[@]} > 12 && $(wc -L <shown) < 80)) || complain "$command --help is too wide"
done
# refrains COMMAND WORD...
refrains() {
    local command=$1 word
    shift
    options "$command" | tr -s ' \n' ' ' >shown
    for word in "$@"; do
        ! grep -qiE "$word" shown || complain "$command --help speaks of $word: $(grep -oiE ".{40}$word" shown)"
    done
}
# tells COMMAND TEXT...
tells() {
    local command=$1 text
    shift
    options "$command" | tr -s ' \n' ' ' >shown
    for text in "$@"; do
        [[ $(<shown) == *"$text"* ]] || complain "$command --help does not say \"$text\""
    done
}
refrains power sphere degree theta lon-lat c_lm 'Q\(l\)' 'as saved' lobe
refrains angular ' ring' '\(2K\+1\)' 'S\(k\)' 'as saved' 'E\^2'
refrains truncation sampler realization ring
refrains light sampler realization ring brdf
refrains sample 'as saved' ring
tells power '(default 1024)' '(default 1)' 'S relative to white noise (default 1e-6)' 'S(k) = sum w' 'detected): utk-text' 'x,y,mass=xyw: xy, xyw '
tells check '(default as saved)' '(default as saved, or 128)' '(default 2 N^(1/d))' 'on the torus)'
tells pairs 'Q(l) over (sum |w|)^2 (default 1e-6)'
tells quadrature 'E^2 over c (sum |w|)^2 (default 1e-10)' 'that of --brdf)' 'at most ceil(4 sqrt N))'
tells truncation '(default 20)'
tells light '(default 64)' 'of powers where -l is given, else of functions'
tells variance 'a sum over a ball instead of a box'
tells angular 'c_lm = sum w Y_lm' 'relative standard error of every degree X'
checked=${#commands[@]}
finish
