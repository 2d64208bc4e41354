#include "answers/spectra/spectra.h"

#include "answers/lead.h"
#include "answers/spectra/shape_table.h"
#include "base/memory.h"
#include "plots/plot.h"

#include <math.h>
#include <stdlib.h>

/* Pair sums are drawn as what they are relative to white noise, Q(l) / sum w^2. */
static double power_unit(const ps_power_job *job) {
    const ps_spectrum *spectrum = ps_power_job_spectrum(job);
    const double sum = spectrum->mean_weight_sum;
    const double unit = spectrum->sample_size.mean / (sum * sum);
    return ps_power_job_problem(job)->measure == PS_OF_PAIR_SUMS && isfinite(unit) ? unit : 1;
}

/* The profiles and the fit of a curve, behind its other columns. */
static pspec_status add_shape(ps_series *curve, double *columns, const ps_request *request,
                              const ps_spectrum *spectrum, ps_error *error) {
    const size_t num = spectrum->num_bins;
    double powers[PS_SHAPE_COLUMNS];
    ps_shape shape;
    PS_TRY(ps_shape_find(&shape, spectrum, request->fit_exponent, error));
    for (size_t b = 0; b < num; b++) {
        ps_shape_powers(powers, &shape, spectrum, &spectrum->bins[b]);
        for (size_t i = 0; i < PS_SHAPE_COLUMNS; i++) {
            columns[i * num + b] = powers[i];
        }
    }
    curve->low = columns;
    curve->high = columns + num;
    curve->fit = columns + 2 * num;
    return PSPEC_OK;
}

/* Columns of one curve, in one block: normalized frequency, power, standard error, anisotropy, and
 * those of its shape. */
static pspec_status make_curve(ps_series *curve, size_t number, const char *label,
                               const ps_request *request, const ps_power_job *job, void **block,
                               ps_error *error) {
    enum { COLUMNS = 4 };
    const ps_spectrum *spectrum = ps_power_job_spectrum(job);
    const size_t num = spectrum->num_bins;
    const double unit = power_unit(job);
    PS_TRY(
        ps_allocate(block, (COLUMNS + PS_SHAPE_COLUMNS) * num, sizeof(double), "a curve", error));
    double *columns = *block;
    for (size_t b = 0; b < num; b++) {
        columns[b] = spectrum->bins[b].normalized_frequency;
        columns[num + b] = spectrum->bins[b].power * unit;
        columns[2 * num + b] = spectrum->bins[b].standard_error * unit;
        columns[3 * num + b] = spectrum->bins[b].anisotropy_db;
    }
    *curve = (ps_series){.label = label,
                         .kind = number,
                         .num = num,
                         .x = columns,
                         .y = columns + num,
                         .error = columns + 2 * num,
                         .anisotropy = columns + 3 * num};
    return request->wants_fit ? add_shape(curve, columns + COLUMNS * num, request, spectrum, error)
                              : PSPEC_OK;
}

static pspec_status make_image(ps_plot_image *image, double **array, const ps_spectrum *spectrum,
                               ps_error *error) {
    size_t num_entries = 0;
    PS_TRY(ps_spectrum_full(spectrum, 0, (ps_mean){0}, array, &num_entries, error));
    *image = (ps_plot_image){2 * (size_t)spectrum->frequencies.max_frequency + 1, *array,
                             sqrt(spectrum->mean_points)};
    return PSPEC_OK;
}

/* Samplers choose N themselves where nside or the like says it. */
static void write_points(ps_text *title, const ps_power_job *const *jobs, size_t num) {
    double least = ps_power_job_spectrum(jobs[0])->mean_points;
    double most = least;
    for (size_t i = 1; i < num; i++) {
        const double points = ps_power_job_spectrum(jobs[i])->mean_points;
        least = fmin(least, points);
        most = fmax(most, points);
    }
    ps_text_append(title, ", N = %.6g", least);
    if (most > least) {
        ps_text_append(title, " to %.6g", most);
    }
}

void ps_spectrum_title(ps_text *title, const ps_request *arguments, const ps_power_job *const *jobs,
                       size_t num) {
    const ps_spectrum *first = ps_power_job_spectrum(jobs[0]);
    if (arguments->num_samplers > 1) {
        ps_text_append(title, "%zu samplers", arguments->num_samplers);
    } else if (arguments->num_samplers == 1) {
        ps_text_append(title, "%s", arguments->samplers[0]);
    } else if (arguments->num_files == 1) {
        ps_text_append(title, "%s", arguments->files[0]);
    } else {
        ps_text_append(title, "%zu files", arguments->num_files);
    }
    write_points(title, jobs, num);
    ps_text_append(title, ", %llu realization%s", (unsigned long long)first->num_realizations,
                   first->num_realizations == 1 ? "" : "s");
}

/* What tells the curve from the others. */
static pspec_status write_label(ps_text *label, const ps_request *arguments, size_t question,
                                ps_error *error) {
    const ps_lead lead = ps_lead_make(arguments, question);
    const char *const sampler = ps_request_sampler(arguments, question);
    ps_lead_label(&lead, label);
    if (lead.num == 0) {
        ps_text_append(label, "%s", sampler != NULL ? sampler : "mean");
    }
    return ps_text_check(label, error);
}

pspec_status ps_spectrum_plot(const ps_request *arguments, const ps_power_job *const *jobs,
                              size_t num, ps_error *error) {
    ps_series curves[PS_MAX_CURVES];
    ps_text labels[PS_MAX_CURVES] = {{0}};
    void *blocks[PS_MAX_CURVES] = {NULL};
    ps_plot_image image;
    double *array = NULL;
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    const ps_spectrum *first = ps_power_job_spectrum(jobs[0]);
    const bool on_sphere = first->frequencies.kind == PS_FREQUENCIES_DEGREES;
    const bool has_image =
        num == 1 && first->frequencies.dimension == 2 && arguments->frequencies.per_ring == 0;
    for (size_t i = 0; i < num; i++) {
        PS_TRY_OUT(status, write_label(&labels[i], arguments, i, error));
        PS_TRY_OUT(status, make_curve(&curves[i], i, ps_text_string(&labels[i]), arguments, jobs[i],
                                      &blocks[i], error));
    }
    if (has_image) {
        PS_TRY_OUT(status, make_image(&image, &array, first, error));
    }
    ps_spectrum_title(&title, arguments, jobs, num);
    PS_TRY_OUT(status, ps_text_check(&title, error));
    const double realizations = (double)first->num_realizations;
    const ps_panel panel = {NULL, num, curves};
    const ps_figure figure = {.form = PS_FIGURE_SPECTRA,
                              .title = ps_text_string(&title),
                              .num_panels = 1,
                              .panels = &panel,
                              .image = has_image ? &image : NULL,
                              .noise_level_db = realizations > 1 ? -10 * log10(realizations) : NAN,
                              .on_sphere = on_sphere,
                              .axes = arguments->plot_axes};
    PS_TRY_OUT(status, ps_figure_write(arguments->plot, &figure, error));
out:
    for (size_t i = 0; i < num; i++) {
        free(blocks[i]);
        ps_text_free(&labels[i]);
    }
    free(array);
    ps_text_free(&title);
    return status;
}
