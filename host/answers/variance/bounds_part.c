/* --bounds: the variance by profiles below and above the power of each sampler. */
#include "answers/spectra/shape_table.h"
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"
#include "request/options.h"

static bool is_wanted(const ps_request *request) {
    return request->num_bounds > 0;
}

/* Profiles that are found have errors. */
static pspec_status check_errors(const ps_request *request, ps_error *error) {
    bool are_given = true;
    for (size_t i = 0; i < request->num_bounds; i++) {
        are_given = are_given && request->bounds[i].is_given;
    }
    return are_given || !ps_request_has_samplers(request) ||
                   request->num_realizations >= PS_FEWEST_FITTED_REALIZATIONS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s auto finds profiles by standard errors, which need %d realizations or "
                         "more (--realizations), not %llu",
                         ps_option_show(request, PS_OPTION_BOUNDS).text,
                         PS_FEWEST_FITTED_REALIZATIONS,
                         (unsigned long long)request->num_realizations);
}

static pspec_status check(const ps_request *request, ps_error *error) {
    const size_t num_sources = request->num_sources > 0 ? request->num_sources : 1;
    return request->num_bounds == 1 || request->num_bounds == num_sources
               ? check_errors(request, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s is there %zu times, and there %s: it is said once for all samplers, "
                         "or once for each of them, in their order",
                         ps_option_show(request, PS_OPTION_BOUNDS).text, request->num_bounds,
                         request->num_sources == 0 ? "are files" : "are not as many samplers");
}

static void fill(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand) {
    const ps_variance_row *const row = &jobs[question]->rows[integrand];
    (void)request;
    cells[0] = ps_number_or_missing(row->best_bound);
    cells[1] = ps_number_or_missing(row->worst_bound);
}

static pspec_status add_question(ps_table *table, const ps_variance_job *job, ps_error *error) {
    return ps_shape_add_profiles(table, &job->shape, &job->spectrum->spectrum, error);
}

const ps_variance_part ps_variance_part_bounds = {
    .columns = {"best_bound", "worst_bound"},
    .is_wanted = is_wanted,
    .with_errors = PS_NUM_OPTIONS,
    .check = check,
    .fill = fill,
    .add_question = add_question,
};
