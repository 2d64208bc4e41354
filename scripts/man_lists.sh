#!/usr/bin/env bash
# man_lists.sh PROGRAM PAGE: the manual page on standard output, with its lists as --help has them. A list stands between
#   .\" ./dev man: power --help, Options
#   .\" end
# which name the words that PROGRAM is given, and how the title of the list begins there.
# Or docs/user/fields.md, whose tables are all of "help KIND fields" of every kind of answer.
set -euo pipefail
export POINTSPEC_PROGRAM=$1 LC_ALL=C

print_fields() { # PAGE
    local group kind kinds
    # Commands that give no answers have none.
    mapfile -t kinds < <("$POINTSPEC_PROGRAM" --help | awk '/^Commands:/ { on = 1; next } !NF { on = 0 } on { print $1 }')
    sed '/^## /,$d' "$1" | sed '$d' # without the empty line before the first heading
    for group in Columns Header Arrays State; do
        printf '\n## %s\n\n| name | of | |\n|---|---|---|\n' $group
        for kind in "${kinds[@]}"; do
            { "$POINTSPEC_PROGRAM" help "$kind" fields 2>/dev/null || true; } | awk -v kind="$kind" -v group="$group:" '
                function flush() { if (name != "") print name "\t" kind "\t" text; name = text = "" }
                /^[A-Z].*:$/ || /^$/ { flush(); inside = $0 == group; next }
                inside && match($0, /[^ ]/) <= 20 { # a term, and what stands beside it
                    flush()
                    name = substr($0, 3)
                    sub(/  .*/, "", name)
                    text = substr($0, length(name) + 3)
                    sub(/^ +/, "", text)
                    next
                }
                inside { sub(/^ +/, ""); text = text (text == "" ? "" : " ") $0 }
                END { flush() }'
        done | awk -F '\t' '
            !(($1, $3) in of) { row[++num] = $1 SUBSEP $3; of[$1, $3] = $2; next }
            { of[$1, $3] = of[$1, $3] ", " $2 }
            END {
                for (i = 1; i <= num; i++) {
                    split(row[i], part, SUBSEP)
                    gsub(/\|/, "\\|", part[2])
                    gsub(/</, "\\&lt;", part[2])
                    print "| `" part[1] "` | " of[row[i]] " | " part[2] " |"
                }
            }'
    done
}
[[ $2 != *.md ]] || { print_fields "$2" && exit; }

awk '
# A word of --help in roff: a hyphen stands between letters, all else is a minus sign.
function spelt(word) {
    gsub(/\\/, "\\e", word)
    gsub(/-/, "\\-", word)
    while (match(word, /[A-Za-z]\\-[A-Za-z]/)) word = substr(word, 1, RSTART) substr(word, RSTART + 2)
    gsub(/\^/, "\\(ha", word)
    gsub(/~/, "\\(ti", word)
    return word
}
function print_text(text,   words, num, i, line) {
    num = split(text, words, " ")
    for (i = 1; i <= num; i++) {
        if (length(line) + length(words[i]) > 98) { print line; line = "" }
        if (line == "" && words[i] ~ /^[.\047]/) line = "\\&" # or roff takes it for its own
        line = line (line == "" || line == "\\&" ? "" : " ") spelt(words[i])
    }
    if (line != "") print line
}
# "-n, --points N" is .It Fl n , Fl -points Ar N
function print_item(term, text, title,   words, num, i, item) {
    num = split(term, words, " ")
    for (i = 1; i <= num; i++) {
        if (sub(/^-/, "", words[i])) item = item (sub(/,$/, "", words[i]) ? " Fl " words[i] " ," : " Fl " words[i])
        else if (title ~ /^Commands/) item = " Xr pointspec-" words[i] " 1"
        else item = item (i == 1 ? " Cm " : " Ar ") (term ~ /^-/ ? words[i] : spelt(words[i]))
    }
    print ".It" item
    print_text(text)
}
function fail(what) {
    print FILENAME ": " what | "cat >&2"
    exit failed = 1
}
# Texts begin in column 30, or go on there.
function print_lists(arguments, name,   help, line, goes_on, title, term, text, at, num) {
    help = "\"$POINTSPEC_PROGRAM\" " arguments
    while ((help | getline line) > 0) {
        goes_on = match(line, /[^ ]/) > 20
        if (term != "" && !goes_on) { print_item(term, text, title); term = text = "" }
        if (title != "" && line == "") {
            print ".El"
            if (name == "Options") print ".Pp\n.Xr pointspec 1\nhas the samplers, and more on what several commands take."
            title = ""
        }
        if (line ~ /^[A-Z].*:$/ && index(line, name) == 1) {
            title = line
            num++
            # These stand under a heading of the page.
            if (name !~ /^(Options|Columns|Header|Arrays|State)$/) print ".Pp\n" title
            print ".Bl -tag -width Ds" (name == "Options" ? "" : " -compact")
        } else if (title != "" && goes_on) {
            text = text " " line
        } else if (title != "") {
            sub(/^ +/, "", line)
            at = index(line, "  ") # behind the term
            term = at == 0 ? line : substr(line, 1, at - 1)
            text = at == 0 ? "" : substr(line, at)
        }
    }
    close(help)
    if (term != "") print_item(term, text, title)
    if (title != "") print ".El" # the list was the last of the output
    if (num == 0) fail("no list " name " in the output of " arguments)
}
/^\.\\" end$/ { inside = 0 }
!inside
/^\.\\" \.\/dev man: / {
    inside = 1
    sub(/^[^:]*: /, "")
    print_lists(substr($0, 1, index($0, ",") - 1), substr($0, index($0, ", ") + 2))
}
END { if (inside && !failed) fail("a list without an end") }' "$2"
