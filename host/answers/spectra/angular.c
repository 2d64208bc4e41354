/* The averaged angular power spectrum of sets on the sphere. */
#include "answers/spectra/shape_table.h"
#include "answers/spectra/spectrum_header.h"
#include "answers/spectra/spectra.h"
#include "files/npy.h"

#include <string.h>

static pspec_status check_coefficients(const ps_request *request, ps_error *error) {
    if (request->coefficients == NULL) {
        return request->harmonics == NULL || request->wants_coefficients
                   ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                             "--harmonics is about --coefficients, which was not given");
    }
    return ps_npy_check_name("--coefficients", request->coefficients, error);
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    return ps_spectra_check(request, PS_QUESTION_ANGULAR, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    return ps_spectra_plan(planner, request, PS_QUESTION_ANGULAR, error);
}

static pspec_status look_ahead(ps_outlook *out, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error) {
    return ps_spectra_look_ahead(out, request, PS_QUESTION_ANGULAR, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_ANGULAR, hooks, error);
}

/* ---- the table ----------------------------------------------------------------------------- */

static const char *const columns[] = {"degree", "normalized_degree", "power", "standard_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_request *arguments,
                                const ps_measured *self, ps_error *error) {
    ps_shape shape = {0};
    const ps_spectrum *spectrum = self->spectrum;
    if (arguments->wants_fit) {
        PS_TRY(ps_shape_find(&shape, spectrum, arguments->fit_exponent, error));
        PS_TRY(ps_shape_add_header(table, &shape, spectrum, error));
    }
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        ps_cell cells[NUM_COLUMNS + PS_SHAPE_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->normalized_frequency),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
        };
        const size_t num = ps_shape_add_cells(cells, NUM_COLUMNS, arguments, &shape, spectrum, bin);
        PS_TRY(ps_lead_add_row(table, &self->lead, cells, num, error));
    }
    return PSPEC_OK;
}

static size_t choose_columns(const char **names, const ps_request *arguments,
                             const ps_measured *first) {
    (void)first;
    memcpy(names, columns, sizeof columns);
    return ps_shape_add_columns(names, NUM_COLUMNS, arguments);
}

static const ps_spectra_table table_kind = {"angular", choose_columns, add_degrees, NULL};

static pspec_status add_coefficients(ps_table *table, const ps_power_job *job, ps_error *error) {
    const size_t num = ps_num_coefficients_at(job->problem.frequencies);
    const size_t shape[] = {num / 2};
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, shape, true, error));
    memcpy(array.data, job->coefficients, num * sizeof *array.data);
    return ps_table_add_array(table, "coefficients", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_spectra *const spectra = computed;
    PS_TRY(ps_spectra_tabulate(out, computed, request, &table_kind, error));
    return request->wants_coefficients || request->coefficients != NULL
               ? add_coefficients(out->table, spectra->jobs[0], error)
               : PSPEC_OK;
}

static pspec_status merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    return ps_spectra_merge(out, parts, &table_kind, error);
}

static const ps_picture_kind pictures[] = {
    {.make = ps_spectra_figure,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .x = "normalized_degree",
     .lines = {{.y = "power", .error = "standard_error", .low = "lower", .high = "upper"}},
     .x_label = "normalized degree l N^{-1/2}",
     .y_label = "power",
     .is_log_x = true,
     .is_log_y = true,
     .is_spectrum = true},
    {.suffix = "-points",
     .make = ps_first_sets_figure,
     .dealing = PS_OF_SETS,
     .by = PS_BY_SCENE,
     .needs = PS_NEEDS_FILES},
    {.make = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,    ps_fields_points, ps_fields_powers,   ps_fields_shape,
    ps_fields_profiles, ps_fields_ranges, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {
    {"power", "standard_error", false, ps_compared_power_bound}, {.value = NULL}};

static const char *const sentences[] = {"convergence", "features", NULL};

const ps_kind ps_kind_angular = {
    .name = "angular",
    .purpose = "averaged angular power spectrum of point sets on the sphere",
    .usage = "angular [options] --sampler NAME | angular [options] FILE...",
    .description =
        "Averages P(l) = N Q(l) / (sum w)^2 over realizations, where Q(l) = sum_ij w_i w_j "
        "P_l(u_i.u_j) = 4 pi / (2l + 1) sum_m |sum_j w_j Y_lm(u_j)|^2, and prints it for the "
        "degrees 1..L with standard errors over the realizations; white noise has 1 everywhere. "
        "Files hold unit vectors or angles; several files, and several sets in a file, are "
        "realizations. With --hemisphere a point stands for its direction and the opposite one: "
        "even degrees only. The default --tol of 1e-6 bounds the numerical error of the "
        "coefficients relative to white noise.",
    .examples = {"pointspec angular --sampler healpix-jittered:nside=8 -m 100 -l 64",
                 "pointspec sample --sampler fibonacci -n 256 | pointspec angular -l 32 -"},
    .takes = PS_COMMAND_BIT(angular),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .has_coefficients = true,
    .check_arguments = check_coefficients,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .merge = merge,
    .look_ahead = look_ahead,
    .discard = ps_spectra_discard,
    .renews = true,
    .fields = fields,
    .summary = ps_spectra_summary,
    .has_images = true,
    .pictures = pictures,
    .sentences = sentences,
    .compared = compared,
};
