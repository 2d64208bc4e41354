/* pointspec angular: the averaged angular power spectrum. */
#include "report/angular_table.h"
#include "cli/command.h"
#include "cli/jobs.h"
#include "cli/output_check.h"
#include "files/npy.h"

/* Beside those of the question. */
static const ps_option_id options[] = {
    PS_OPTION_DEVICE,  PS_OPTION_COEFFICIENTS, PS_OPTION_HARMONICS, PS_OPTION_OUTPUT,
    PS_OPTION_FORMAT,  PS_OPTION_PLOT,         PS_OPTION_PROFILE,   PS_OPTION_QUIET,
    PS_OPTION_VERBOSE, PS_OPTION_HELP,         PS_NUM_OPTIONS};

static pspec_status write_coefficients(const char *path, const ps_power_job *job, ps_error *error) {
    const int32_t max_degree = ps_power_job_problem(job)->frequencies->max_frequency;
    return ps_npy_write_complex(path, ps_num_coefficients(max_degree) / 2,
                                ps_power_job_coefficients(job), error);
}

static pspec_status write_others(const ps_request *arguments, const ps_power_job *const *jobs,
                                 ps_error *error) {
    return arguments->coefficients != NULL
               ? write_coefficients(arguments->coefficients, jobs[0], error)
               : PSPEC_OK;
}

static pspec_status check_coefficients(const ps_request *arguments, ps_error *error) {
    if (arguments->coefficients == NULL) {
        return arguments->harmonics == NULL
                   ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                             "--harmonics is about --coefficients, which was not given");
    }
    if (arguments->num_samplers > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--coefficients are of one set, but %zu samplers were given",
                       arguments->num_samplers);
    }
    return ps_output_check_ending("--coefficients", arguments->coefficients, ".npy", error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    static const ps_jobs_output output = {ps_angular_table, write_others};
    PS_TRY(check_coefficients(arguments, error));
    return ps_jobs_run(arguments, PS_QUESTION_ANGULAR, &output, error);
}

const ps_command ps_command_angular = {
    .name = "angular",
    .summary = "averaged angular power spectrum of point sets on the sphere",
    .usage = "angular [options] --sampler NAME | angular [options] FILE...",
    .description =
        "Averages P(l) = N Q(l) / (sum w)^2 over realizations, where Q(l) = sum_ij w_i w_j "
        "P_l(u_i.u_j) = 4 pi / (2l + 1) sum_m |sum_j w_j Y_lm(u_j)|^2, and prints it for the "
        "degrees 1..L with standard errors over the realizations; white noise has 1 everywhere. "
        "Files hold unit vectors or angles; several files, and several sets in a file, are "
        "realizations. With --hemisphere a point stands for its direction and the opposite one: "
        "even degrees only. The default --tol of 1e-6 bounds the numerical error of the "
        "coefficients relative to white noise.",
    .result = &ps_result_angular,
    .options = options,
    .examples = {"pointspec angular --sampler healpix-jittered:nside=8 -m 100 -l 64",
                 "pointspec sample --sampler fibonacci -n 256 | pointspec angular -l 32 -"},
    .run = run,
};
