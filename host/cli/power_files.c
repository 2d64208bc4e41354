/* --full and --plot of power. */
#include "cli/power_table.h"

#include "base/memory.h"
#include "io/npy.h"
#include "io/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- --full ------------------------------------------------------------------------------ */

/* P(0) = N W^2 / W^2 = N, or W^2 / V. */
static double dc_power(const ps_arguments *arguments, const ps_spectrum *spectrum) {
    return arguments->effective ? spectrum->mean_sample_size : spectrum->mean_points;
}

static pspec_status write_array(const char *path, const ps_arguments *arguments,
                                const ps_spectrum *spectrum, int which, ps_error *error) {
    double *array = NULL;
    size_t num_entries = 0;
    size_t shape[PS_MAX_TORUS_DIMENSION];
    const ps_frequencies *set = &spectrum->frequencies;
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        shape[axis] = 2 * (size_t)set->max_frequency + 1;
    }
    PS_TRY(ps_spectrum_full(spectrum, which, dc_power(arguments, spectrum), &array, &num_entries,
                            error));
    const pspec_status status = ps_npy_write(path, set->dimension, shape, array, error);
    free(array);
    return status;
}

static const char array_ending[] = ".npy";

/* Length of the path without its ending; 0 when it has another one. */
static size_t stem_length(const char *path) {
    const size_t length = strlen(path);
    const size_t ending = sizeof array_ending - 1;
    return length > ending && strcmp(path + length - ending, array_ending) == 0 ? length - ending
                                                                                : 0;
}

pspec_status ps_power_check_full(const ps_arguments *arguments, ps_error *error) {
    if (arguments->full != NULL && stem_length(arguments->full) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--full writes NPY: \"%s\" does not end in %s", arguments->full,
                       array_ending);
    }
    return PSPEC_OK;
}

pspec_status ps_power_write_full(const ps_arguments *arguments, const ps_power_job *job,
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

/* ---- --plot ------------------------------------------------------------------------------ */

/* Columns of one curve, in one block: normalized frequency, power, standard error, anisotropy. */
static pspec_status make_curve(ps_plot_curve *curve, const char *label, const ps_spectrum *spectrum,
                               void **block, ps_error *error) {
    const size_t num = spectrum->num_bins;
    PS_TRY(ps_allocate(block, 4 * num, sizeof(double), "a curve", error));
    double *columns = *block;
    for (size_t b = 0; b < num; b++) {
        columns[b] = spectrum->bins[b].normalized_frequency;
        columns[num + b] = spectrum->bins[b].power;
        columns[2 * num + b] = spectrum->bins[b].standard_error;
        columns[3 * num + b] = spectrum->bins[b].anisotropy_db;
    }
    *curve =
        (ps_plot_curve){label, num, columns, columns + num, columns + 2 * num, columns + 3 * num};
    return PSPEC_OK;
}

static pspec_status make_image(ps_plot_image *image, double **array, const ps_spectrum *spectrum,
                               ps_error *error) {
    size_t num_entries = 0;
    PS_TRY(ps_spectrum_full(spectrum, 0, 0, array, &num_entries, error));
    *image = (ps_plot_image){2 * (size_t)spectrum->frequencies.max_frequency + 1, *array,
                             sqrt(spectrum->mean_points)};
    return PSPEC_OK;
}

static void write_title(ps_text *title, const ps_arguments *arguments, const ps_spectrum *spectrum,
                        size_t num) {
    if (num == 1) {
        ps_text_append(title, "%s",
                       arguments->num_samplers == 1 ? arguments->samplers[0] : arguments->files[0]);
    } else {
        ps_text_append(title, "%zu samplers", num);
    }
    ps_text_append(title, ", N = %.6g, %llu realization%s", spectrum->mean_points,
                   (unsigned long long)spectrum->num_realizations,
                   spectrum->num_realizations == 1 ? "" : "s");
}

pspec_status ps_power_write_plot(const ps_arguments *arguments, const ps_power_job *const *jobs,
                                 size_t num, ps_error *error) {
    ps_plot_curve curves[PS_MAX_SAMPLERS];
    void *blocks[PS_MAX_SAMPLERS] = {NULL};
    ps_plot_image image;
    double *array = NULL;
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    const ps_spectrum *first = ps_power_job_spectrum(jobs[0]);
    const bool has_image =
        num == 1 && first->frequencies.dimension == 2 && arguments->per_ring == 0;
    for (size_t i = 0; i < num; i++) {
        const char *label = arguments->num_samplers > 0 ? arguments->samplers[i] : "radial mean";
        PS_TRY_OUT(status, make_curve(&curves[i], label, ps_power_job_spectrum(jobs[i]), &blocks[i],
                                      error));
    }
    if (has_image) {
        PS_TRY_OUT(status, make_image(&image, &array, first, error));
    }
    write_title(&title, arguments, first, num);
    PS_TRY_OUT(status, ps_text_check(&title, error));
    const double realizations = (double)first->num_realizations;
    const ps_plot plot = {ps_text_string(&title), num, curves, has_image ? &image : NULL,
                          realizations > 1 ? -10 * log10(realizations) : NAN};
    PS_TRY_OUT(status, ps_plot_write(arguments->plot, &plot, error));
out:
    for (size_t i = 0; i < num; i++) {
        free(blocks[i]);
    }
    free(array);
    ps_text_free(&title);
    return status;
}
