/* The averaged angular power spectrum of sets on the sphere. */
#include "files/npy.h"
#include "report/angular_table.h"
#include "results/compare.h"
#include "results/spectra.h"

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

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
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
