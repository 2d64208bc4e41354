#include "answers/check/check_sides.h"

#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *ps_check_bin_name(const ps_saved_spectrum *saved) {
    return saved->on_sphere ? "degree" : ps_bin_rule_noun(&saved->bin_rule);
}

/* ---- what a job measured ------------------------------------------------------------------- */

static pspec_status copy_bins(ps_saved_spectrum *out, const ps_spectrum *averages,
                              ps_error *error) {
    PS_TRY(PS_NEW(&out->bins, averages->num_bins, "saved bins", error));
    out->num_bins = averages->num_bins;
    for (size_t b = 0; b < averages->num_bins; b++) {
        const ps_spectrum_bin *const bin = &averages->bins[b];
        out->bins[b] = (ps_saved_bin){bin->key,       bin->power, bin->standard_error,
                                      bin->frequency, bin->count, bin->num_computed};
    }
    return PSPEC_OK;
}

pspec_status ps_check_measured(ps_saved_spectrum *out, const ps_power_job *job, ps_error *error) {
    const ps_spectrum *const measured = &job->spectrum;
    const ps_frequencies *const set = &measured->frequencies;
    *out = (ps_saved_spectrum){.on_sphere = set->kind == PS_FREQUENCIES_DEGREES,
                               .dimension = set->dimension,
                               .max_frequency = ps_frequencies_reach(set),
                               .bin_rule = set->bins,
                               .num_realizations = measured->num_realizations,
                               .smallest_points = measured->smallest_points,
                               .largest_points = measured->largest_points,
                               .mean_points = measured->mean_points,
                               .sample_size = measured->sample_size.mean,
                               .modes = ps_compared_modes(set),
                               .error = job->runner.accuracy.error};
    return copy_bins(out, measured, error);
}

/* ---- are they of one kind? ----------------------------------------------------------------- */

static const char *name_normalization(pspec_normalization normalization) {
    return normalization == PSPEC_NORMALIZATION_EFFECTIVE  ? "effective"
           : normalization == PSPEC_NORMALIZATION_INTEGRAL ? "integral"
                                                           : "power";
}

/* "rings of the torus in 2 dimensions up to 12, normalization power" */
static void describe(ps_text *out, const ps_saved_spectrum *spectrum) {
    if (spectrum->on_sphere) {
        ps_text_append(
            out, "%s of the %s up to %d", spectrum->on_hemisphere ? "even degrees" : "degrees",
            spectrum->on_hemisphere ? "hemisphere" : "sphere", (int)spectrum->max_frequency);
    } else {
        const bool is_usual = spectrum->bin_rule.kind == PS_BINS_ROUND;
        ps_text_append(out, "%ss%s%s of the torus in %u dimension%s up to %d",
                       ps_bin_rule_noun(&spectrum->bin_rule), is_usual ? "" : " by ",
                       is_usual ? "" : ps_bin_rule_write(&spectrum->bin_rule).text,
                       spectrum->dimension, spectrum->dimension == 1 ? "" : "s",
                       (int)spectrum->max_frequency);
    }
    if (spectrum->per_ring > 0) {
        ps_text_append(out, ", %llu of every ring by the seed %llu",
                       (unsigned long long)spectrum->per_ring, (unsigned long long)spectrum->seed);
    }
    ps_text_append(out, ", normalization %s", name_normalization(spectrum->normalization));
}

static bool are_same_kind(const ps_saved_spectrum *a, const ps_saved_spectrum *b) {
    return a->on_sphere == b->on_sphere && a->on_hemisphere == b->on_hemisphere &&
           a->dimension == b->dimension && a->max_frequency == b->max_frequency &&
           ps_bin_rule_is_same(&a->bin_rule, &b->bin_rule) && a->per_ring == b->per_ring &&
           (a->per_ring == 0 || a->seed == b->seed) && a->normalization == b->normalization;
}

pspec_status ps_check_same_kind(const ps_check_side *saved, const ps_check_side *other,
                                ps_error *error) {
    ps_text text = {0};
    if (are_same_kind(saved->spectrum, other->spectrum)) {
        return PSPEC_OK;
    }
    ps_text_append(&text, "\"%s\" has ", other->path);
    describe(&text, other->spectrum);
    ps_text_append(&text, ", and \"%s\" has ", saved->path);
    describe(&text, saved->spectrum);
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_INPUT, "%s: spectra of two kinds are not compared",
                         ps_text_string(&text));
    }
    ps_text_free(&text);
    return status;
}

/* ---- have they the same bins? -------------------------------------------------------------- */

typedef struct range_text {
    char text[48];
} range_text;

/* "64", or "61 to 69" */
static range_text show_range(const ps_saved_spectrum *spectrum) {
    range_text out;
    const unsigned long long smallest = spectrum->smallest_points;
    const unsigned long long largest = spectrum->largest_points;
    if (smallest == largest) {
        snprintf(out.text, sizeof out.text, "%llu", smallest);
    } else {
        snprintf(out.text, sizeof out.text, "%llu to %llu", smallest, largest);
    }
    return out;
}

/* Sets of a sampler whose numbers of points vary have the same spectrum wherever in their range. */
static pspec_status check_points(const ps_check_side *saved, const ps_check_side *measured,
                                 ps_error *error) {
    const ps_saved_spectrum *const a = saved->spectrum;
    const ps_saved_spectrum *const b = measured->spectrum;
    if (a->smallest_points <= b->largest_points && b->smallest_points <= a->largest_points) {
        return PSPEC_OK;
    }
    return measured->path != NULL
               ? ps_fail(error, PSPEC_ERROR_INPUT,
                         "the sets of \"%s\" have %s points, those of \"%s\" have %s; spectra "
                         "change with the number of points",
                         measured->path, show_range(b).text, saved->path, show_range(a).text)
               : ps_fail(
                     error, PSPEC_ERROR_INPUT,
                     "these sets have %s points, those of \"%s\" have %s; spectra change with the "
                     "number of points (-n says how files without it are cut)",
                     show_range(b).text, saved->path, show_range(a).text);
}

/* Do the rows of the file tell of these frequencies? Its digits are all there, but the order of a
 * sum may be another. */
static pspec_status check_frequency(const ps_saved_bin *saved, const ps_saved_bin *measured,
                                    const char *path, const char *name, ps_error *error) {
    const double rounding = 1e-9;
    if (fabs(saved->frequency - measured->frequency) > rounding * measured->frequency) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "\"%s\": %s %lld has the frequency %.10g, which cannot be: it is %.10g",
                       path, name, (long long)saved->key, saved->frequency, measured->frequency);
    }
    return saved->count == 0 || measured->count == 0 || saved->count == measured->count
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "\"%s\": %s %lld has the count %llu, which cannot be: there are %llu "
                         "frequencies",
                         path, name, (long long)saved->key, (unsigned long long)saved->count,
                         (unsigned long long)measured->count);
}

static pspec_status check_bins(const ps_check_side *side, const ps_saved_spectrum *measured,
                               ps_error *error) {
    const ps_saved_spectrum *const saved = side->spectrum;
    const char *const name = ps_check_bin_name(saved);
    for (size_t b = 0; b < measured->num_bins; b++) {
        if (b >= saved->num_bins || saved->bins[b].key != measured->bins[b].key) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "\"%s\" lacks %s %lld, or what comes before it is out of place",
                           side->path, name, (long long)measured->bins[b].key);
        }
        PS_TRY(check_frequency(&saved->bins[b], &measured->bins[b], side->path, name, error));
    }
    return saved->num_bins == measured->num_bins
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" has %zu %ss, but up to %d there are %zu",
                         side->path, saved->num_bins, name, (int)saved->max_frequency,
                         measured->num_bins);
}

/* Of two files nobody knows which of them is damaged. */
static pspec_status check_same_bins(const ps_check_side *saved, const ps_check_side *other,
                                    ps_error *error) {
    const ps_saved_spectrum *const a = saved->spectrum;
    const ps_saved_spectrum *const b = other->spectrum;
    const char *const name = ps_check_bin_name(a);
    ps_error reason = {0};
    size_t i = 0;
    while (i < a->num_bins && i < b->num_bins && a->bins[i].key == b->bins[i].key &&
           check_frequency(&a->bins[i], &b->bins[i], saved->path, name, &reason) == PSPEC_OK) {
        i++;
    }
    return i == a->num_bins && i == b->num_bins
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "\"%s\" and \"%s\" do not have the same %ss: the first that differs is "
                         "number %zu, of %zu and %zu",
                         other->path, saved->path, name, i + 1, b->num_bins, a->num_bins);
}

/* ---- bin by bin ---------------------------------------------------------------------------- */

/* Frequencies of the bin, which a degree has by itself; tables of old versions say none. */
static double count_computed(const ps_saved_spectrum *spectrum, const ps_saved_bin *bin) {
    if (bin->num_computed > 0) {
        return (double)bin->num_computed;
    }
    return spectrum->on_sphere ? 2 * (double)bin->key + 1 : 1;
}

static ps_compared make_compared(const ps_saved_bin *bin, double error, double share, double unit) {
    return (ps_compared){bin->power, bin->standard_error,
                         ps_compared_error(bin->power, error, share, unit)};
}

/* The unit is taken to be that of the measured sets on both sides. */
static void make_sides(ps_compared *saved_side, ps_compared *measured_side,
                       const ps_saved_spectrum *saved, const ps_saved_spectrum *measured) {
    const double unit = ps_compared_unit(saved->normalization, measured->mean_points,
                                         measured->sample_size, measured->smallest_points);
    for (size_t b = 0; b < measured->num_bins; b++) {
        const double share = count_computed(measured, &measured->bins[b]) / measured->modes;
        saved_side[b] = make_compared(&saved->bins[b], saved->error, share, unit);
        measured_side[b] = make_compared(&measured->bins[b], measured->error, share, unit);
    }
}

pspec_status ps_check_compare(ps_comparison *rows, const ps_check_side *saved,
                              const ps_check_side *measured, double false_alarm_rate,
                              ps_error *error) {
    const ps_saved_spectrum *const a = saved->spectrum;
    const ps_saved_spectrum *const b = measured->spectrum;
    ps_compared *sides = NULL;
    const size_t num = a->num_bins;
    PS_TRY(check_points(saved, measured, error));
    PS_TRY(measured->path != NULL ? check_same_bins(saved, measured, error)
                                  : check_bins(saved, b, error));
    PS_TRY(ps_allocate_for(&sides, num, 2 * sizeof(ps_compared), "bins to compare", error));
    make_sides(sides, sides + num, a, b);
    const pspec_status status = ps_compare(rows, num, sides, a->num_realizations, sides + num,
                                           b->num_realizations, false_alarm_rate, error);
    free(sides);
    return status;
}
