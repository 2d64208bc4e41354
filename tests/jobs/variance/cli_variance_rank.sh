#!/usr/bin/env bash
# cli_variance_rank.sh PROGRAM: pointspec variance --rank: order, factors, their errors, what is not told apart, refusals.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../harness/harness.sh" variance "$1"

rows() { grep -v '^#' out | sed 1d; }

# ---- jittered points and white noise, one frequency: the factor is 1/P(k), and white noise has the factor 1 to itself ----

runs 0 --sampler white --sampler jittered --integrand wave:k=3 -d 1 -n 16 -m 2000 --shifts 0 --rank
grep -qx 'sampler,points,predicted,predicted_error,lower,upper,measured,measured_error,z_score,white,rank,factor,factor_error,factor_by,factor_score,factor_p_value,white_score,white_p_value' out ||
    complain "columns: $(grep -v '^#' out | head -n 1)"
# P(3) of 16 strata: 1 - sinc^2(3/16)
rows | awk -F, 'BEGIN { x = atan2(0, -1) * 3 / 16; exact = 1 / (1 - (sin(x) / x) ^ 2) }
    $1 == "white" { bad += !($11 == 2 && $12 - exact < 4 * $13 && exact - $12 < 4 * $13 && $13 < 0.1 * exact && $15 > 20 && $16 < 1e-20 && $17 < 4 && -$17 < 4 && $18 > 0.001) }
    $1 == "jittered" { bad += !($11 == 1 && $12 == 1 && $13 == 0 && $14 == "predicted" && $15 == "" && $16 == "" && $17 > 20 && $18 < 1e-20) }
    END { exit bad || NR != 2 }' || complain "one frequency: $(rows)"
# factor, and that of the predictions
rows | awk -F, '{ v[$1] = $3; f[$1] = $12 } END { r = v["white"] / v["jittered"]; exit !(r / f["white"] - 1 < 0.002 && f["white"] / r - 1 < 0.002) }' ||
    complain "factor: $(rows)"
[[ $(key ranking) == 'wave:k=3, N = 16: jittered has the least variance; white has '*' times as much (standard error '*'; white noise has '* &&
    $(key ranking_first) == jittered && $(key ranking_points) == 16 ]] || complain "sentence: $(grep '^# ranking' out)"

# ---- the score is that of paired realizations: of a sampler beside itself there is no difference at all ----

runs 0 --sampler jittered --sampler jittered --integrand disk -n 64 -m 8 --shifts 0 --rank
[[ $(rows | cut -d, -f11-16 | paste -sd' ') == '1,1,0,predicted,, 1,1,0,predicted,,1' && $(key ranking) == *'jittered has the same; white noise'* ]] ||
    complain "beside itself: $(rows)"

# ---- probabilities are of the whole ranking: of any two, white noise among them, and measured ones too ----

p_value() { rows | awk -F, '$1 == "jittered" { print $18 }'; }
runs 0 --sampler white --sampler jittered --integrand wave:k=2 -d 1 -n 16 -m 8 --shifts 0 --rank
two=$(p_value)
runs 0 --sampler white --sampler jittered --sampler latin-hypercube --integrand wave:k=2 -d 1 -n 16 -m 8 --shifts 0 --rank
three=$(p_value)
runs 0 --sampler white --sampler jittered --integrand wave:k=2 -d 1 -n 16 -m 8 --shifts 1 --rank
measured=$(p_value)
awk -v two="$two" -v three="$three" -v measured="$measured" 'BEGIN { exit !(two > 0 && measured < 1 && sqrt((three / two / 2 - 1) ^ 2 + (measured / two / 2 - 1) ^ 2) < 1e-12) }' ||
    complain "probabilities: $two of two, $three of three, $measured beside measured ones"

# ---- many, at several N and of several integrands; what is not told apart is said to be ----

runs 0 --sampler white --sampler poisson-disk --sampler jittered --sampler latin-hypercube --integrand gaussian --integrand disk \
    -n 64,1024 -m 20 --shifts 0 --rank
[[ $(rows | wc -l) == 16 && $(grep -c '^# ranking: ' out) == 4 ]] || complain "many: $(grep -v '^#' out)"
[[ $(key ranking_first | paste -sd,) == poisson-disk,jittered,poisson-disk,jittered &&
    $(key ranking_points | paste -sd,) == 64,1024,64,1024 ]] || complain "first ones: $(grep '^# ranking' out)"
key ranking | head -n 1 | grep -q 'white has .* times as much .*; white noise has .* times as much' || complain "sentence: $(key ranking | head -n 1)"
# a rank is 1 and how many are told apart as having less; the first one has the least prediction
rows | awk -F, '{ group[NR] = $2 ($3 < 500); v[NR] = $4; rank[NR] = $12; factor[NR] = $13; p[NR] = $17 }
    END { for (i = 1; i <= NR; i++) { less = 1
              for (k = 1; k <= NR; k++) less += group[k] == group[i] && v[k] < v[i]
              bad += rank[i] > less || (less == 1) != (p[i] == "") || factor[i] < 1 || (rank[i] == 1) != (p[i] == "" || p[i] > 0.001) }
          exit bad }' ||
    complain "ranks: $(rows)"
[[ $(key false_alarm_rate) == 0.001 ]] || complain "rate of false alarms: $(grep '^# false' out)"
runs 0 --sampler white --sampler latin-hypercube --integrand wave:k=1x1 -n 256 -m 8 --shifts 0 --rank
[[ $(key ranking) == *': not told apart)'* ]] || complain "white and Latin hypercube off the axes: $(key ranking)"

# ---- samplers without randomness, which need no realizations: sums over pairs, not what the cut-off makes of them ----

runs 0 --sampler larcher-pillichshammer --sampler regular --sampler sobol --integrand half-plane -n 1024 --shifts 0 --rank
pairs=$(key pairwise_variance | paste -sd' ')
rows | awk -F, -v pairs="$pairs" 'BEGIN { split(pairs, v, " ") }
    { q = v[NR] / v[3]; bad += !($12 - q < 1e-12 * q && q - $12 < 1e-12 * q && $13 == 0 && $14 == "pairs") }
    END { exit bad || !(v[1] / v[3] > 1.323 && v[1] / v[3] < 1.325 && v[2] / v[3] > 44.7 && v[2] / v[3] < 44.9) }' ||
    complain "pairs: $(rows), $pairs"
[[ $(key ranking) == 'half-plane, N = 1024: sobol has the least variance; larcher-pillichshammer has 1.324 times as much, by sums over pairs of points; '* ]] ||
    complain "pairs: $(key ranking)"
runs 0 --sampler regular --sampler hammersley --integrand box:sides=0.37 -n 64 --rank
[[ $(key ranking_first) == hammersley && $(rows | cut -d, -f11) == $'2\n1' ]] || complain "box: $(rows)"

# ---- too many points for that: an order is told only where the cut-off leaves it, and the sentence has the one that does ----

runs 0 --sampler regular --sampler halton -d 1 --integrand disk:radius=0.2 -n 1100 --shifts 0 --rank
[[ $(key ranking) == *'halton has '*' times as much (between '*'), told apart only if what lies beyond the cut-off is like white noise; -k '*' would settle it; white noise '* &&
    $(rows | cut -d, -f11) == $'1\n1' && $(key ranking) != *exactly* ]] || complain "an open bracket: $(key ranking)"
cutoff=$(key ranking | sed 's/.*halton[^;]*; -k \([0-9]*\) would.*/\1/')
runs 0 --sampler regular --sampler halton -d 1 --integrand disk:radius=0.2 -n 1100 --shifts 0 --rank -k "$cutoff"
[[ $(rows | cut -d, -f11) == $'1\n2' && $(key ranking) == *'halton has '*' times as much (between '*'); white noise '* ]] || complain "-k $cutoff: $(key ranking)"
# measured variances have no cut-off: forty sets that are nearly regular, whose peaks lie beyond it
python3 - <<'END' >nearly.txt
import random
random.seed(1)
for m in range(40):
    if m > 0:
        print("#")
    for i in range(8):
        for k in range(8):
            print((i + 0.5 + random.gauss(0, 0.004)) / 8 % 1, (k + 0.5 + random.gauss(0, 0.004)) / 8 % 1)
END
runs 0 --set nearly=nearly.txt --sampler hammersley --integrand box:sides=0.37 -n 64 -m 40 --shifts 0 --rank
[[ $(key ranking) == *'only if what lies beyond'* && $(rows | cut -d, -f11) == $'1\n1' ]] || complain "no trials: $(key ranking)"
runs 0 --set nearly=nearly.txt --sampler hammersley --integrand box:sides=0.37 -n 64 -m 40 --shifts 500 --rank
[[ $(key ranking) != *'only if'* && $(key ranking_first) == hammersley && $(rows | cut -d, -f11) == $'2\n1' && $(rows | cut -d, -f14 | head -n 1) == measured ]] ||
    complain "trials: $(key ranking), $(rows)"

# ---- with all that may be asked for besides; JSON; no variance; no randomness; refusals ----

runs 0 --sampler jittered --sampler white --integrand disk --integrand gaussian -n 64,256 -m 8 --shifts 0 --rank --rates auto --bounds 0.5..2 --paper-formula
[[ $(grep -v '^#' out | head -n 1) == 'sampler,integrand,points,'*',best_bound,worst_bound,rate_here,rate_here_error,rank,factor,factor_error,factor_by,factor_score,factor_p_value,white_score,white_p_value,paper' ]] ||
    complain "all columns: $(grep -v '^#' out | head -n 1)"
runs 0 --sampler jittered --sampler white --integrand constant -n 64 -m 8 --shifts 0 --rank
rows | awk -F, '$11 != 1 || $12 != "" || $17 != "" { bad++ } END { exit bad }' || complain "a constant: $(rows)"
runs 0 --sampler jittered --sampler halton --integrand disk -n 64 -m 8 --shifts 0 --rank --format json
python3 - <<'END' || complain 'ranks in JSON'
import json
all = json.load(open("out"))
assert all["meta"]["ranking_points"] == [64] and len(all["meta"]["ranking"]) == 1
assert sorted(row["rank"] for row in all["rows"]) in ([1, 1], [1, 2])
assert {row["sampler"]: row["white_score"] for row in all["rows"]}["halton"] is None
END
refuses '--rank compares samplers and sets, which takes two of them' --sampler white --integrand disk -m 8 --rank
refuses '--rank has errors, which need 8 realizations or more (--realizations), not 7' \
    --sampler white --sampler jittered --integrand disk -m 7 --rank
finish
