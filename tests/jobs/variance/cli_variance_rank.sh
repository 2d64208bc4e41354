#!/usr/bin/env bash
# cli_variance_rank.sh PROGRAM: pointspec variance --rank: order, factors, their errors, what is not told apart, refusals.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

rows() { grep -v '^#' out | sed 1d; }

# ---- jittered points and white noise, one frequency: the factor is 1/P(k), and white noise has the factor 1 to itself ----

runs 0 --sampler white --sampler jittered --integrand wave:k=3 -d 1 -n 16 -m 2000 --shifts 0 --rank
grep -qx 'sampler,points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white,rank,factor,factor_error,factor_score,white_score' out ||
    complain "columns: $(grep -v '^#' out | head -n 1)"
# P(3) of 16 strata: 1 - sinc^2(3/16)
rows | awk -F, 'BEGIN { x = atan2(0, -1) * 3 / 16; exact = 1 / (1 - (sin(x) / x) ^ 2) }
    $1 == "white" { bad += !($11 == 2 && $12 - exact < 4 * $13 && exact - $12 < 4 * $13 && $13 < 0.1 * exact && $14 > 20 && $15 < 4 && -$15 < 4) }
    $1 == "jittered" { bad += !($11 == 1 && $12 == 1 && $13 == 0 && $14 == "" && $15 > 20) }
    END { exit bad || NR != 2 }' || complain "one frequency: $(rows)"
# factor, and that of the predictions
rows | awk -F, '{ v[$1] = $3; f[$1] = $12 } END { r = v["white"] / v["jittered"]; exit !(r / f["white"] - 1 < 0.002 && f["white"] / r - 1 < 0.002) }' ||
    complain "factor: $(rows)"
[[ $(key ranking) == 'wave:k=3, N = 16: jittered has the least variance; white has '*' times as much (standard error '*'; white noise has '* &&
    $(key ranking_first) == jittered && $(key ranking_points) == 16 ]] || complain "sentence: $(grep '^# ranking' out)"

# ---- the score is that of paired realizations: of a sampler beside itself there is no difference at all ----

runs 0 --sampler jittered --sampler jittered --integrand disk -n 64 -m 8 --shifts 0 --rank
[[ $(rows | cut -d, -f11-14 | paste -sd' ') == '1,1,0, 2,1,0,' ]] || complain "beside itself: $(rows)"

# ---- many, at several N and of several integrands; what is not told apart is said to be ----

runs 0 --sampler white --sampler poisson-disk --sampler jittered --sampler latin-hypercube --integrand gaussian --integrand disk \
    -n 64,1024 -m 20 --shifts 0 --rank
[[ $(rows | wc -l) == 16 && $(grep -c '^# ranking: ' out) == 4 ]] || complain "many: $(grep -v '^#' out)"
[[ $(key ranking_first | paste -sd,) == poisson-disk,jittered,poisson-disk,jittered &&
    $(key ranking_points | paste -sd,) == 64,1024,64,1024 ]] || complain "first ones: $(grep '^# ranking' out)"
key ranking | head -n 1 | grep -q 'white has .* times as much .*; white noise has .* times as much' || complain "sentence: $(key ranking | head -n 1)"
# ranks are a permutation, in the order of predictions
rows | awk -F, '{ group[NR] = $2 ($3 < 500); v[NR] = $4; rank[NR] = $12; factor[NR] = $13 }
    END { for (i = 1; i <= NR; i++) { less = 1
              for (k = 1; k <= NR; k++) less += group[k] == group[i] && v[k] < v[i]
              bad += rank[i] != less || (less == 1) != (factor[i] == 1) || factor[i] < 1 }
          exit bad }' ||
    complain "ranks: $(rows)"
runs 0 --sampler white --sampler latin-hypercube --integrand wave:k=1x1 -n 256 -m 8 --shifts 0 --rank
[[ $(key ranking) == *': not told apart)'* ]] || complain "white and Latin hypercube off the axes: $(key ranking)"

# ---- with all that may be asked for besides; JSON; no variance; no randomness; refusals ----

runs 0 --sampler jittered --sampler white --integrand disk --integrand gaussian -n 64,256 -m 8 --shifts 0 --rank --rates auto --bounds 0.5..2 --paper-formula
[[ $(grep -v '^#' out | head -n 1) == 'sampler,integrand,points,'*',best_bound,worst_bound,rate_here,rate_here_error,rank,factor,factor_error,factor_score,white_score,paper' ]] ||
    complain "all columns: $(grep -v '^#' out | head -n 1)"
runs 0 --sampler jittered --sampler white --integrand constant -n 64 -m 8 --shifts 0 --rank
rows | awk -F, '$11 == "" || $12 != "" || $15 != "" { bad++ } END { exit bad }' || complain "a constant: $(rows)"
runs 0 --sampler jittered --sampler halton --integrand disk -n 64 -m 8 --shifts 0 --rank --format json
python3 - <<'END' || complain 'ranks in JSON'
import json
all = json.load(open("out"))
assert all["meta"]["ranking_points"] == [64] and len(all["meta"]["ranking"]) == 1
assert sorted(row["rank"] for row in all["rows"]) == [1, 2]
assert {row["sampler"]: row["white_score"] for row in all["rows"]}["halton"] is None
END
refuses '--rank compares samplers and sets, which takes two of them' --sampler white --integrand disk -m 8 --rank
refuses '--rank has errors, which need 8 realizations or more (--realizations), not 7' \
    --sampler white --sampler jittered --integrand disk -m 7 --rank
finish
