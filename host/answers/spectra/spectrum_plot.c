#include "answers/spectra/spectra.h"

#include "answers/lead.h"
#include "answers/points/points_picture.h"
#include "answers/spectra/shape_table.h"
#include "answers/spectra/spectrum_header.h"
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

static const char *label_powers(const ps_power_job *job) {
    const bool on_sphere = ps_power_job_spectrum(job)->frequencies.kind == PS_FREQUENCIES_DEGREES;
    return ps_power_job_problem(job)->measure == PS_OF_PAIR_SUMS ? "Legendre sum / Σ w^2"
           : on_sphere                                           ? "power"
                                                                 : "radial mean power";
}

/* Of the powers as they are drawn: what the numerical error of S alone would make. */
static double find_floor(const ps_power_job *job, double unit) {
    const ps_spectrum *const spectrum = ps_power_job_spectrum(job);
    const double error = ps_power_job_accuracy(job)->error;
    const double sum = spectrum->mean_weight_sum;
    return ps_power_job_problem(job)->measure == PS_OF_PAIR_SUMS ? error * sum * sum * unit
                                                                 : error * error;
}

/* A set that is the same every time has no noise. */
static double count_noisy(const ps_power_job *job) {
    const uint64_t num = ps_power_job_spectrum(job)->num_realizations;
    return ps_power_job_needs(job)->one_realization ? 1 : (double)num;
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
                         .anisotropy = columns + 3 * num,
                         .num_realizations = count_noisy(job),
                         .floor = find_floor(job, unit)};
    return request->wants_fit ? add_shape(curve, columns + COLUMNS * num, request, spectrum, error)
                              : PSPEC_OK;
}

static pspec_status make_image(ps_plot_image *image, double **array, const ps_spectrum *spectrum,
                               ps_error *error) {
    size_t num_entries = 0;
    PS_TRY(ps_spectrum_full(spectrum, 0, (ps_mean){0}, array, &num_entries, error));
    *image = (ps_plot_image){.size = 2 * (size_t)spectrum->frequencies.max_frequency + 1,
                             .power = *array,
                             .unit = sqrt(spectrum->mean_points)};
    return PSPEC_OK;
}

/* One view of the first set: of more dimensions the first two coordinates, of the sphere the half
 * above. */
static pspec_status make_points(ps_points_picture *picture, const ps_power_job *job,
                                ps_figure *figure, ps_error *error) {
    const ps_point_set *const set = ps_power_job_first_set(job);
    ps_figure own;
    if (set == NULL) {
        return PSPEC_OK;
    }
    const ps_drawn_set drawn = {"the first set",
                                set->coordinates == PS_UNIT_VECTORS ? PS_SAMPLES_HEMISPHERE
                                                                    : PS_SAMPLES_TORUS,
                                set->dimension, set->num_points, set->points};
    PS_TRY(ps_points_picture_add(picture, &drawn, &(ps_watch){0}, error));
    PS_TRY(ps_points_picture_figure(picture, "", &own, error));
    figure->points = own.panels;
    figure->frames = own.frames;
    return PSPEC_OK;
}

/* Samplers choose N themselves where nside or the like says it; of sets with different N it is a
 * mean, and which they have is said. */
static void write_points(ps_text *title, const ps_power_job *const *jobs, size_t num) {
    ps_points_span span = {0};
    for (size_t i = 0; i < num; i++) {
        const ps_spectrum *const own = ps_power_job_spectrum(jobs[i]);
        ps_points_span_add(
            &span, &(ps_points_range){own->mean_points, own->smallest_points, own->largest_points});
    }
    ps_points_span_show(&span, title);
}

/* Where a standard error was asked for, each has as many as that takes. */
static void write_realizations(ps_text *title, const ps_power_job *const *jobs, size_t num) {
    uint64_t least = ps_power_job_spectrum(jobs[0])->num_realizations;
    uint64_t most = least;
    for (size_t i = 1; i < num; i++) {
        const uint64_t own = ps_power_job_spectrum(jobs[i])->num_realizations;
        least = own < least ? own : least;
        most = own > most ? own : most;
    }
    ps_text_append(title, ", %llu", (unsigned long long)least);
    if (most > least) {
        ps_text_append(title, " to %llu", (unsigned long long)most);
    }
    ps_text_append(title, " realization%s", most == 1 ? "" : "s");
}

void ps_spectrum_title(ps_text *title, const ps_request *arguments, const ps_power_job *const *jobs,
                       size_t num) {
    if (arguments->num_sources > 1) {
        ps_text_append(title, "%zu %s", arguments->num_sources,
                       ps_request_has_files(arguments) ? "sets of points" : "samplers");
    } else if (arguments->num_sources == 1) {
        ps_text_append(title, "%s", ps_request_source_name(arguments, 0));
    } else if (arguments->num_files == 1) {
        ps_text_append(title, "%s", arguments->files[0]);
    } else {
        ps_text_append(title, "%zu files", arguments->num_files);
    }
    write_points(title, jobs, num);
    write_realizations(title, jobs, num);
}

/* What tells the curve from the others. */
static pspec_status write_label(ps_text *label, const ps_request *arguments, size_t question,
                                ps_error *error) {
    const ps_lead lead = ps_lead_make(arguments, question);
    const char *const name = ps_request_name(arguments, question);
    ps_lead_label(&lead, label);
    if (lead.num == 0) {
        ps_text_append(label, "%s", name != NULL ? name : "mean");
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
    ps_points_picture points = {.num_sets = 2}; /* of several: the panel says what it is */
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
    const ps_panel panel = {NULL, num, curves};
    ps_figure figure = {.form = PS_FIGURE_SPECTRA,
                        .title = ps_text_string(&title),
                        .y_label = label_powers(jobs[0]),
                        .num_panels = 1,
                        .panels = &panel,
                        .image = has_image ? &image : NULL,
                        .on_sphere = on_sphere,
                        .axes = arguments->plot_axes};
    PS_TRY_OUT(status, make_points(&points, jobs[0], &figure, error));
    PS_TRY_OUT(status, ps_figure_write(arguments->plot, &figure, error));
out:
    for (size_t i = 0; i < num; i++) {
        free(blocks[i]);
        ps_text_free(&labels[i]);
    }
    free(array);
    ps_points_picture_free(&points);
    ps_text_free(&title);
    return status;
}
