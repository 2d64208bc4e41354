#include "spectra/spectrum_sums.h"

#include "base/memory.h"
#include "base/workers.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static pspec_status allocate(ps_spectrum_sums *out, bool has_powers, bool has_c2, ps_error *error) {
    const size_t num = out->frequencies.num;
    PS_TRY(PS_NEW(&out->bins, out->num_bins, "sums of bins", error));
    if (has_c2) {
        PS_TRY(PS_NEW(&out->c2, num, "sums of C_l^2", error));
    }
    return has_powers ? PS_NEW(&out->powers, num, "sums of frequencies", error) : PSPEC_OK;
}

pspec_status ps_spectrum_sums_create(ps_spectrum_sums *out, const ps_frequencies *frequencies,
                                     size_t num_bins, bool has_powers, bool has_c2,
                                     ps_error *error) {
    *out = (ps_spectrum_sums){.reference_points = 1, .num_bins = num_bins};
    pspec_status status = ps_frequencies_copy(&out->frequencies, frequencies, error);
    if (status == PSPEC_OK) {
        status = allocate(out, has_powers, has_c2, error);
    }
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(out);
    }
    return status;
}

void ps_spectrum_sums_free(ps_spectrum_sums *sums) {
    free(sums->powers);
    ps_frequencies_free(&sums->frequencies);
    free(sums->bins);
    free(sums->c2);
    ps_sum_nodes_free(&sums->nodes);
    *sums = (ps_spectrum_sums){0};
}

/* ---- merge ------------------------------------------------------------------------------- */

/* What a double counts exactly, and state of an answer may hold (spectrum_state.h). */
#define MOST_REALIZATIONS ((uint64_t)1 << 53)

static const char *kind_name(const ps_frequencies *set) {
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        return set->degree_step > 1 ? "the even degrees of the hemisphere"
                                    : "the degrees of the sphere";
    }
    return set->rings != NULL                 ? "a random subset of the frequencies of rings"
           : set->kind == PS_FREQUENCIES_LIST ? "a list of frequencies"
           : set->kind == PS_FREQUENCIES_BOX  ? "the frequencies of a box"
                                              : "the frequencies of rings";
}

/* The same vectors: different only in files that somebody made up. */
static pspec_status compare_rings(const ps_frequencies *a, const ps_frequencies *b,
                                  const char *which, ps_error *error) {
    bool is_same = a->num_rings == b->num_rings && a->per_ring == b->per_ring;
    for (size_t i = 0; is_same && i < a->num_rings; i++) {
        is_same = a->rings[i].num_frequencies == b->rings[i].num_frequencies;
    }
    return is_same ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INPUT,
                             "%s has a random subset of other rings, or of another size", which);
}

static pspec_status compare_rules(const ps_bin_rule *a, const ps_bin_rule *b, const char *which,
                                  ps_error *error) {
    if (ps_bin_rule_is_same(a, b)) {
        return PSPEC_OK;
    }
    return a->kind == b->kind && a->num_points != b->num_points
               ? ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s has bins relative to sets of %llu points instead of %llu", which,
                         (unsigned long long)b->num_points, (unsigned long long)a->num_points)
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s has bins by %s instead of %s", which,
                         ps_bin_rule_write(b).text, ps_bin_rule_write(a).text);
}

static pspec_status compare_frequencies(const ps_frequencies *a, const ps_frequencies *b,
                                        const char *which, ps_error *error) {
    const unsigned num_components = ps_frequency_components(a);
    if (a->dimension != b->dimension) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has dimension %u instead of %u", which,
                       b->dimension, a->dimension);
    }
    if (a->kind != b->kind || a->degree_step != b->degree_step ||
        (a->rings == NULL) != (b->rings == NULL)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has %s instead of %s", which, kind_name(b),
                       kind_name(a));
    }
    if ((a->kind != PS_FREQUENCIES_LIST || a->rings != NULL) &&
        a->max_frequency != b->max_frequency) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has max %s %d instead of %d", which,
                       a->kind == PS_FREQUENCIES_DEGREES ? "degree" : "frequency",
                       (int)b->max_frequency, (int)a->max_frequency);
    }
    PS_TRY(compare_rules(&a->bins, &b->bins, which, error));
    if (a->reach != b->reach || memcmp(a->stretch, b->stretch, sizeof a->stretch) != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has rings of a box of another shape", which);
    }
    if (a->num != b->num) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has %zu frequencies instead of %zu", which,
                       b->num, a->num);
    }
    for (size_t i = 0; i < a->num * num_components; i++) {
        if (a->vectors[i] != b->vectors[i]) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s has another frequency %zu in its %s",
                           which, i / num_components + 1,
                           a->rings != NULL ? "random subset (another seed?)" : "list");
        }
    }
    return a->rings != NULL ? compare_rings(a, b, which, error) : PSPEC_OK;
}

/* By the enumerators. */
static const char *const normalizations[] = {"power", "effective", "pairs", "integral"};

pspec_status ps_spectrum_sums_compare(const ps_spectrum_sums *a, const ps_spectrum_sums *b,
                                      const char *which, ps_error *error) {
    PS_TRY(compare_frequencies(&a->frequencies, &b->frequencies, which, error));
    if (a->normalization != b->normalization) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s has the normalization %s instead of %s", which,
                       normalizations[b->normalization], normalizations[a->normalization]);
    }
    return PSPEC_OK;
}

static void add_totals(ps_pattern_totals *totals, const ps_pattern_totals *other) {
    totals->num_realizations += other->num_realizations;
    ps_sums_merge(&totals->points, &other->points, 1);
    totals->sum_weights += other->sum_weights;
    ps_sums_merge(&totals->sample_sizes, &other->sample_sizes, 1);
    if (other->smallest_points < totals->smallest_points) {
        totals->smallest_points = other->smallest_points;
    }
    if (other->largest_points > totals->largest_points) {
        totals->largest_points = other->largest_points;
    }
}

static void merge_all(ps_sums *sums, const ps_sums *others, size_t num, double factor) {
    for (size_t i = 0; sums != NULL && i < num; i++) {
        ps_sums_merge(&sums[i], &others[i], factor);
    }
}

/* nan stays */
static double find_larger(double a, double b) {
    return a >= b || isnan(a) ? a : b;
}

pspec_status ps_spectrum_sums_merge(ps_spectrum_sums *sums, const ps_spectrum_sums *other,
                                    const char *which, ps_error *error) {
    PS_TRY(ps_spectrum_sums_compare(sums, other, which, error));
    if (sums->num_equal > 0 || other->num_equal > 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, or what it is merged with, is of a deterministic set, one realization "
                       "of which stands for all: more of them (--realizations) need no merging",
                       which);
    }
    if (sums->num_all > 0 || other->num_all > 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, or what it is merged with, is of a range of the realizations of a job "
                       "(--range), and is merged with the other ranges of that job alone",
                       which);
    }
    if (other->totals.num_realizations > MOST_REALIZATIONS - sums->totals.num_realizations) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s brings the realizations to more than 2^53",
                       which);
    }
    const double factor = sums->reference_points / other->reference_points;
    merge_all(sums->bins, other->bins, sums->num_bins, factor);
    merge_all(sums->powers, other->powers, sums->frequencies.num, factor);
    merge_all(sums->c2, other->c2, sums->frequencies.num, factor);
    add_totals(&sums->totals, &other->totals);
    sums->error = find_larger(sums->error, other->error);
    sums->self_check = find_larger(sums->self_check, other->self_check);
    sums->length_error = find_larger(sums->length_error, other->length_error);
    return PSPEC_OK;
}

/* ---- finish ------------------------------------------------------------------------------ */

typedef struct finishing {
    const ps_sums *sums;
    size_t num;
    uint64_t num_realizations;
    ps_mean *out;
} finishing;

static void finish_some(void *payload, unsigned index, unsigned count) {
    const finishing *work = payload;
    const size_t end = ps_share_begin(work->num, index + 1, count);
    for (size_t i = ps_share_begin(work->num, index, count); i < end; i++) {
        ps_sums_finish(&work->sums[i], work->num_realizations, &work->out[i].mean,
                       &work->out[i].standard_error);
    }
}

static void finish_all(const ps_sums *sums, size_t num, uint64_t num_realizations, ps_mean *out) {
    finishing work = {sums, num, num_realizations, out};
    ps_workers_share(num, finish_some, &work);
}

void ps_spectrum_sums_bins(const ps_spectrum_sums *sums, ps_mean *means) {
    const double factor =
        ps_spectrum_factor(sums->normalization, &sums->totals, sums->reference_points);
    finish_all(sums->bins, sums->num_bins, sums->totals.num_realizations, means);
    for (size_t b = 0; b < sums->num_bins; b++) {
        means[b].mean *= factor;
        means[b].standard_error *= factor;
    }
}

void ps_spectrum_sums_c2(const ps_spectrum_sums *sums, ps_mean *means) {
    finish_all(sums->c2, sums->frequencies.num, sums->totals.num_realizations, means);
    for (size_t i = 0; sums->num_equal > 0 && i < sums->frequencies.num; i++) {
        means[i].standard_error = 0;
    }
}

pspec_status ps_spectrum_sums_finish(const ps_spectrum_sums *sums, const ps_bins *bins,
                                     ps_spectrum *out, ps_error *error) {
    ps_mean *bin_means = NULL;
    ps_mean *powers = NULL;
    pspec_status status = PSPEC_OK;
    const uint64_t num = sums->totals.num_realizations;
    const double factor =
        ps_spectrum_factor(sums->normalization, &sums->totals, sums->reference_points);
    *out = (ps_spectrum){0};
    PS_TRY_OUT(status, PS_NEW(&bin_means, bins->num, "the bins", error));
    if (sums->powers != NULL) {
        PS_TRY_OUT(status, PS_NEW(&powers, sums->frequencies.num, "the powers", error));
        finish_all(sums->powers, sums->frequencies.num, num, powers);
    }
    finish_all(sums->bins, sums->num_bins, num, bin_means);
    status = ps_spectrum_from_means(out, &sums->frequencies, bins, bin_means, powers, factor,
                                    &sums->totals, error);
    if (status == PSPEC_OK && sums->num_equal > 0) {
        ps_spectrum_repeat(out, sums->num_equal);
    }
    powers = NULL;
out:
    free(powers);
    free(bin_means);
    return status;
}
