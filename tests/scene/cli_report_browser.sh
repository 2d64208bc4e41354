#!/usr/bin/env bash
# cli_report_browser.sh PROGRAM: a page of pointspec report in a browser without a window (Debian's chromium): its pictures
# are there, nothing is loaded from elsewhere, nothing is wider than the window, and it prints on two sheets. Skipped (77)
# without a device, gnuplot or chromium.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" report "$1"
for needed in chromium gnuplot; do
    command -v $needed >/dev/null || exit 77
done
"$program" devices >out 2>err && grep -q '^[0-9]' out || exit 77

browse() { # OPTIONS PAGE: without the user's settings
    chromium --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/browser" --window-size=1300,900 "$@" 2>log
}
check_page() { # PAGE PICTURES
    local dom loaded
    # a script at the end says what the browser has made of the page
    sed 's|</body></html>|<script>document.title = [...document.images, ...document.querySelectorAll("svg")]\
        .filter(x => x.getBoundingClientRect().width > 100).length + " " +\
        (document.documentElement.scrollWidth <= 1300) + " " + performance.getEntriesByType("resource").filter(x => !x.name.startsWith("data:")).length</script></body></html>|' \
        "$1" >"tried-$1"
    dom=$(browse --dump-dom "file://$PWD/tried-$1") || complain "$1: $(tail -n 3 log)"
    loaded=$(grep -oE '<title>[^<]*' <<<"$dom" | head -1)
    [[ $loaded == "<title>$2 true 0" ]] || complain "$1: pictures, fits, loads: $loaded"
    browse --print-to-pdf="$1.pdf" "file://$PWD/$1" || complain "$1: $(tail -n 3 log)"
    [[ $(grep -acE '/Type */Page( |$|/)' "$1.pdf") == [12] ]] || complain "$1: $(grep -acE '/Type */Page( |$|/)' "$1.pdf") sheets"
}
"$program" sample --sampler jittered -n 256 -m 9 -o mine.txt
runs 0 mine.txt -o mine.html
check_page mine.html 5
"$program" sample --sampler fibonacci -n 192 -o sphere.txt
runs 0 --domain sphere sphere.txt -o sphere.html
check_page sphere.html 4
finish
