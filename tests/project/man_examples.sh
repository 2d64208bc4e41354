#!/usr/bin/env bash
# man_examples.sh PAGE FOLDER: the example programs of a manual page (literal displays that have a main) as
# FOLDER/page_1.c, page_2.c, ... Roff's escapes for backslash, minus and leading dots are undone.
set -euo pipefail
page=$1 folder=$2
mkdir -p "$folder"
awk -v folder="$folder" '
    /^\.Bd -literal/ { inside = 1; text = ""; next }
    /^\.Ed/ {
        if (inside && text ~ /int main\(/) printf "%s", text >(folder "/page_" (++num) ".c")
        inside = 0
    }
    inside { text = text $0 "\n" }' "$page"
sed -i 's/\\&//g; s/\\-/-/g; s/\\(ha/^/g; s/\\(aq/'"'"'/g; s/\\e/\\/g' "$folder"/page_*.c
