#!/usr/bin/env bash
# mutate.sh [PART...]: applies the patches of this folder, or those with one of these parts in their names, one by one to a
# copy of the tree, and builds and runs the tests that each of them names: one must fail, or nobody would find that mistake.
# Exit code 1 where more than two of all, or one of those asked for, are missed, or a patch does not apply or compile.
# What git does not know yet is not copied.
# mutate.sh --check: every patch applies, and the tests that it names are there.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
export GIT_CEILING_DIRECTORIES=${PWD%/*} # this tree is no part of another
root=$PWD
source=$root/build/mutate/source
log=$root/build/mutate/log
most_missed=2

field() { # NAME PATCH: of the lines before the patch itself
    sed -n "/^---/q; s/^$1: //p" "$2"
}
test_source() { # TEST
    find tests -name "test_$1.c" -o -name "$1.sh"
}
check() { # PATCH...
    local patch name bad=0
    for patch in "$@"; do
        git apply --check "$patch" || bad=1
        for name in $(field Tests "$patch"); do
            [[ -n $(test_source "$name") ]] || { echo "$patch: there is no test $name" >&2; bad=1; }
        done
        [[ -n $(field Tests "$patch") && -n $(field Breaks "$patch") ]] || { echo "$patch: no Tests: or no Breaks:" >&2; bad=1; }
    done
    return $bad
}

# ---- the copy, its builds and tests ----
in_copy() { # GIT COMMAND: never in this tree, whatever becomes of the copy
    git -C "$source" --git-dir="$source/.git" --work-tree="$source" "$@"
}
copy() {
    local commit
    commit=$(git -c user.name=mutate -c user.email=mutate@localhost stash create) # empty: as committed
    commit=${commit:-$(git rev-parse HEAD)}
    if ! in_copy cat-file -e "$commit" 2>/dev/null; then # none yet, or of another checkout
        rm -rf "$source"
        git clone --quiet --shared --no-checkout . "$source"
    fi
    in_copy checkout --quiet --force --detach "$commit"
    # Mutations may leave something unused. Kernels are compiled once for this and all other builds.
    (cd "$source" && scripts/configure.sh dev -DPOINTSPEC_WERROR=OFF -DPOINTSPEC_BUILD_BENCH=OFF \
        -DPOINTSPEC_TEST_CACHE="$root/build/pocl-cache")
}
target() { # TEST: its program is its own, or that of its room (tests/CMakeLists.txt)
    local file room
    file=$(test_source "$1")
    room=${file#tests/}
    room=${room%/*}
    if [[ $file == *.sh ]]; then
        echo pointspec_program
    elif grep -q "^test_$1:" <<<"$targets"; then
        echo "test_$1"
    else
        echo "tests_${room//\//_}"
    fi
}
build() { # TEST...
    local name programs=()
    for name in "$@"; do programs+=("$(target "$name")"); done
    cmake --build "$source/build/dev" --parallel "${JOBS:-$(nproc)}" --target "${programs[@]}" >"$log" 2>&1
}
run() { # TEST...
    local IFS='|'
    ctest --test-dir "$source/build/dev" --no-tests=error --parallel "${JOBS:-$(nproc)}" -R "^($*)\$" >"$log" 2>&1
}
find_mistake() { # PATCH: the test that fails, or a verdict, is in $found
    local name names
    found='NOT FOUND'
    read -r -a names <<<"$(field Tests "$1")"
    in_copy checkout --quiet --force -- .
    if ! in_copy apply "$root/$1"; then
        found='DOES NOT APPLY'
    elif ! build "${names[@]}"; then
        found='DOES NOT COMPILE'
    else
        for name in "${names[@]}"; do
            run "$name" || { found=$name && return; }
        done
    fi
}

mapfile -t patches < <(find tests/mutations -name '*.patch' | sort)
if [[ ${1-} == --check ]]; then
    check "${patches[@]}"
    exit
fi
if (($#)); then
    most_missed=0
    mapfile -t patches < <(printf '%s\n' "${patches[@]}" | grep -F "$(printf '%s\n' "$@")")
fi
((${#patches[@]})) || { echo "mutate: no patch has $* in its name" >&2; exit 2; }
check "${patches[@]}"
mkdir -p build/mutate
copy
targets=$(ninja -C "$source/build/dev" -t targets all)
mapfile -t all < <(for patch in "${patches[@]}"; do field Tests "$patch" | tr ' ' '\n'; done | sort -u)
echo "mutate: ${#patches[@]} patches, ${#all[@]} tests, which pass before" >&2
if ! { build "${all[@]}" && run "${all[@]}"; }; then
    cat "$log" >&2
    exit 1
fi

missed=0 broken=0
printf '%-28s %-12s %-24s %7s\n' mutation room 'found by' seconds
for patch in "${patches[@]}"; do
    name=${patch#tests/mutations/} begin=$SECONDS
    find_mistake "$patch"
    printf '%-28s %-12s %-24s %7d\n' "$(basename "$name" .patch)" "${name%/*}" "$found" $((SECONDS - begin))
    case $found in
        'NOT FOUND') missed=$((missed + 1)) ;;
        DOES*) broken=$((broken + 1)) ;;
    esac
done
echo "mutate: $((${#patches[@]} - missed - broken)) of ${#patches[@]} found, $broken broken" >&2
((missed <= most_missed && broken == 0))
