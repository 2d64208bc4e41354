#include "cli/spectrum_plot.h"

#include "base/memory.h"
#include "io/plot.h"

#include <math.h>
#include <stdlib.h>

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

pspec_status ps_spectrum_plot(const ps_arguments *arguments, const ps_power_job *const *jobs,
                              size_t num, ps_error *error) {
    ps_plot_curve curves[PS_MAX_SAMPLERS];
    void *blocks[PS_MAX_SAMPLERS] = {NULL};
    ps_plot_image image;
    double *array = NULL;
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    const ps_spectrum *first = ps_power_job_spectrum(jobs[0]);
    const bool on_sphere = first->frequencies.kind == PS_FREQUENCIES_DEGREES;
    const bool has_image =
        num == 1 && first->frequencies.dimension == 2 && arguments->per_ring == 0;
    for (size_t i = 0; i < num; i++) {
        const char *label = arguments->num_samplers > 0 ? arguments->samplers[i] : "mean";
        PS_TRY_OUT(status, make_curve(&curves[i], label, ps_power_job_spectrum(jobs[i]), &blocks[i],
                                      error));
    }
    if (has_image) {
        PS_TRY_OUT(status, make_image(&image, &array, first, error));
    }
    write_title(&title, arguments, first, num);
    PS_TRY_OUT(status, ps_text_check(&title, error));
    const double realizations = (double)first->num_realizations;
    const ps_plot plot = {ps_text_string(&title),
                          num,
                          curves,
                          has_image ? &image : NULL,
                          realizations > 1 ? -10 * log10(realizations) : NAN,
                          on_sphere};
    PS_TRY_OUT(status, ps_plot_write(arguments->plot, &plot, error));
out:
    for (size_t i = 0; i < num; i++) {
        free(blocks[i]);
    }
    free(array);
    ps_text_free(&title);
    return status;
}
