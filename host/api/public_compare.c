/* The public library: are two spectra of the same sampler? */
#include "api/public_objects.h"
#include "base/memory.h"
#include "spectra/compare.h"

#include <stdlib.h>

static pspec_status check_points(const ps_spectrum_sums *saved, const ps_spectrum_sums *measured,
                                 ps_error *error) {
    const ps_pattern_totals *const a = &saved->totals;
    const ps_pattern_totals *const b = &measured->totals;
    return a->smallest_points <= b->largest_points && b->smallest_points <= a->largest_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "the measured spectrum is of sets of %zu to %zu points, the saved one of "
                         "%zu to %zu; spectra change with the number of points",
                         b->smallest_points, b->largest_points, a->smallest_points,
                         a->largest_points);
}

static pspec_status check_question(const ps_spectrum_sums *saved, const ps_spectrum_sums *measured,
                                   ps_error *error) {
    PS_TRY(ps_spectrum_sums_require_same(saved, measured, "the measured spectrum", error));
    PS_TRY(check_points(saved, measured, error));
    return saved->normalization != PSPEC_NORMALIZATION_PAIRS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "powers are compared, and these are sums over pairs: normalize them as "
                         "power or effective");
}

static double unit_of(const ps_spectrum_sums *sums) {
    const ps_pattern_totals *const totals = &sums->totals;
    return ps_compared_unit(sums->normalization, ps_pattern_mean_points(totals),
                            totals->sample_sizes.sum / (double)totals->num_realizations,
                            totals->smallest_points);
}

static pspec_status make_side(ps_compared **out, const pspec_spectrum *spectrum, ps_error *error) {
    const ps_spectrum_sums *const sums = ps_public_sums(spectrum);
    const double modes = ps_compared_modes(&sums->frequencies);
    size_t num = 0;
    const pspec_bin *const bins = pspec_spectrum_bins(spectrum, &num);
    PS_TRY(PS_NEW(out, num, "bins to compare", error));
    for (size_t b = 0; b < num; b++) {
        const double share = (double)bins[b].num_computed / modes;
        (*out)[b] =
            (ps_compared){bins[b].power, bins[b].standard_error,
                          ps_compared_error(bins[b].power, sums->error, share, unit_of(sums))};
    }
    return PSPEC_OK;
}

static size_t copy_rows(pspec_bin_comparison *out, const ps_comparison *rows, size_t num) {
    size_t num_different = 0;
    for (size_t b = 0; b < num; b++) {
        num_different += rows[b].differs;
        if (out != NULL) {
            out[b] =
                (pspec_bin_comparison){rows[b].score, rows[b].p_value, rows[b].adjusted_p_value,
                                       rows[b].detectable, rows[b].differs};
        }
    }
    return num_different;
}

static pspec_status compare(const pspec_spectrum *saved, const pspec_spectrum *measured,
                            double false_alarm_rate, pspec_bin_comparison *bins,
                            size_t *num_different, ps_error *error) {
    ps_compared *sides[2] = {NULL, NULL};
    void *rows = NULL;
    size_t num = 0;
    pspec_status status = PSPEC_OK;
    pspec_spectrum_bins(saved, &num);
    PS_TRY_OUT(status, make_side(&sides[0], saved, error));
    PS_TRY_OUT(status, make_side(&sides[1], measured, error));
    PS_TRY_OUT(status, ps_allocate(&rows, num, sizeof(ps_comparison), "compared bins", error));
    PS_TRY_OUT(status,
               ps_compare(rows, num, sides[0], pspec_spectrum_num_realizations(saved), sides[1],
                          pspec_spectrum_num_realizations(measured), false_alarm_rate, error));
    const size_t different = copy_rows(bins, rows, num);
    if (num_different != NULL) {
        *num_different = different;
    }
out:
    free(rows);
    free(sides[0]);
    free(sides[1]);
    return status;
}

pspec_status pspec_spectrum_compare(const pspec_spectrum *saved, const pspec_spectrum *measured,
                                    pspec_context *context, double false_alarm_rate,
                                    pspec_bin_comparison *bins, size_t *num_different) {
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    if (saved == NULL || measured == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there are no two spectra to compare");
    }
    PS_TRY(check_question(ps_public_sums(saved), ps_public_sums(measured), &context->error));
    return compare(saved, measured, false_alarm_rate, bins, num_different, &context->error);
}
