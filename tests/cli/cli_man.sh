#!/usr/bin/env bash
# cli_man.sh PROGRAM FOLDER: the man pages in FOLDER agree with the program: a page for every
# command, with exactly the options and values of its --help, and its examples.
set -euo pipefail
program=$1 folder=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

bad=0
complain() {
    printf 'cli_man: %s\n' "$*" >&2
    bad=1
}
# "-n, --points N", one line per option
options_of_help() { # COMMAND
    "$program" "$1" --help | sed -nE 's/^  (-., |    )(--[^ ]+( [^ ]+)?)(  .*)?$/\1\2/p' |
        sed 's/^ *//' | sort
}
options_of_page() { # PAGE
    sed -nE '/^\.It Fl/ { s/^\.It //; s/ , /, /; s/Fl -/--/g; s/Fl /-/g; s/Ar //; p }' "$1" | sort
}
examples_of_page() { # PAGE
    awk '/^\.Sh /{ on = /EXAMPLES/ } on && !/^\./' "$1"
}
lacks_examples() { # PAGE, with the text of a --help on standard input
    local text example
    text=$(sed 's/\\-/-/g; s/\\e/\\/g' "$1")
    tail -n 2 | while IFS= read -r example; do
        grep -qxF -e "${example#  }" <<<"$text" || echo "${example#  }"
    done
}

mapfile -t commands < <("$program" --help |
    awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }')
for command in "${commands[@]}"; do
    page=$folder/pointspec-$command.1
    [[ -f $page ]] || { complain "$page is not there"; continue; }
    options_of_help "$command" >"$scratch/help"
    options_of_page "$page" >"$scratch/page"
    [[ -s $scratch/help ]] || complain "no options in $command --help"
    diff --label "$command --help" --label "$page" -u "$scratch/help" "$scratch/page" >&2 ||
        complain "$page: other options than --help"
    missing=$("$program" "$command" --help | lacks_examples "$page")
    [[ -z $missing ]] || complain "$page lacks the example: $missing"
    # The tests run the two examples of --help, so a page must have no others.
    (($(examples_of_page "$page" | wc -l) == 2)) || complain "$page: examples that are not in --help"
    grep -q "^\.Xr pointspec-$command 1" "$folder/pointspec.1" ||
        complain "pointspec.1 does not name $command"
done
missing=$("$program" --help | lacks_examples "$folder/pointspec.1")
[[ -z $missing ]] || complain "pointspec.1 lacks the example: $missing"
for sampler in $("$program" sample --help |
    awk '/^Samplers/ { on = 1; next } !NF { on = 0 } on && /^  [a-z]/ { print $1 }'); do
    grep -q "^\.Cm white.* $sampler\b\|^\.Cm $sampler\b" "$folder/pointspec.1" ||
        complain "pointspec.1 does not name the sampler $sampler"
done

for page in "$folder"/*.1; do
    command=$(basename "$page" .1)
    command=${command#pointspec} command=${command#-}
    [[ -z $command || " ${commands[*]} " == *" $command "* ]] || complain "$page is of no command"
    if command -v groff >/dev/null; then
        said=$(groff -mdoc -Tascii -ww -z "$page" 2>&1)
        [[ -z $said ]] || complain "$page: $said"
    fi
done
exit $bad
