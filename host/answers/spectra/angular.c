/* The averaged angular power spectrum of sets on the sphere. */
#include "answers/compare.h"
#include "answers/spectra/angular_table.h"
#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "files/npy.h"

#include <string.h>

static pspec_status check_coefficients(const ps_request *request, ps_error *error) {
    if (request->coefficients == NULL) {
        return request->harmonics == NULL
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

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_ANGULAR, hooks, error);
}

static pspec_status take_coefficients(ps_answer *out, const ps_power_job *job, ps_error *error) {
    const size_t num = ps_num_coefficients_at(ps_power_job_problem(job)->frequencies);
    PS_TRY(PS_NEW(&out->array, num, "coefficients of an answer", error));
    memcpy(out->array, ps_power_job_coefficients(job), num * sizeof *out->array);
    out->is_complex = true;
    out->rank = 1;
    out->shape[0] = num / 2;
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_spectra *const spectra = computed;
    if (request->wants_coefficients) {
        PS_TRY(take_coefficients(out, spectra->jobs[0], error));
    }
    return ps_spectra_tabulate(out, computed, request, ps_angular_table, error);
}

static pspec_status write_others(const void *computed, const ps_request *request, ps_error *error) {
    const ps_spectra *const spectra = computed;
    if (request->coefficients == NULL) {
        return PSPEC_OK;
    }
    const ps_power_job *const job = spectra->jobs[0];
    const int32_t max_degree = ps_power_job_problem(job)->frequencies->max_frequency;
    return ps_npy_write_complex(request->coefficients, ps_num_coefficients(max_degree) / 2,
                                ps_power_job_coefficients(job), error);
}

static const ps_line_kind axes = {
    NULL, "", "normalized_degree", "power", "normalized degree l N^{-1/2}", "power", true, true};

const ps_result_kind ps_result_angular = {
    .name = "angular",
    .taker = PS_TAKER_BIT(angular),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .has_coefficients = true,
    .check_arguments = check_coefficients,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .write_others = write_others,
    .draw = ps_spectra_draw,
    .discard = ps_spectra_discard,
    .summary = ps_spectra_summary,
    .spectrum = &axes,
    .compare = ps_compare_powers,
};
