/* The averaged periodogram of sets on the torus. */
#include "answers/compare.h"
#include "answers/spectra/power_table.h"
#include "answers/spectra/scatter.h"
#include "answers/spectra/spectra.h"

#include <string.h>

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

/* Lists, and subsets of rings, fill no array. Pictures have no DC. */
static pspec_status take_array(ps_answer *out, const ps_spectrum *spectrum,
                               const ps_request *request, ps_error *error) {
    enum { PLANE = 2 };
    size_t num = 0;
    const ps_frequencies *const set = &spectrum->frequencies;
    if (set->kind != PS_FREQUENCIES_BOX || (set->dimension != PLANE && !request->wants_array)) {
        return PSPEC_OK;
    }
    const ps_mean dc = request->wants_array ? ps_power_dc(request, spectrum) : (ps_mean){0};
    PS_TRY(ps_spectrum_full(spectrum, 0, dc, &out->array, &num, error));
    out->rank = set->dimension;
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        out->shape[axis] = 2 * (size_t)set->max_frequency + 1;
    }
    return PSPEC_OK;
}

static pspec_status take_coefficients(ps_answer *out, const ps_power_job *job, ps_error *error) {
    ps_complex_shape shape;
    PS_TRY(ps_power_coefficients(job, &out->array, &shape, error));
    out->is_complex = true;
    out->rank = shape.rank;
    memcpy(out->shape, shape.shape, sizeof out->shape);
    return PSPEC_OK;
}

/* The row of every set that goes through the frequency of --scatter. */
static pspec_status take_scatter(ps_answer *out, const ps_frequencies_spec *asked,
                                 const ps_power_job *job, ps_error *error) {
    ps_scatter scatter;
    PS_TRY(ps_scatter_take(&scatter, &out->array, asked, job, error));
    out->is_complex = true;
    out->rank = 2;
    out->shape[0] = scatter.num_sets;
    out->shape[1] = 2 * (size_t)scatter.max_frequency + 1;
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_spectra *const spectra = computed;
    if (request->wants_coefficients) {
        PS_TRY(take_coefficients(out, spectra->jobs[0], error));
    } else if (request->frequencies.num_shown > 0) {
        PS_TRY(take_scatter(out, &request->frequencies, spectra->jobs[0], error));
    } else if (request->wants_picture || request->wants_array) {
        PS_TRY(take_array(out, ps_power_job_spectrum(spectra->jobs[0]), request, error));
    }
    return ps_spectra_tabulate(out, computed, request, ps_power_table, error);
}

static pspec_status write_others(const void *computed, const ps_request *request, ps_error *error) {
    const ps_spectra *const spectra = computed;
    if (request->full != NULL) {
        PS_TRY(ps_power_write_full(request, spectra->jobs[0], error));
    }
    return request->coefficients != NULL
               ? ps_power_write_coefficients(request, spectra->jobs[0], error)
               : PSPEC_OK;
}

static pspec_status draw(const void *computed, const ps_request *request, ps_error *error) {
    const ps_spectra *const spectra = computed;
    ps_text title = {0};
    if (request->frequencies.num_shown == 0) {
        return ps_spectra_draw(computed, request, error);
    }
    ps_spectrum_title(&title, request, (const ps_power_job *const *)spectra->jobs, 1);
    pspec_status status = ps_text_check(&title, error);
    if (status == PSPEC_OK) {
        status = ps_scatter_plot(request, spectra->jobs[0], ps_text_string(&title), error);
    }
    ps_text_free(&title);
    return status;
}

static const ps_line_kind axes = {NULL,
                                  "",
                                  "normalized_frequency",
                                  "power",
                                  "normalized frequency |k| N^{-1/d}",
                                  "radial mean power",
                                  false,
                                  false};

static const ps_field_row *const fields[] = {ps_fields_asked,
                                             ps_fields_points,
                                             ps_fields_powers,
                                             ps_fields_shape,
                                             ps_fields_profiles,
                                             ps_fields_computed,
                                             NULL};

const ps_kind ps_kind_power = {
    .name = "power",
    .bit = PS_VERB_BIT(power),
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
    .write_others = write_others,
    .draw = draw,
    .discard = ps_spectra_discard,
    .fields = fields,
    .summary = ps_spectra_summary,
    .spectrum = &axes,
    .compare = ps_compare_powers,
};
