#!/usr/bin/env bash
# stages.sh SOURCE_DIR: scripts/stages.sh runs two stages at a time and no more, all of them also after one has failed,
# prints each whole, with its times, and ends what hangs; .ci/run has every stage of ./dev, and its samples are those of
# the commit.
set -euo pipefail
source_dir=$1
stages=$source_dir/scripts/stages.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
fail() { printf 'stages: %s\n' "$*" >&2; exit 1; }
# Only what hangs takes this long.
patience=250

# The first two end only where each sees the other; the third begins when one of them has ended.
mkfifo there back
cat >first <<'END'
echo >there && read -r _ <back && echo whole-of-first && touch ended
END
cat >second <<'END'
read -r _ <there && echo half-of-second && echo >back && touch ended && echo other-half && exit 3
END
code=0
"$stages" 2 $patience logs >out <<'END' || code=$?
# a comment
first bash first

second bash second
third test -e ended
END
[[ $code == 1 ]] || fail "a stage failed, and the exit code is $code: $(<out)"
grep -qE '^first +[0-9]+ +[0-9]+  ok$' out || fail "first: $(<out)"
grep -qE '^second +[0-9]+ +[0-9]+  FAILED, exit code 3$' out || fail "second: $(<out)"
grep -qE '^third +[0-9]+ +[0-9]+  ok$' out || fail "third: $(<out)"
grep -qE '^all +[0-9]+ +[0-9]+$' out || fail "all: $(<out)"
grep -A 1 '^half-of-second$' out | grep -qx other-half || fail "outputs are mixed: $(<out)"

# A stage gives up its place before the next has one, so that one at a time is one after the other.
code=0
printf '%s\n' 'a touch a' 'b rm a' 'c test ! -e a' | "$stages" 1 $patience logs >out || code=$?
[[ $code == 0 ]] || fail "one at a time: $(<out)"

# What computes has used a processor.
echo "awk 'BEGIN { for (i = 0; i < 1e8; i++) sum += i }'" >busy
echo "busy bash busy" | "$stages" 1 $patience logs >out || fail "busy: $(<out)"
grep -qE '^busy +[0-9]+ +[1-9][0-9]*  ok$' out || fail "no time of processors: $(<out)"

# What hangs is ended, and what it started, too.
mkfifo never
code=0
printf '%s\n' "hangs bash -c read<never" 'after true' | "$stages" 1 1 logs >out || code=$?
[[ $code == 1 ]] || fail "what hangs: exit code $code: $(<out)"
grep -qE '^hangs .* FAILED, took more than 1 s$' out || fail "what hangs: $(<out)"
grep -qE '^after .* ok$' out || fail "behind what hangs: $(<out)"

# Every check of ./dev is a stage, and a sample says how it is repeated.
for command in test sweep lint gpu faults sanitize tsan oclgrind fuzz demo; do
    grep -qE "^[a-z]+ +(env [^ ]+ )?\./dev $command( |\$)" "$source_dir/.ci/run" || fail ".ci/run lacks ./dev $command"
done
# shellcheck disable=SC2016 # as it stands there
[[ $(grep -cE '^(faults|fuzz) .*--seed \$seed' "$source_dir/.ci/run") == 2 ]] || fail "a sample without the commit's seed"
echo "stages: as they should be"
