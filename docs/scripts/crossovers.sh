#!/usr/bin/env bash
# crossovers.sh TABLE.csv: where the predicted variances of two samplers are the same, of every integrand of a table of pointspec
# variance, the command's or a scene's. Between two numbers of points both are taken for powers of N, whose exponents are printed, in the
# order of the samplers. error: the standard error of the crossing, by those of the four predictions around it.
set -euo pipefail
(($# == 1)) || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
awk '
    # Commas between quotes are none between columns.
    function split_row(row, cells,  parts, i, n, joined) {
        n = split(row, parts, "\"")
        for (i = 1; i <= n; i++) {
            if (i % 2 == 0) gsub(",", "\001", parts[i])
            joined = joined parts[i]
        }
        n = split(joined, cells, ",")
        for (i = 1; i <= n; i++) gsub("\001", ",", cells[i])
        return n
    }
    /^#/ { if (sub(/^# integrand: /, "")) only = $0; next }
    !num_columns {
        num_columns = split_row($0, names)
        for (i = 1; i <= num_columns; i++) at[names[i]] = i
        if (!at["sampler"] || !at["points"] || !at["predicted"] || !at["predicted_error"]) exit failed = 1
        next
    }
    {
        split_row($0, cell)
        integrand = at["integrand"] ? cell[at["integrand"]] : only
        sampler = cell[at["sampler"]]
        if (!(integrand in known)) { known[integrand] = 1; integrands[++num_integrands] = integrand }
        if (!(sampler in seen)) { seen[sampler] = 1; samplers[++num_samplers] = sampler }
        if (cell[at["predicted"]] > 0) {
            i = ++num[integrand, sampler]
            x[integrand, sampler, i] = log(cell[at["points"]])
            y[integrand, sampler, i] = log(cell[at["predicted"]])
            e[integrand, sampler, i] = cell[at["predicted_error"]] / cell[at["predicted"]]
        }
    }
    function slope(f, s, i) { return (y[f, s, i + 1] - y[f, s, i]) / (x[f, s, i + 1] - x[f, s, i]) }
    function line(f, s, i, u) { return y[f, s, i] + slope(f, s, i) * (u - x[f, s, i]) }
    # The interval of s in which u is, 0 for none; the numbers of points of another sampler may be a little beyond the ends.
    function find(f, s, u,  i) {
        for (i = 1; i < num[f, s]; i++)
            if (x[f, s, i] - 0.05 <= u && u <= x[f, s, i + 1] + 0.05 && u < x[f, s, i + 1] - 0.05) return i
        return 0
    }
    function scatter(f, a, i, b, j) { return e[f, a, i] ^ 2 + e[f, b, j] ^ 2 }
    function compare(f, a, b,  i, j, u, v, p, q, t, where, steep, error) {
        for (i = 1; i < num[f, a]; i++) {
            u = x[f, a, i]; v = x[f, a, i + 1]
            if (!(j = find(f, b, u))) continue
            p = line(f, a, i, u) - line(f, b, j, u); q = line(f, a, i, v) - line(f, b, j, v)
            if (p * q >= 0) continue
            t = p / (p - q)
            where = exp(u + (v - u) * t)
            steep = (q - p) / (v - u)
            error = where * sqrt((1 - t) ^ 2 * scatter(f, a, i, b, j) + t ^ 2 * scatter(f, a, i + 1, b, j + 1)) / (steep < 0 ? -steep : steep)
            if (p > 0) say(f, b, j, a, i, where, error); else say(f, a, i, b, j, where, error)
        }
    }
    function say(f, a, i, b, j, where, error) {
        printf "%-24s %-20s %-20s %7.0f %6.0f %9.2f %9.2f\n", f, a, b, where, error, slope(f, a, i), slope(f, b, j)
    }
    END {
        if (failed) { print "crossovers: no columns sampler, points, predicted and predicted_error" >"/dev/stderr"; exit 1 }
        printf "%-24s %-20s %-20s %7s %6s %9s %9s\n", "integrand", "smaller below N", "smaller above N", "N", "error", "exponents", ""
        for (k = 1; k <= num_integrands; k++)
            for (i = 1; i <= num_samplers; i++)
                for (j = i + 1; j <= num_samplers; j++) compare(integrands[k], samplers[i], samplers[j])
    }' "$1" | sed 's/ *$//'
