/* pointspec power: the averaged periodogram. */
#include "cli/command.h"
#include "cli/jobs.h"
#include "report/power_table.h"
#include "report/spectrum_plot.h"

/* Beside those of the question. */
static const ps_option_id options[] = {
    PS_OPTION_DEVICE,  PS_OPTION_FULL,  PS_OPTION_OUTPUT,  PS_OPTION_FORMAT, PS_OPTION_PLOT,
    PS_OPTION_PROFILE, PS_OPTION_QUIET, PS_OPTION_VERBOSE, PS_OPTION_HELP,   PS_NUM_OPTIONS};

static pspec_status write_others(const ps_request *arguments, const ps_power_job *const *jobs,
                                 ps_error *error) {
    return arguments->full != NULL ? ps_power_write_full(arguments, jobs[0], error) : PSPEC_OK;
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    static const ps_jobs_output output = {ps_power_table, write_others};
    PS_TRY(ps_power_check_full(arguments, error));
    return ps_jobs_run(arguments, PS_QUESTION_POWER, &output, error);
}

const ps_command ps_command_power = {
    .name = "power",
    .summary = "averaged periodogram of point sets on the torus",
    .usage = "power [options] --sampler NAME | power [options] FILE...",
    .description =
        "Averages the periodogram P(k) = N |sum w exp(-2 pi i k.x)|^2 / (sum w)^2 over "
        "realizations "
        "and prints its mean over rings of width 1, with standard errors over the realizations. "
        "Files hold points of [0,1)^d; several files, and several sets in a file, are "
        "realizations. "
        "The default --tol of 1e-6 bounds the numerical error of S relative to white noise.",
    .result = &ps_result_power,
    .options = options,
    .examples = {"pointspec power --sampler jittered -n 1024 -m 100 -k 64",
                 "pointspec sample --sampler halton -n 256 | pointspec power -k 32 -"},
    .run = run,
};
