#!/usr/bin/env bash
# update_tables.sh BUILD_DIR [TABLE...]: fills the tables of docs/*/*.md with what the
# programs of BUILD_DIR print (build/dev has benchmarks and tests alike). A table stands between a
# line "<!-- table: NAME -->" and a line "<!-- end -->"; NAME is a function table_NAME below. Times want
# a quiet machine. Without TABLE all are made; a program that is not built leaves its table alone.
set -euo pipefail
docs=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/..")
pages=("$docs"/*/*.md)
(($# >= 1)) || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
build=$(realpath "$1")
shift
kernels=$docs/../kernels
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

need() { # PROGRAM
    [[ -x $build/$1 ]] || { echo "update_tables: no $1 in $build" >&2; return 1; }
}

bench() { # NAME
    need "bench/bench_$1" && "$build/bench/bench_$1"
}
table_bench_torus() { bench torus; }
table_bench_nufft() { bench nufft; }
table_bench_sphere() { bench sphere; }
table_bench_sphere_batches() { bench sphere_batches; }
# The problems of the bench one by one would be a page of their own: those that went wrong, and the sum.
table_bench_choice() { bench choice | awk 'NR == 1 || /^#/ || $NF > 1.3'; }
# On the clock, so a busy machine matters.
table_bench_scenes() {
    need pointspec && "$build/pointspec" bench --scenes "$docs"/scenes/{diffuse,glossy,radial_mean}.yaml |
        awk -F, '!/^#/ { n = split($1, part, "/"); printf "%-18s %-8s %9s %10s %15s %8s %11s %s\n", part[n], $2, $3,
            $4 + 0 ? sprintf("%.2f", $4) : $4, $5 + 0 ? sprintf("%.2f", $5) : $5, $6 + 0 ? sprintf("%.1f", $6) : $6,
            $7 + 0 ? sprintf("%.2f", $7) : $7, $8 }'
}
# Ten minutes; divided by a yardstick, yet a quiet machine says more. All questions would be a page of their own: those that
# are off, and the sum.
table_bench_plan() { bench plan | awk '/^#/ || $1 == "planned" || / !/'; }
# No GPU is needed.
table_gpu_plan() { need pointspec && "$docs/../bench/gpu/predict.sh" "$build/pointspec"; }
table_bench_reading() { bench reading; }
table_bench_errors() { bench errors; }
table_bench_memory() { bench memory; }
table_bench_library() { bench library; }
# CPU time, so that a busy machine matters less.
bench_pairs() { # PART
    need bench/bench_pairs && "$build/bench/bench_pairs" "$1" | tail -n +2
}
table_bench_pairs() { bench_pairs direct; }
table_bench_pairs_histogram() { bench_pairs histogram; }
table_bench_pairs_ways() { bench_pairs ways; }
# Also for the picture of make_figures.sh.
table_pairs_routes() {
    mkdir -p "$docs/../bench-output"
    bench_pairs routes >"$docs/../bench-output/pairs_routes.txt" &&
        "$docs/scripts/pairs_routes.sh" table "$docs/../bench-output/pairs_routes.txt"
}
# CPU time, and the clock beside it.
table_bench_integrands() { bench integrands; }
table_bench_occlusion() {
    need bench/bench_occlusion && "$build/bench/bench_occlusion" "$docs/scenes/p15/box.obj"
}
# Some N of each sampler, and the seconds of all.
some_of_bench_variance() {
    awk '/^#/ || $1 == "sampler" { print; next }
         $2 ~ /^(16|64|256|4096|16384)$/
         { num += $1 != last; last = names[num] = $1; a[num] += $7; b[num] += $11; c[num] += $17 }
         END { for (i = 1; i <= num; i++)
                   printf "%-16s all N: predicted in %.2f s, measured in %.2f s (%.1f times) and %.2f s (%.1f times)\n",
                       names[i], a[i], b[i], b[i] / a[i], c[i], c[i] / a[i] }'
}
table_bench_variance() { bench variance | some_of_bench_variance; }
table_bench_variance_dear() {
    need bench/bench_variance && "$build/bench/bench_variance" disk:radius=0.25 64 bnot fpo | some_of_bench_variance
}
table_bench_weights() { bench weights; }
bench_blue_noise() { # MODE
    need bench/bench_blue_noise && "$build/bench/bench_blue_noise" "$1"
}
table_bench_blue_noise() { bench_blue_noise cost; }
# A quarter of an hour, of which FPO takes most.
table_bench_blue_noise_hours() { bench_blue_noise hours; }
# Ten minutes; UTK_CLONE is a clone of UTK (bench/blue_noise/peers.sh).
table_bench_blue_noise_peers() {
    [[ -n ${UTK_CLONE-} ]] || { echo "update_tables: UTK_CLONE names no clone" >&2; return 1; }
    need bench/bench_blue_noise && BUILD=$build "$docs/../bench/bench_blue_noise_peers.sh" "$UTK_CLONE"
}
bench_forces() { # TABLE
    need bench/bench_forces && "$build/bench/bench_forces" "$1"
}
# Four minutes of a processor; seconds of the first two want a quiet machine.
table_bench_forces_gaussian() { bench_forces gaussian; }
table_bench_forces_step() { bench_forces step; }
table_bench_forces_powers() { bench_forces powers; }
table_bench_forces_smoothings() { bench_forces smoothings; }
table_bench_forces_near() { bench_forces near; }
# Four minutes; POINTSPEC_TEST_DATA as in ./dev.
table_published_sets() {
    need pointspec &&
        "$docs/scripts/published_sets.sh" "$build/pointspec" "${POINTSPEC_TEST_DATA:-$docs/../../shared/data}" 2>/dev/null
}
# Some minutes altogether; FPO takes most.
variance_table() { # NAME
    need pointspec && "$docs/scripts/variance_tables.sh" "$build/pointspec" "$1"
}
table_variance_laws() { variance_table laws; }
table_variance_scores() { variance_table scores; }
table_variance_crossovers() { variance_table crossovers; }
table_needs_times() { need pointspec && "$docs/scripts/needs_times.sh" "$build/pointspec"; }

# Rows on the Pareto fronts of pointspec bench. Also for the picture of make_figures.sh, which wants the same run.
table_bench_fronts() {
    need pointspec || return 1
    mkdir -p "$docs/../bench-output"
    POINTSPEC_CACHE_DIR=$scratch/cache "$build/pointspec" bench --quiet -o "$scratch/bench.csv" --plot "$docs/../bench-output/bench.png" ||
        return 1
    awk -F, '
        /^# device: / { sub(/^# device: /, ""); print "# " $0 }
        /^# peak_flops_single: / { split($0, word, ": "); single = word[2] / 1e9 }
        /^# peak_flops_double: / { split($0, word, ": "); printf "# measured peak at the beginning %.0f GFLOP/s single, %.0f double\n", single, word[2] / 1e9 }
        /^case,/ { printf "%-13s %-16s %-9s %9s %12s %9s %12s %8s\n", "case", "engine", "precision", "tolerance", "us/R", "error", "points/s", "of peak" }
        !/^#/ && $12 == 1 {
            printf "%-13s %-16s %-9s %9.0e %12.2f %9.1e %12.3g %8s\n", $1, $2, $8, $3, $4 * 1e6, $5, $6, $7 == "" ? "-" : sprintf("%.2f", $7)
        }' "$scratch/bench.csv"
}

# A quarter of an hour each, less with PEERS_OPTIONS=--quick; they also write bench-output/peers.csv,
# peers_sphere.csv and peers_pairs.csv, which make_figures.sh draws.
peers() { # DOMAIN
    local options
    read -r -a options <<<"${PEERS_OPTIONS-}"
    need libpointspec.so && "$docs/../bench/bench_peers.sh" --build "$build" --domain "$1" "${options[@]}"
}
table_bench_peers() { peers torus; }
table_bench_peers_sphere() { peers sphere; }
table_bench_peers_pairs() { peers pairs; }

# What the last ./dev fuzz printed.
table_fuzzing() { cat "$docs/../fuzz-output/table.txt"; }

# The examples of docs/user/examples.md: the first rows of jittered sampling, a list, a plan from the first skip on.
power_rows() { # ARGUMENTS...
    "$build/pointspec" power --quiet "$@" | grep -v '^#'
}
table_jittered() {
    need pointspec || return 1
    power_rows --sampler jittered -n 1024 -m 1000 -k 64 | sed -n 1,4p
    echo ...
}
table_sphere() {
    need pointspec || return 1
    "$build/pointspec" angular --quiet --sampler healpix-jittered:nside=16 -m 1000 -l 256 |
        grep -v '^#' | sed -n 1,4p
    echo ...
}
# Microseconds of a realization, and the share of every kernel: what is left to gain, and where.
table_profile_sphere() {
    need pointspec || return 1
    printf '%-16s %-6s %10s %7s %7s %7s %7s\n' "N, L, R" tol us/R turns orders sum fold
    local case n degree sets tolerance
    for case in "256 64 4000" "1024 128 1000" "4096 256 200" "16384 512 48" "4096 2000 10" "4096 2000 1"; do
        read -r n degree sets <<<"$case"
        for tolerance in 1e-5 1e-12; do
            "$build/pointspec" angular --sampler white-sphere -n "$n" -l "$degree" -m "$sets" --tol "$tolerance" \
                --engine sphere_nufft --quiet --profile --no-self-check 2>&1 >"$scratch/profile.csv" |
                awk -v name="$n, $degree, $sets" -v tolerance="$tolerance" -v sets="$sets" '
                    /^sphere_/ { seconds[$1] = $3; sum += $3 }
                    function share(kernel) { return 100 * seconds["sphere_orders" kernel] / sum }
                    END { printf "%-16s %-6s %10.1f %6.0f%% %6.0f%% %6.0f%% %6.0f%%\n", name, tolerance,
                        1e6 * sum / sets, share("_turns"), share(""), share("_sum"), share("_fold") }'
        done
    done
}
table_list() {
    need pointspec || return 1
    printf '1 1 0\n0 7 7\n100000000 3 -5\n' >"$scratch/frequencies.txt"
    power_rows --sampler halton -n 1000 -d 3 --frequencies "$scratch/frequencies.txt"
}
table_plan() {
    need pointspec || return 1
    "$build/pointspec" plan power --sampler white -n 65536 -m 100 -k 256 | sed -n '/^# skip/,$p'
}

# What Marques et al. print beside what the program computes.
table_reproduction() { need pointspec && "$docs/scripts/reproduction.sh" "$build/pointspec" table; }

# The lines of the tolerance test. Its frequencies are, in the order of the lines of one shape, a grid
# with K = 12, 100 of |k_i| <= 1e6 and 100 of |k_i| <= 2^28.
tolerance() {
    need tests/test_tolerance && "$build/tests/test_tolerance" 2>&1 | grep ' slack '
}
table_tolerance() { tolerance; }

# The smallest slack, and the largest error with its bound, of every shape and precision.
table_tolerance_summary() {
    need tests/test_tolerance || return 1
    printf '%-15s %-9s %14s %14s %14s\n' shape precision "largest error" formula "smallest slack"
    tolerance | awk '{
        shape = substr($0, 1, 15)
        for (i = 1; i < NF; i++) if ($i == "error") at = i
        key = shape " " $(at - 1)
        if (!(key in slack)) order[++num] = key
        if (!(key in slack) || $(at + 5) + 0 < slack[key]) slack[key] = $(at + 5) + 0
        if ($(at + 1) + 0 > error[key] + 0) { error[key] = $(at + 1); formula[key] = $(at + 3) }
    }
    END {
        for (i = 1; i <= num; i++)
            printf "%-15s %-9s %14s %14s %14.2f\n", substr(order[i], 1, 15), substr(order[i], 17),
                error[order[i]], formula[order[i]], slack[order[i]]
    }'
}

# torus_nufft in tests/engines/torus/test_tolerance_sweep.c: error and bound at some tolerances, by kind of set.
table_tolerance_nufft() {
    need tests/test_tolerance_sweep || return 1
    "$build/tests/test_tolerance_sweep" 2>&1 | awk '
        /^torus_nufft .* tolerance .* bound / {
            precision = $2
            shape = substr($0, 21, 15)
            for (i = 1; i < NF; i++) if ($i == "tolerance") at = i
            if (precision == "single" ? $(at + 1) + 0 < 1e-7 : $(at + 1) + 0 > 1.1e-8 || $(at + 1) + 0 < 1e-13) next
            key = precision " " shape
            if (!(key in row)) order[++num] = key
            row[key] = row[key] sprintf("  %9s %9s", $(at + 3), $(at + 5))
            if (!(precision in head) || head[precision] !~ $(at + 1))
                head[precision] = head[precision] sprintf("  %9s %9s", $(at + 1), "bound")
        }
        END {
            for (i = 1; i <= num; i++) {
                precision = substr(order[i], 1, 6)
                if (precision != last) printf "%-22s%s\n", precision " --tol", head[precision]
                last = precision
                printf "%-22s%s\n", substr(order[i], 8), row[order[i]]
            }
        }'
}

# The smallest bound / error of every engine there, by kind of set.
table_slack_nufft() {
    need tests/test_tolerance_sweep || return 1
    "$build/tests/test_tolerance_sweep" 2>&1 | awk '
        /^torus_nufft .* smallest slack / {
            shape = substr($0, 25, 15)
            if (!(shape in seen)) order[++num] = shape
            seen[shape] = 1
            slack[shape " " $2 " " $3] = $NF
        }
        END {
            printf "%-15s %10s %7s %7s %14s %7s %7s\n", "smallest slack", "single d=1", "d=2", "d=3", "double d=1", "d=2", "d=3"
            for (i = 1; i <= num; i++) {
                at = order[i] " "
                printf "%-15s %10s %7s %7s %14s %7s %7s\n", order[i], slack[at "single d=1"], slack[at "single d=2"],
                    slack[at "single d=3"], slack[at "double d=1"], slack[at "double d=2"], slack[at "double d=3"]
            }
        }'
}

# The lines of the test of sphere_direct's error law.
table_sphere_direct() {
    need tests/test_sphere_error && "$build/tests/test_sphere_error" 2>&1 | grep ' slack '
}

# The smallest bound / error of an engine, by kind of set: a column for every block of the test's lines.
table_sphere_nufft() { sphere_sweep sphere_nufft; }
table_sphere_grid() { sphere_sweep sphere_grid; }
sphere_sweep() {
    need tests/test_sphere_nufft_sweep || return 1
    "$build/tests/test_sphere_nufft_sweep" 2>&1 | awk -v engine="$1" '
        / L=/ { is_own = $1 == engine; sub(/:$/, ""); if (is_own) block[++num_blocks] = $2 " " $3 " " $4; next }
        /^  [a-z]/ && is_own {
            kind = substr($0, 3, 15)
            if (!(kind in seen)) kinds[++num] = kind
            seen[kind] = 1
            slack[kind " " num_blocks] = $NF
        }
        END {
            printf "%-15s", "smallest slack"
            for (i = 1; i <= num_blocks; i++) printf " %20s", block[i]
            printf "\n"
            for (k = 1; k <= num; k++) {
                printf "%-15s", kinds[k]
                for (i = 1; i <= num_blocks; i++) printf " %20s", slack[kinds[k] " " i]
                printf "\n"
            }
        }'
}

# The smallest bound / error of pair sums, by engine and kind of set.
table_pairs_error() {
    need tests/test_pairs_error || return 1
    "$build/tests/test_pairs_error" 2>&1 | awk '
        / slack / {
            engine = $1 " " substr($2, 1, 1)
            for (i = 1; i < NF; i++) if ($i == "error") at = i
            kind = substr($0, 25, 12)
            if (!(engine in seen)) { seen[engine] = 1; engines[++num] = engine }
            if (!(kind in known)) { known[kind] = 1; kinds[++num_kinds] = kind }
            key = engine SUBSEP kind
            if (!(key in slack) || $(at + 5) + 0 < slack[key]) slack[key] = $(at + 5) + 0
        }
        END {
            printf "%-14s", "smallest slack"
            for (e = 1; e <= num; e++) printf " %17s", engines[e]
            printf "\n"
            for (k = 1; k <= num_kinds; k++) {
                printf "%-14s", kinds[k]
                for (e = 1; e <= num; e++) printf " %17.1f", slack[engines[e], kinds[k]]
                printf "\n"
            }
        }'
}

# kappa of wide lobes against integrals over rings, and what the reference's sets are off by.
table_quadrature_error() {
    need tests/test_representer && need tests/test_worst_case || return 1
    "$build/tests/test_representer" 2>&1 | grep 'kappa off by'
    "$build/tests/test_worst_case" 2>&1 | grep '^kappa .* E^2'
}

# Errors, bounds and verdicts of pointspec stress, the two precisions of an engine side by side.
table_stress() {
    need pointspec || return 1
    "$build/pointspec" stress --quiet >"$scratch/stress.csv" || true # failures are in the table
    awk -F, '
        /^#/ || /^case,/ { next }
        {
            key = $1 "," $2
            if (!(key in seen)) order[++num] = key
            seen[key] = 1
            number[key "," $3] = $4 == "" ? "        -         -" : sprintf("%9.2e %9.2e", $4, $5)
            bad[key] = bad[key] ($6 ~ /^pass/ ? "" : " " $3 " " $6)
            count[$6 ~ /^pass/ ? "pass" : $6 ~ /^fail/ ? "fail" : "skipped"]++
        }
        END {
            printf "%-21s %-16s %9s %9s   %9s %9s   %s\n", "case", "engine", "single", "bound", "double", "bound", "verdict"
            for (i = 1; i <= num; i++) {
                split(order[i], name, ",")
                single = number[order[i] ",single"]; double = number[order[i] ",double"]
                printf "%-21s %-16s %19s   %19s   %s\n", name[1], name[2], single == "" ? "-         -" : single,
                    double == "" ? "-         -" : double, bad[order[i]] == "" ? "pass" : substr(bad[order[i]], 2)
            }
            printf "%d pass, %d fail, %d skipped\n", count["pass"], count["fail"], count["skipped"]
        }' "$scratch/stress.csv"
}

# What the program does with every fault, by command line. FAULTS_ONLY=NAME[,NAME...] runs these command lines
# alone, for all take the better part of an hour; the other rows stay as they are on the page.
table_faults() {
    need tests/faults/pointspec_faults || return 1
    POCL_CACHE_DIR=$build/../pocl-cache "$docs/../tests/faults/run_faults.sh" "$build/tests/faults/pointspec_faults" \
        --table ${FAULTS_ONLY:+--only "$FAULTS_ONLY"} >"$scratch/rows" || return 1
    [[ -n ${FAULTS_ONLY-} ]] || { cat "$scratch/rows"; return; }
    # New rows hide old ones, in the order of the command lines; the last row is their sum.
    sed -n '/^<!-- table: faults -->$/,/^<!-- end -->$/p' "$docs/developer/reliability.md" | cat - "$scratch/rows" |
        awk -v list="$docs/../tests/faults/commands.txt" '
            $1 == "command" { head = $0 }
            NF == 7 && $1 != "all" { row[$1] = $0 }
            END {
                print head
                while ((getline line < list) > 0) {
                    split(line, word)
                    if (word[1] in row) print row[word[1]]
                }
                for (name in row) { n = split(row[name], cell); for (i = 2; i <= n; i++) sum[i] += cell[i] }
                printf "%-16s %7s %7s %7s %10s %8s %7s\n", "all", sum[2], sum[3], sum[4], sum[5], sum[6], sum[7]
            }'
}

# Error and time against PS_TORUS_RUN: the kernels from disk, with the length of a run put in.
table_run_length() {
    need tests/test_tolerance && need bench/bench_torus || return 1
    local run
    local -x POINTSPEC_KERNEL_DIR=$scratch/kernels
    printf '%6s %14s %14s %14s %14s %12s\n' run "white single" "one place" "white double" \
        "one place" "ms/R single"
    for run in 1 8 16 32 64 128 256; do
        rm -rf "$POINTSPEC_KERNEL_DIR"
        cp -r "$kernels" "$POINTSPEC_KERNEL_DIR"
        sed -i "s/^#ifndef RUN\$/#undef RUN\n#ifndef RUN/; s/^#define RUN .*/#define RUN $run/" \
            "$POINTSPEC_KERNEL_DIR/torus/layout.h"
        # Long runs fail the test's bound, which ends it: "-" for what it did not come to.
        { "$build/tests/test_tolerance" 2>&1 || true; } | grep ' slack ' >"$scratch/lines"
        "$build/bench/bench_torus" "grid 2 1024 64 256 single" | tail -n 1 >"$scratch/time"
        printf '%6d %14s %14s %14s %14s %12s\n' "$run" "$(grid_error white single)" \
            "$(grid_error 'one place' single)" "$(grid_error white double)" \
            "$(grid_error 'one place' double)" "$(awk '{ print $7 }' "$scratch/time")"
    done
}
grid_error() { # SHAPE PRECISION: error on the grid, the first line of the shape
    awk -v shape="$1 " -v precision="$2" '
        index($0, shape) == 1 && $0 ~ ("N=1000 +" precision) {
            for (i = 1; i < NF; i++) if ($i == "error") { print $(i + 1); found = 1; exit }
        }
        END { if (!found) print "-" }' "$scratch/lines"
}

fill() { # FILE NAME TEXT
    awk -v name="$2" -v text="$3" '
        $0 == "<!-- table: " name " -->" {
            print
            print "```text"
            while ((getline line < text) > 0) print line
            print "```"
            inside = 1
            next
        }
        $0 == "<!-- end -->" { inside = 0 }
        !inside' "$1" >"$scratch/new"
    cat "$scratch/new" >"$1"
}

if (($# == 0)); then
    mapfile -t names < <(sed -n 's/^<!-- table: \(.*\) -->$/\1/p' "${pages[@]}" | sort -u)
    set -- "${names[@]}"
fi
for name in "$@"; do
    declare -F "table_$name" >/dev/null || { echo "update_tables: no table $name" >&2; exit 2; }
    echo "update_tables: $name" >&2
    "table_$name" >"$scratch/$name" || { echo "update_tables: $name not made" >&2; continue; }
    while IFS= read -r file; do
        fill "$file" "$name" "$scratch/$name"
    done < <(grep -lx "<!-- table: $name -->" "${pages[@]}")
done
