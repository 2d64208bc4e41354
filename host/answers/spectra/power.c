/* The averaged periodogram of sets on the torus. */
#include "answers/spectra/power_table.h"
#include "answers/spectra/scatter.h"
#include "answers/spectra/spectra.h"

static pspec_status check_question(const ps_request *request, ps_error *error) {
    return ps_spectra_check(request, PS_QUESTION_POWER, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    return ps_spectra_plan(planner, request, PS_QUESTION_POWER, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_POWER, hooks, error);
}

/* The row of every set that goes through the frequency of --scatter. */
static pspec_status add_scatter(ps_table *table, const ps_frequencies_spec *asked,
                                const ps_power_job *job, ps_error *error) {
    ps_scatter scatter;
    ps_npy_array array = {.rank = 2, .is_complex = true};
    PS_TRY(ps_scatter_take(&scatter, &array.data, asked, job, error));
    array.shape[0] = scatter.num_sets;
    array.shape[1] = 2 * (size_t)scatter.max_frequency + 1;
    array.num = array.shape[0] * array.shape[1];
    return ps_table_add_array(table, "scatter", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_spectra *const spectra = computed;
    const ps_power_job *const job = spectra->jobs[0];
    PS_TRY(ps_spectra_tabulate(out, computed, request, ps_power_table, error));
    if (request->wants_coefficients || request->coefficients != NULL) {
        PS_TRY(ps_power_add_coefficients(out->table, job, error));
    }
    return request->frequencies.num_shown > 0
               ? add_scatter(out->table, &request->frequencies, job, error)
               : PSPEC_OK;
}

static pspec_status merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    return ps_spectra_merge(out, parts, ps_power_table, error);
}

static const ps_picture_kind pictures[] = {{.make = ps_spectra_figure,
                                            .by = PS_BY_SCENE,
                                            .x = "normalized_frequency",
                                            .y = {"power"},
                                            .x_label = "normalized frequency |k| N^{-1/d}",
                                            .y_label = "radial mean power",
                                            .is_spectrum = true,
                                            .error = "standard_error"},
                                           {.suffix = "-picture",
                                            .make = ps_spectra_figure,
                                            .dealing = PS_OF_EACH,
                                            .by = PS_BY_SCENE | PS_BY_COMMAND,
                                            .needs = PS_NEEDS_PICTURES,
                                            .x = "normalized_frequency",
                                            .y = {"power"},
                                            .y_label = "radial mean power",
                                            .is_spectrum = true,
                                            .error = "standard_error"},
                                           {.suffix = "-scatter",
                                            .make = ps_scatter_figure,
                                            .dealing = PS_OF_EACH,
                                            .by = PS_BY_SCENE | PS_BY_COMMAND,
                                            .needs = PS_NEEDS_SCATTER},
                                           {.make = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked,
                                             ps_fields_points,
                                             ps_fields_powers,
                                             ps_fields_shape,
                                             ps_fields_profiles,
                                             ps_fields_computed,
                                             NULL};

static const ps_compared_field compared[] = {
    {"power", "standard_error", false, ps_compared_power_bound}, {.value = NULL}};

const ps_kind ps_kind_power = {
    .name = "power",
    .purpose = "averaged periodogram of point sets on the torus",
    .usage = "power [options] --sampler NAME | power [options] FILE...",
    .description =
        "Averages the periodogram P(k) = N |sum w exp(-2 pi i k.x)|^2 / (sum w)^2 over "
        "realizations "
        "and prints its mean over rings of width 1, with standard errors over the realizations. "
        "In a box that is no cube (--box, or of the file) |k| is in cycles per edge of the cube "
        "of the same volume. "
        "Files hold points of [0,1)^d; several files, and several sets in a file, are "
        "realizations. "
        "The default --tol of 1e-6 bounds the numerical error of S relative to white noise.",
    .examples = {"pointspec power --sampler jittered -n 1024 -m 100 -k 64",
                 "pointspec sample --sampler halton -n 256 | pointspec power -k 32 -"},
    .takes = PS_COMMAND_BIT(power),
    .samples = PS_DOMAIN_TORUS,
    .counted = "realizations",
    .has_images = true,
    .has_arrays = true,
    .has_coefficients = true,
    .check_arguments = ps_power_check_arrays,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .merge = merge,
    .discard = ps_spectra_discard,
    .fields = fields,
    .summary = ps_spectra_summary,
    .pictures = pictures,
    .compared = compared,
};
