#include "answers/check/saved_spectrum.h"

#include "base/memory.h"
#include "files/input_file.h"
#include "request/file_list.h"
#include "spectra/compare.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- bins ---------------------------------------------------------------------------------- */

pspec_status ps_saved_spectrum_copy_bins(ps_saved_spectrum *out, const ps_spectrum *averages,
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

/* ---- tables ------------------------------------------------------------------------------ */

/* What a table says by its columns and numbers of points: weights are taken to be equal. */
static void complete(ps_saved_spectrum *out) {
    const ps_frequencies set = {.kind =
                                    out->on_sphere ? PS_FREQUENCIES_DEGREES : PS_FREQUENCIES_BOX,
                                .dimension = out->dimension,
                                .max_frequency = out->max_frequency,
                                .degree_step = out->on_hemisphere ? 2 : 1};
    const uint64_t most = out->per_ring > 0 ? 2 * out->per_ring : UINT64_MAX;
    out->sample_size = out->mean_points;
    /* a subset has those of its rings */
    out->modes = out->per_ring > 0 ? 0 : ps_compared_modes(&set);
    for (size_t b = 0; b < out->num_bins; b++) {
        ps_saved_bin *const bin = &out->bins[b];
        bin->num_computed = bin->count < most ? bin->count : most;
        out->modes += out->per_ring > 0 ? (double)bin->num_computed : 0;
    }
}

static pspec_status read_table(ps_saved_spectrum *out, const char *path, ps_error *error) {
    ps_table *table = NULL;
    PS_TRY(ps_table_read_npz(&table, path, error));
    const pspec_status status = ps_saved_table_take(out, table, path, error);
    ps_table_destroy(table);
    if (status == PSPEC_OK) {
        complete(out);
    }
    return status;
}

/* ---- which ------------------------------------------------------------------------------- */

/* A stream would lose what is looked at, and points may come by one. */
pspec_status ps_saved_spectrum_find(bool *is_one, const char *path, ps_error *error) {
    struct stat facts;
    ps_error reason = {0};
    *is_one = false;
    if (strcmp(path, "-") == 0) {
        return PSPEC_OK;
    }
    if (stat(path, &facts) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    }
    *is_one = ps_table_is_npz(path);
    const pspec_status status = *is_one ? PSPEC_OK : ps_saved_result_find(is_one, path, &reason);
    return status == PSPEC_OK || status == PSPEC_ERROR_INPUT
               ? PSPEC_OK
               : ps_fail(error, status, "%s", reason.message);
}

/* What cannot be read is told as such. */
static pspec_status refuse_other(const char *path, ps_error *error) {
    ps_input input = {0};
    const pspec_status status = ps_input_open(&input, path, error);
    ps_input_close(&input);
    return status != PSPEC_OK ? status
                              : ps_fail(error, PSPEC_ERROR_INPUT,
                                        "\"%s\" is no saved spectrum: pointspec power and angular "
                                        "save one with -o FILE.npz",
                                        path);
}

pspec_status ps_saved_spectrum_read(ps_saved_spectrum *out, const char *path, ps_error *error) {
    *out = (ps_saved_spectrum){0};
    if (strcmp(path, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a saved spectrum is a file, and standard input is none");
    }
    const pspec_status status =
        ps_table_is_npz(path) ? read_table(out, path, error) : refuse_other(path, error);
    if (status != PSPEC_OK) {
        ps_saved_spectrum_free(out);
    }
    return status;
}

void ps_saved_spectrum_free(ps_saved_spectrum *saved) {
    free(saved->bins);
    *saved = (ps_saved_spectrum){0};
}
