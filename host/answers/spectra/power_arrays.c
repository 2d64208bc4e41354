/* Arrays of power: full and coefficients. */
#include "answers/spectra/power_table.h"

#include <string.h>

pspec_status ps_power_check_arrays(const ps_request *arguments, ps_error *error) {
    if (arguments->full != NULL) {
        PS_TRY(ps_npy_check_name("--full", arguments->full, error));
    }
    return arguments->coefficients == NULL
               ? PSPEC_OK
               : ps_npy_check_name("--coefficients", arguments->coefficients, error);
}

/* ---- full -------------------------------------------------------------------------------- */

/* P(0) = N W^2 / W^2 = N, N being the mean over the realizations, a constant; or W^2 / V, which
 * each has its own of. */
static ps_mean find_dc(const ps_request *arguments, const ps_spectrum *spectrum) {
    const bool is_known = spectrum->smallest_points == spectrum->largest_points ||
                          arguments->normalization == PSPEC_NORMALIZATION_INTEGRAL;
    return arguments->normalization == PSPEC_NORMALIZATION_EFFECTIVE
               ? spectrum->sample_size
               : (ps_mean){spectrum->mean_points, is_known ? 0 : spectrum->points_error};
}

static pspec_status add_full(ps_table *table, const char *name, const ps_spectrum *spectrum,
                             int which, ps_mean dc, ps_error *error) {
    const ps_frequencies *const set = &spectrum->frequencies;
    ps_npy_array array = {.rank = set->dimension};
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        array.shape[axis] = 2 * (size_t)set->max_frequency + 1;
    }
    PS_TRY(ps_spectrum_full(spectrum, which, dc, &array.data, &array.num, error));
    return ps_table_add_array(table, name, false, &array, error);
}

/* Lists, and subsets of rings, fill no array. Pictures have no DC. */
pspec_status ps_power_add_full(ps_table *table, const ps_request *request,
                               const ps_spectrum *spectrum, ps_error *error) {
    enum { PLANE = 2 };
    const bool is_array = request->wants_array || request->full != NULL;
    const bool is_drawn = request->plot != NULL && ps_request_num_questions(request) == 1;
    const bool is_picture = (request->wants_picture || is_drawn) &&
                            spectrum->frequencies.dimension == PLANE &&
                            request->frequencies.per_ring == 0;
    if (spectrum->frequencies.kind != PS_FREQUENCIES_BOX || (!is_array && !is_picture)) {
        return PSPEC_OK;
    }
    const ps_mean dc = is_array ? find_dc(request, spectrum) : (ps_mean){0};
    PS_TRY(add_full(table, "full", spectrum, 0, dc, error));
    return request->full != NULL ? add_full(table, "full_standard_error", spectrum, 1, dc, error)
                                 : PSPEC_OK;
}

/* ---- coefficients ------------------------------------------------------------------------ */

/* The box of a set, S(-k) being the conjugate of S(k). */
static void fill_box(const ps_frequencies *set, const double *amplitudes, size_t num_entries,
                     double *box) {
    const double *const values = amplitudes + 2; /* behind S(0) */
    memcpy(box + num_entries / 2 * 2, amplitudes, 2 * sizeof *box);
    for (size_t i = 0; i < set->num; i++) {
        const size_t place = ps_spectrum_place(set, i);
        const size_t opposite = num_entries - 1 - place;
        box[2 * place] = box[2 * opposite] = values[2 * i];
        box[2 * place + 1] = values[2 * i + 1];
        box[2 * opposite + 1] = -values[2 * i + 1];
    }
}

/* [sets] where there are several, then the box, or the frequencies of a list. */
static pspec_status make_boxes(ps_npy_array *out, const ps_frequencies *set, size_t num_sets,
                               ps_error *error) {
    size_t shape[PS_MAX_DIMENSION + 1] = {num_sets};
    unsigned rank = num_sets > 1 ? 1 : 0;
    if (set->kind == PS_FREQUENCIES_LIST) {
        shape[rank++] = set->num;
    } else {
        for (unsigned axis = 0; axis < set->dimension; axis++) {
            shape[rank++] = 2 * (size_t)set->max_frequency + 1;
        }
    }
    return ps_npy_make_array(out, rank, shape, true, error);
}

pspec_status ps_power_add_coefficients(ps_table *table, const ps_power_job *job, ps_error *error) {
    const ps_frequencies *const set = job->problem.frequencies;
    const size_t num_sets = job->num_kept;
    ps_npy_array array;
    const double *amplitudes = job->kept;
    PS_TRY(make_boxes(&array, set, num_sets, error));
    const size_t num_entries = num_sets > 0 ? array.num / num_sets : 0;
    for (size_t r = 0; r < num_sets; r++, amplitudes += 2 + 2 * set->num) {
        double *const box = array.data + r * 2 * num_entries;
        if (set->kind == PS_FREQUENCIES_LIST) {
            memcpy(box, amplitudes + 2, 2 * num_entries * sizeof *box);
        } else {
            fill_box(set, amplitudes, num_entries, box);
        }
    }
    return ps_table_add_array(table, "coefficients", false, &array, error);
}
