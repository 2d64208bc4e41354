/* --full and --coefficients of power. */
#include "answers/spectra/power_table.h"

#include "base/memory.h"
#include "files/npy.h"
#include "files/output_file.h"

#include <stdlib.h>
#include <string.h>

/* ---- --full ------------------------------------------------------------------------------ */

ps_mean ps_power_dc(const ps_request *arguments, const ps_spectrum *spectrum) {
    const bool is_known = spectrum->smallest_points == spectrum->largest_points ||
                          arguments->normalization == PSPEC_NORMALIZATION_INTEGRAL;
    return arguments->normalization == PSPEC_NORMALIZATION_EFFECTIVE
               ? spectrum->sample_size
               : (ps_mean){spectrum->mean_points, is_known ? 0 : spectrum->points_error};
}

static pspec_status write_array(const char *path, const ps_request *arguments,
                                const ps_spectrum *spectrum, int which, ps_error *error) {
    double *array = NULL;
    size_t num_entries = 0;
    size_t shape[PS_MAX_DIMENSION];
    const ps_frequencies *set = &spectrum->frequencies;
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        shape[axis] = 2 * (size_t)set->max_frequency + 1;
    }
    PS_TRY(ps_spectrum_full(spectrum, which, ps_power_dc(arguments, spectrum), &array, &num_entries,
                            error));
    const pspec_status status = ps_npy_write(path, set->dimension, shape, array, error);
    free(array);
    return status;
}

static const char array_ending[] = ".npy";

/* Length of the path without its ending, which ps_power_check_arrays has seen. */
static size_t stem_length(const char *path) {
    return strlen(path) - (sizeof array_ending - 1);
}

pspec_status ps_power_check_arrays(const ps_request *arguments, ps_error *error) {
    if (arguments->full != NULL) {
        PS_TRY(ps_npy_check_name("--full", arguments->full, error));
    }
    return arguments->coefficients == NULL
               ? PSPEC_OK
               : ps_npy_check_name("--coefficients", arguments->coefficients, error);
}

pspec_status ps_power_write_full(const ps_request *arguments, const ps_power_job *job,
                                 ps_error *error) {
    const char *path = arguments->full;
    const ps_spectrum *spectrum = ps_power_job_spectrum(job);
    ps_text beside = {0};
    PS_TRY(write_array(path, arguments, spectrum, 0, error));
    ps_text_append_bytes(&beside, path, stem_length(path));
    ps_text_append(&beside, ".standard_error%s", array_ending);
    const pspec_status status =
        beside.failed ? ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for a file name")
                      : write_array(ps_text_string(&beside), arguments, spectrum, 1, error);
    ps_text_free(&beside);
    return status;
}

/* ---- --coefficients ---------------------------------------------------------------------- */

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

static ps_complex_shape find_shape(const ps_frequencies *set, size_t num_sets) {
    ps_complex_shape out = {.num_entries = 1};
    if (num_sets > 1) {
        out.shape[out.rank++] = num_sets;
    }
    if (set->kind == PS_FREQUENCIES_LIST) {
        out.shape[out.rank++] = out.num_entries = set->num;
        return out;
    }
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        out.shape[out.rank++] = 2 * (size_t)set->max_frequency + 1;
        out.num_entries *= 2 * (size_t)set->max_frequency + 1;
    }
    return out;
}

pspec_status ps_power_coefficients(const ps_power_job *job, double **out, ps_complex_shape *shape,
                                   ps_error *error) {
    const ps_frequencies *const set = ps_power_job_problem(job)->frequencies;
    size_t num_sets = 0;
    const double *amplitudes = ps_power_job_amplitudes(job, &num_sets);
    *shape = find_shape(set, num_sets);
    PS_TRY(ps_allocate_for(out, num_sets, 2 * shape->num_entries * sizeof **out, "coefficients",
                           error));
    for (size_t r = 0; r < num_sets; r++, amplitudes += 2 + 2 * set->num) {
        double *const box = *out + r * 2 * shape->num_entries;
        if (set->kind == PS_FREQUENCIES_LIST) {
            memcpy(box, amplitudes + 2, 2 * shape->num_entries * sizeof *box);
        } else {
            fill_box(set, amplitudes, shape->num_entries, box);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_power_write_coefficients(const ps_request *arguments, const ps_power_job *job,
                                         ps_error *error) {
    const ps_frequencies *const set = ps_power_job_problem(job)->frequencies;
    size_t num_sets = 0;
    const double *amplitudes = ps_power_job_amplitudes(job, &num_sets);
    const ps_complex_shape shape = find_shape(set, num_sets);
    double *box = NULL;
    ps_output_file *file = NULL;
    if (set->kind != PS_FREQUENCIES_LIST) {
        PS_TRY(PS_NEW(&box, 2 * shape.num_entries, "the coefficients of a set", error));
    }
    const pspec_status status = ps_output_open(&file, arguments->coefficients, error);
    if (status != PSPEC_OK) {
        free(box);
        return status;
    }
    ps_npy_write_complex_header(ps_output_stream(file), shape.rank, shape.shape);
    for (size_t r = 0; r < num_sets; r++, amplitudes += 2 + 2 * set->num) {
        if (box != NULL) {
            fill_box(set, amplitudes, shape.num_entries, box);
        }
        ps_output_write(file, box != NULL ? box : amplitudes + 2, 2 * sizeof *box,
                        shape.num_entries);
    }
    free(box);
    return ps_output_commit(&file, error);
}
