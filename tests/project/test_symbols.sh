#!/usr/bin/env bash
# test_symbols.sh SHARED STATIC JOINED: what the library's files define. Shared and static one show pspec_
# alone, their object files have pspec_ and ps_, and none holds data that can change: no global state.
set -euo pipefail
shared=$1 static=$2 joined=$3
bad=0
complain() { # TITLE LINES
    [[ -z $2 ]] || {
        printf '%s:\n%s\n' "$1" "$2" >&2
        bad=1
    }
}

exported=$(nm -D --defined-only "$shared" | awk '{ print $NF }')
[[ -n $exported ]] || complain "exports" "nothing at all"
complain "exported without the prefix pspec_" "$(grep -v '^pspec_' <<<"$exported" || true)"

shown=$(nm -g --defined-only "$static" | awk 'NF == 3 { print $NF }')
complain "global in the static library, but not exported by the shared one, or the other way round" \
    "$(comm -3 <(sort <<<"$shown") <(sort <<<"$exported"))"

defined=$(nm -g --defined-only "$joined" | awk 'NF == 3 { print $NF }')
[[ $defined == *ps_fail* ]] || complain "object files" "no name of the library's own"
complain "global without the prefix pspec_ or ps_" \
    "$(grep -vE '^(pspec|ps)_' <<<"$defined" || true)"

# objdump -t: address, 7 flag characters, section, size, name. Constant tables with addresses in them
# lie in .data.rel.ro, which the loader makes read-only. One mutex is the exception (host/base/process/process_lock.h).
changeable=$(objdump -t "$static" | awk '
    / file format / { member = $1; next }
    {
        section = substr($0, 26); sub(/[ \t].*/, "", section)
        if (section ~ /^(\.data|\.bss|\.tdata|\.tbss|\*COM\*)/ && section !~ /^\.data\.rel\.ro/ &&
            $NF != section && substr($0, 18, 7) !~ /d/) print "    " member " " section " " $NF
    }')
exception=' .bss process_lock$'
complain "data that can change" "$(grep -v "$exception" <<<"$changeable" || true)"
[[ $(grep -c "$exception" <<<"$changeable") == 1 ]] || complain "the lock of the process is not there once" "$changeable"

# What the headers declare is what the library exports.
headers=("$(dirname "${BASH_SOURCE[0]}")"/../../host/include/pointspec/*.h)
declared=$(grep -hA1 '^PSPEC_EXPORT' "${headers[@]}" | grep -oE 'pspec_[a-z0-9_]+\(' | tr -d '(' | sort -u)
complain "declared, but not exported, or exported, but not declared" \
    "$(comm -3 <(sort -u <<<"$exported") - <<<"$declared")"
exit $bad
