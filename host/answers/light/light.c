/* What functions of the sphere are like, as maps of light: their powers by degree, a few numbers,
 * and their images. */
#include "answers/interpolation/interpolation.h"
#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "math/pi.h"
#include "request/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Coefficients of more degrees would be limited by the pixels of most maps. */
enum { DEFAULT_DEGREE = 64, MOST_DEGREE = 1000 };

typedef struct functions {
    ps_panorama panorama;
    size_t max_degree;
    double *powers; /* [functions][max_degree + 1]: sum_m |F_lm|^2 */
} functions;

static void release(functions *self) {
    ps_panorama_free(&self->panorama);
    free(self->powers);
}

static void discard(void *computed) {
    functions *const self = computed;
    if (self != NULL) {
        release(self);
        free(self);
    }
}

/* ---- question ------------------------------------------------------------------------------ */

static pspec_status check_arguments(const ps_request *request, ps_error *error) {
    PS_TRY(ps_request_check_no_files(request, "", error));
    if (request->num_integrands == 0 || request->integrands_given.num > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--integrand NAME is what is shown, as in --integrand map:file=sky.hdr, "
                       "and %s",
                       request->num_integrands == 0 ? "none was given"
                                                    : "powers of one of the caller are not known");
    }
    if (request->max_degree > MOST_DEGREE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: degree %llu is more than %d",
                       ps_option_show(request, PS_OPTION_MAX_DEGREE).text,
                       (unsigned long long)request->max_degree, MOST_DEGREE);
    }
    return PSPEC_OK;
}

static pspec_status ask(functions *self, const ps_request *request, ps_error *error) {
    PS_TRY(check_arguments(request, error));
    self->max_degree = request->max_degree > 0 ? (size_t)request->max_degree : DEFAULT_DEGREE;
    return ps_panorama_make(&self->panorama, request->integrands_made, &request->integrands_given,
                            request->integrands, request->num_integrands, error);
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    functions self = {0};
    const pspec_status status = ask(&self, request, error);
    release(&self);
    return status;
}

/* A value of a pixel, and a row of pixels in a coefficient, which takes as long as `own_rows` of
 * them by itself: maps of 1024 x 512 and 256 x 128 to degrees 250, 500 and 1000, one core, AVX-512.
 */
static const double pixel_seconds = 8e-8, row_seconds = 1e-8, own_rows = 128;

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    functions self = {0};
    const ps_panorama *const panorama = &self.panorama;
    ps_phases phases = ps_plan_table_begin_phases(planner);
    pspec_status status = ask(&self, request, error);
    if (status == PSPEC_OK) {
        const double height = (double)panorama->height;
        const double pixels = (double)panorama->num * (double)panorama->width * height;
        const double degrees = (double)self.max_degree + 1;
        const double coefficients = (double)panorama->num * degrees * degrees / 2;
        ps_phases_add(&phases, "values", pixel_seconds * pixels);
        ps_phases_say(&phases, "values", "%.4g pixels", pixels);
        ps_phases_add(&phases, "powers", row_seconds * (height + own_rows) * coefficients);
        ps_phases_say(&phases, "powers", "%.4g coefficients", coefficients);
        ps_phases_limit(&phases, "powers");
        ps_phases_tabulate(&phases, (double)panorama->num * degrees);
        ps_plan_table_add_picture(&phases, request);
        status = ps_plan_table_add_host(planner, &phases, pixels * sizeof(double),
                                        "powers of the functions, in double precision", error);
    }
    release(&self);
    return status;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(functions), "an answer", error));
    functions *const self = *out;
    ps_answer_begin_next(hooks);
    PS_TRY(ask(self, request, error));
    PS_TRY(ps_panorama_fill(&self->panorama, error));
    const size_t num = self->max_degree + 1;
    PS_TRY(PS_NEW(&self->powers, self->panorama.num * num, "powers", error));
    for (size_t f = 0; f < self->panorama.num; f++) {
        PS_TRY(ps_integrand_degrees(self->panorama.integrands[f], self->max_degree,
                                    self->powers + f * num, error));
    }
    return PSPEC_OK;
}

/* ---- the table: a row for every function and degree ------------------------------------------ */

static pspec_status add_function(ps_table *table, const ps_request *request,
                                 const ps_panorama *panorama, size_t f, ps_error *error) {
    const ps_integrand *const integrand = panorama->integrands[f];
    const size_t num = panorama->width * panorama->height;
    const double *const values = panorama->values + f * num;
    double least = INFINITY;
    double largest = -INFINITY;
    for (size_t i = 0; i < num; i++) {
        least = fmin(least, values[i]);
        largest = fmax(largest, values[i]);
    }
    const ps_meta entries[] = {
        {"mean", PS_NUMBER(ps_integrand_integral(integrand) / PS_FOUR_PI)},
        {"energy", PS_NUMBER(ps_integrand_energy(integrand))},
        {"least", PS_NUMBER(least)},
        {"largest", PS_NUMBER(largest)},
    };
    PS_TRY(ps_header_add_integrand(table, request->integrands[f], integrand, error));
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_header(ps_table *table, const ps_request *request,
                               const ps_panorama *panorama, ps_error *error) {
    char pixels[64];
    snprintf(pixels, sizeof pixels, "%zu x %zu", panorama->width, panorama->height);
    const ps_meta entries[] = {{"pixels", PS_TEXT(pixels)},
                               {"device", PS_TEXT("none")},
                               {"engine", PS_TEXT("host")},
                               {"precision", PS_TEXT("double")},
                               {"skipped", PS_TEXT("none")}};
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    for (size_t f = 0; f < panorama->num; f++) {
        PS_TRY(add_function(table, request, panorama, f, error));
    }
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* From `first` on: the column of integrands is there where there are several. */
static pspec_status add_rows(ps_table *table, const functions *self, const ps_request *request,
                             size_t f, size_t first, ps_error *error) {
    const double *const powers = self->powers + f * (self->max_degree + 1);
    const double energy = ps_integrand_energy(self->panorama.integrands[f]);
    const double rounding = 1e-28 * powers[0]; /* of the mean: what a constant has */
    double held = 0;
    for (size_t l = 0; l <= self->max_degree; l++) {
        held += l > 0 ? powers[l] : 0;
        const ps_cell cells[] = {PS_TEXT(request->integrands[f]), PS_INTEGER(l),
                                 PS_NUMBER(powers[l] / (2 * (double)l + 1)),
                                 ps_number_or_missing(energy > rounding ? held / energy : NAN)};
        PS_TRY(ps_table_add_row(table, cells + first, error));
    }
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    static const char *const columns[] = {"integrand", "degree", "power", "share"};
    const functions *const self = computed;
    const ps_panorama *const panorama = &self->panorama;
    const size_t first = panorama->num > 1 ? 0 : 1;
    PS_TRY(ps_table_create(&out->table, "light", columns + first,
                           sizeof columns / sizeof columns[0] - first, error));
    PS_TRY(add_header(out->table, request, panorama, error));
    for (size_t f = 0; f < panorama->num; f++) {
        PS_TRY(add_rows(out->table, self, request, f, first, error));
    }
    return request->wants_array || request->wants_picture || request->wants_state ||
                   request->plot != NULL
               ? ps_interpolation_add_light(out->table, panorama, error)
               : PSPEC_OK;
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static void write_title(ps_text *out, const ps_request *request, const ps_table *table) {
    const ps_cell pixels = ps_table_find_meta(table, "pixels");
    if (request->num_integrands > 1) {
        ps_text_append(out, "%zu functions of the sphere", request->num_integrands);
    } else {
        ps_text_append(out, "%s", request->integrands[0]);
    }
    ps_text_append(out, ", %s pixels", ps_cell_text(pixels));
}

static const char *const summary[] = {"integrand", "mean", "energy", "least", "largest", NULL};
static const ps_picture_kind pictures[] = {{.suffix = "-image",
                                            .make = ps_interpolation_figure,
                                            .dealing = PS_OF_SETS,
                                            .by = PS_BY_SCENE | PS_BY_COMMAND,
                                            .needs = PS_NEEDS_PICTURES,
                                            .arrays = {{"light", PS_FRAME_LIGHT}},
                                            .write_title = write_title},
                                           {.suffix = "-power",
                                            .what = "power of light",
                                            .make = ps_lines_figure,
                                            .by = PS_BY_SCENE | PS_BY_COMMAND,
                                            .needs = PS_NEEDS_DEGREE,
                                            .x = "degree",
                                            .lines = {{.y = "power"}},
                                            .x_label = "degree l",
                                            .y_label = "power P_F(l)",
                                            .is_log_x = true,
                                            .is_log_y = true,
                                            .write_title = write_title},
                                           {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"integrand", "", PS_ENTRIES, 0, "", "a function"},
    {"integral", "", PS_ENTRIES, 0, "", "its integral over the sphere"},
    {"mean", "", PS_ENTRIES, 0, "", "that over 4 pi"},
    {"energy", "", PS_ENTRIES, 0, "", "int F^2 - (int F)^2/(4 pi), what all degrees but 0 hold"},
    {"least", "", PS_ENTRIES, 0, "", "the least value at the centre of any pixel"},
    {"largest", "", PS_ENTRIES, 0, "", "the largest value there"},
    {"integrand_note", "", PS_ENTRIES, 0, "where there is something to say",
     "what else there is to know of it"},
    {"pixels", "", PS_ENTRY, 0, "",
     "width x height of the image: that of the maps, else 512 x 256"},
    {"integrand", "", PS_COLUMN, 0, "several integrands", "the integrand"},
    {"degree", "", PS_COLUMN, 0, "", "l"},
    {"power", "", PS_COLUMN, 0, "", "P_F(l) = sum_m |F_lm|^2/(2l+1)"},
    {"share", "", PS_COLUMN, 0, "",
     "what degrees 1 to l hold of the energy; missing of a function that is constant"},
    {"light", "", PS_ARRAY, 0, "NPZ, pictures, arrays",
     "the functions at the centres of the pixels: integrands x height x width"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked, own_fields, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"degree", NULL, false, NULL}, {.value = NULL}};

const ps_kind ps_kind_light = {
    .name = "light",
    .purpose = "powers by degree of maps of light, their means and extremes, and images",
    .usage = "light --integrand NAME[:key=value,...] [options]",
    .description =
        "Prints for l = 0, 1, ... the power of a function F of the sphere, such as a map of light, "
        "P_F(l) = sum_m |F_lm|^2/(2l+1), and the share of the energy int F^2 - (int F)^2/(4 pi) "
        "that degrees 1 to l hold; the header has the integral, the mean and the energy, and the "
        "least and the largest value at the pixels of the map, else of an image of 512 x 256.",
    .examples = {"echo 1,0,1,0 >light.txt; pointspec light --integrand coefficients:file=light.txt "
                 "--integrand square -l 4",
                 "pointspec light --integrand cap:angle=0.5 -l 200 --format json"},
    .takes = PS_COMMAND_BIT(light),
    .counted = "degrees",
    .samples = PS_DOMAIN_SPHERE,
    .is_of_host = true,
    .has_images = true,
    .has_arrays = true,
    .check_arguments = check_arguments,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .compared = compared,
};
