#!/usr/bin/env bash
# cli_full.sh PROGRAM: the arrays of --full: their halves, and DC with its standard error under both normalizations.
# shellcheck source=tests/harness/harness.sh
. "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../harness/harness.sh" power "$1"
printf '%s\n' '0.1 0.2 1' '0.3 0.7 1' '0.6 0.4 1' '#' '0.1 0.2 1' '0.35 0.75 3' '0.65 0.45 1' >sets.txt
printf '0 0\n1 -2\n' >list.txt
sets=(sets.txt --columns xyw --engine host_direct)
one=("${sets[@]}" -k 2)

middle=12 all=25 # of the 5 x 5 numbers of K = 2
number() {       # FILE INDEX: the float64 at the end of a file of so many
    tail -c $((8 * all)) "$1" | tail -c +$((8 * $2 + 1)) | head -c 8 | od -An -t f8 | tr -d ' '
}
is() { # WHAT NUMBER EXPECTED: within rounding
    awk -v a="$2" -v b="$3" 'BEGIN { exit !(a == b || (a - b) ^ 2 <= (1e-13 * b) ^ 2) }' || complain "$1 is $2, not $3"
}

# P(0) = W^2 / V: 9 / 3 and 25 / 11
runs 0 "${one[@]}" --full f.npy --normalize effective
is "the power at DC" "$(number f.npy $middle)" "$(awk 'BEGIN { printf "%.17g", (9 / 3 + 25 / 11) / 2 }')"
is "its standard error" "$(number f.standard_error.npy $middle)" "$(awk 'BEGIN { printf "%.17g", (9 / 3 - 25 / 11) / 2 }')"
runs 0 "${sets[@]}" --frequencies list.txt --normalize effective
IFS=, read -r -a names < <(grep -v '^#' out)
for i in "${!names[@]}"; do
    [[ ${names[i]} == standard_error ]] && column=$((i + 1))
done
for row in 1 2; do # (1, -2) lies 3 rows of 5 and 0 on from the beginning
    place=$((row == 1 ? middle : 15))
    is "row $row of the list" "$(number f.standard_error.npy $place)" \
        "$(grep -v '^#' out | sed -n "$((row + 1))p" | cut -d, -f"$column")"
done
for ((i = 0; i < middle; i++)); do
    for name in f.npy f.standard_error.npy; do
        [[ $(number $name $i) == "$(number $name $((all - 1 - i)))" ]] || complain "$name differs between k and -k, number $i"
    done
done

# P(0) = N is known; so is W^2 / V of sets that are all alike
runs 0 "${one[@]}" --full f.npy
is "the power at DC" "$(number f.npy $middle)" 3
is "its standard error" "$(number f.standard_error.npy $middle)" 0
runs 0 --sampler regular -n 9 -m 4 -k 2 --engine host_direct --full f.npy --normalize effective
is "the power at DC" "$(number f.npy $middle)" 9
is "its standard error" "$(number f.standard_error.npy $middle)" 0
runs 0 "${one[@]}" --select-sets 2 --full f.npy --normalize effective
[[ $(number f.standard_error.npy $middle) == *nan ]] || complain "one set has a standard error"

# S(k) of every set, as --full has the places: |S|^2 is the power, -k has the conjugate, DC the sum of the weights
part() { # FILE INDEX: a float64 counted from the end of the header, which is 128 bytes
    tail -c +$((129 + 8 * $2)) "$1" | head -c 8 | od -An -t f8 | tr -d ' '
}
runs 0 "${one[@]}" --full f.npy --coefficients c.npy
[[ $(stat -c %s c.npy) == $((128 + 2 * all * 16)) && $(head -c 100 c.npy) == *"'<c16'"*"(2, 5, 5)"* ]] || complain "coefficients of two sets: $(head -c 100 c.npy)"
is "the sum of the weights" "$(part c.npy $((2 * middle)))" 3
is "that of the other set" "$(part c.npy $((2 * (all + middle))))" 5
for ((i = 0; i < all; i++)); do
    is "re S(-k), number $i" "$(part c.npy $((2 * i)))" "$(part c.npy $((2 * (all - 1 - i))))"
    is "im S(-k), number $i" "$(part c.npy $((2 * i + 1)))" "$(awk -v x="$(part c.npy $((2 * (all - 1 - i) + 1)))" 'BEGIN { printf "%.17g", -x }')"
    is "the power of number $i" "$(number f.npy $i)" "$(awk -v a="$(part c.npy $((2 * i)))" -v b="$(part c.npy $((2 * i + 1)))" \
        -v c="$(part c.npy $((2 * (all + i))))" -v d="$(part c.npy $((2 * (all + i) + 1)))" \
        'BEGIN { printf "%.17g", 3 * ((a * a + b * b) / 9 + (c * c + d * d) / 25) / 2 }')"
done
runs 0 "${sets[@]}" --frequencies list.txt --coefficients l.npy
[[ $(head -c 100 l.npy) == *"(2, 2)"* ]] || complain "coefficients of a list: $(head -c 100 l.npy)"
is "S of the list" "$(part l.npy 3)" "$(part c.npy 31)"
runs 0 "${one[@]}" --select-sets 1 --coefficients s.npy
[[ $(head -c 100 s.npy) == *"(5, 5)"* ]] || complain "coefficients of one set: $(head -c 100 s.npy)"
cmp -s <(tail -c +129 s.npy) <(tail -c +129 c.npy | head -c $((16 * all))) || complain "the first set alone has other coefficients"
# shifts change no power, but coefficients
runs 0 --sampler regular -n 9 -m 2 -k 3 --homogenize --engine host_direct --coefficients h.npy
[[ $(part h.npy 10) != "$(part h.npy 108)" ]] || complain "shifted sets have the same coefficients"
runs 2 "${one[@]}" --coefficients c.csv
says '--coefficients writes NPY'
runs 2 --sampler white --sampler jittered -n 16 -k 2 --coefficients c.npy
says 'one array has one file'
runs 2 --sampler white -n 16 -k 2 --per-ring 2 --coefficients c.npy
says 'a subset does not fill an array'
finish
