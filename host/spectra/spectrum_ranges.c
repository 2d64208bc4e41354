/* Sums over ranges of the realizations of one job. */
#include "spectra/spectrum_sums.h"

#include "engines/error_units.h"
#include "math/larger.h"
#include "plan/range.h"

#include <string.h>

uint64_t ps_spectrum_sums_first(const ps_spectrum_sums *sums) {
    return sums->nodes.num > 0 ? sums->nodes.nodes[0].first : 0;
}

uint64_t ps_spectrum_sums_end(const ps_spectrum_sums *sums) {
    return ps_spectrum_sums_first(sums) + ps_sum_nodes_count(&sums->nodes);
}

static void get_all(const ps_sum_nodes *nodes, ps_node_sums which, ps_sums *out) {
    for (size_t i = 0; out != NULL && i < nodes->sizes[which]; i++) {
        out[i] = ps_sum_nodes_get(nodes, which, i);
    }
}

void ps_spectrum_sums_flatten(ps_spectrum_sums *sums) {
    ps_sums totals[PS_NUM_TOTALS];
    const ps_sums *const weights = &totals[PS_TOTAL_WEIGHTS];
    get_all(&sums->nodes, PS_NODE_BINS, sums->bins);
    get_all(&sums->nodes, PS_NODE_POWERS, sums->powers);
    get_all(&sums->nodes, PS_NODE_C2, sums->c2);
    get_all(&sums->nodes, PS_NODE_TOTALS, totals);
    sums->totals.num_realizations = ps_sum_nodes_count(&sums->nodes);
    sums->totals.points = totals[PS_TOTAL_POINTS];
    sums->totals.sample_sizes = totals[PS_TOTAL_SAMPLE_SIZES];
    sums->totals.sum_weights = weights->sum + weights->sum_low;
}

void ps_spectrum_sums_close(ps_spectrum_sums *sums) {
    ps_spectrum_sums_flatten(sums);
    if (sums->totals.num_realizations == sums->num_all) {
        ps_sum_nodes_free(&sums->nodes);
        sums->num_all = 0;
    }
}

/* ---- joining --------------------------------------------------------------------------------- */

static pspec_status compare_jobs(const ps_spectrum_sums *a, const ps_spectrum_sums *b,
                                 const char *which, ps_error *error) {
    PS_TRY(ps_spectrum_sums_compare(a, b, which, error));
    if (a->num_all != b->num_all) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is a range of %llu realizations instead of %llu", which,
                       (unsigned long long)b->num_all, (unsigned long long)a->num_all);
    }
    if (a->reference_points != b->reference_points || a->tolerance != b->tolerance ||
        memcmp(a->nodes.sizes, b->nodes.sizes, sizeof a->nodes.sizes) != 0 ||
        memcmp(a->nodes.is_single, b->nodes.is_single, sizeof a->nodes.is_single) != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s was planned for another job: its tolerance, precision or first set are "
                       "others",
                       which);
    }
    return PSPEC_OK;
}

static ps_realization_range range_of(const ps_spectrum_sums *sums) {
    return (ps_realization_range){ps_spectrum_sums_first(sums), ps_spectrum_sums_end(sums)};
}

void ps_spectrum_sums_join_errors(ps_spectrum_sums *sums, const ps_spectrum_sums *next) {
    sums->error = ps_larger(sums->error, next->error);
    sums->amplitude_error = ps_larger(sums->amplitude_error, next->amplitude_error);
    sums->largest_share = ps_larger(sums->largest_share, next->largest_share);
    sums->largest_power = ps_larger(sums->largest_power, next->largest_power);
    if (sums->amplitude_error > 0) {
        sums->error = ps_pair_sums_error(sums->amplitude_error, sums->largest_share);
    }
    if (next->totals.largest_points > sums->totals.largest_points) {
        sums->totals.largest_points = next->totals.largest_points;
    }
}

/* The self-check of a job is that of its first set, which the first range has. */
pspec_status ps_spectrum_sums_join(ps_spectrum_sums *sums, const ps_spectrum_sums *next,
                                   const char *const names[2], ps_error *error) {
    ps_pattern_totals *const totals = &sums->totals;
    const ps_realization_range range = range_of(sums);
    const ps_realization_range behind = range_of(next);
    PS_TRY(compare_jobs(sums, next, names[1], error));
    PS_TRY(ps_range_check_next(&range, &behind, names, error));
    for (size_t i = 0; i < next->nodes.num; i++) {
        PS_TRY(ps_sum_nodes_append(&sums->nodes, &next->nodes.nodes[i], error));
    }
    if (next->totals.smallest_points < totals->smallest_points) {
        totals->smallest_points = next->totals.smallest_points;
    }
    ps_spectrum_sums_join_errors(sums, next);
    sums->length_error = ps_larger(sums->length_error, next->length_error);
    return PSPEC_OK;
}
