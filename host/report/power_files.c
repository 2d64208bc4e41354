/* --full of power. */
#include "report/power_table.h"

#include "files/npy.h"

#include <stdlib.h>
#include <string.h>

/* ---- --full ------------------------------------------------------------------------------ */

/* P(0) = N W^2 / W^2 = N, N being the mean over the realizations, a constant; or W^2 / V, which
 * each has its own of. */
static ps_mean dc_power(const ps_request *arguments, const ps_spectrum *spectrum) {
    return arguments->effective ? spectrum->sample_size : (ps_mean){.mean = spectrum->mean_points};
}

static pspec_status write_array(const char *path, const ps_request *arguments,
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

/* Length of the path without its ending, which ps_power_check_full has seen. */
static size_t stem_length(const char *path) {
    return strlen(path) - (sizeof array_ending - 1);
}

pspec_status ps_power_check_full(const ps_request *arguments, ps_error *error) {
    return arguments->full == NULL ? PSPEC_OK : ps_npy_check_name("--full", arguments->full, error);
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
