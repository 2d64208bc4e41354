#!/usr/bin/env bash
# cli_man.sh PROGRAM ROOT: a manual page for every command, with the lists of its --help, as ./dev man makes them, and
# its examples.
set -euo pipefail
program=$1 root=$2
folder=$root/docs/man
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

bad=0
complain() {
    printf 'cli_man: %s\n' "$*" >&2
    bad=1
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
((${#commands[@]} >= 15)) || complain "--help names ${#commands[@]} commands"
for command in "${commands[@]}"; do
    page=$folder/pointspec-$command.1
    [[ -f $page ]] || { complain "$page is not there"; continue; }
    grep -qxF ".\\\" ./dev man: $command --help, Options" "$page" || complain "$page has no options made by ./dev man"
    if "$program" help "$command" fields >"$scratch/fields" 2>&1; then
        for list in Columns Header Arrays State; do
            ! grep -qx "$list:" "$scratch/fields" || grep -qxF ".\\\" ./dev man: help $command fields, $list" "$page" || complain "$page has no $list made by ./dev man"
        done
    fi
    missing=$("$program" "$command" --help | lacks_examples "$page")
    [[ -z $missing ]] || complain "$page lacks the example: $missing"
    # The tests run the two examples of --help, so a page must have no others.
    (($(examples_of_page "$page" | wc -l) == 2)) || complain "$page: examples that are not in --help"
done
missing=$("$program" --help | lacks_examples "$folder/pointspec.1")
[[ -z $missing ]] || complain "pointspec.1 lacks the example: $missing"
for list in '--help, Commands' 'sample --help, Samplers'; do
    grep -qxF ".\\\" ./dev man: $list" "$folder/pointspec.1" || complain "pointspec.1 does not have the list of $list"
done

for page in "$folder"/*.1; do
    command=$(basename "$page" .1)
    command=${command#pointspec} command=${command#-}
    [[ -z $command || " ${commands[*]} " == *" $command "* ]] || complain "$page is of no command"
    "$root/scripts/man_lists.sh" "$program" "$page" >"$scratch/page" || complain "$page has no list that can be made"
    diff --label "$page" --label "./dev man" -u "$page" "$scratch/page" >&2 || complain "$page is not what ./dev man makes"
    if command -v groff >/dev/null; then
        said=$(groff -mdoc -Tascii -ww -z "$page" 2>&1)
        [[ -z $said ]] || complain "$page: $said"
    fi
done
(cd "$root" && scripts/man_lists.sh "$program" docs/user/fields.md | diff -u docs/user/fields.md - >&2) ||
    complain "docs/user/fields.md is not what ./dev man makes"
exit $bad
