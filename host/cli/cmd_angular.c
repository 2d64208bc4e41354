/* pointspec angular: the averaged angular power spectrum. */
#include "cli/angular_table.h"
#include "cli/command.h"
#include "cli/jobs.h"
#include "cli/spectrum_plot.h"

static const ps_option_id options[] = {PS_OPTION_SAMPLER,      PS_OPTION_POINTS,
                                       PS_OPTION_REALIZATIONS, PS_OPTION_SEED,
                                       PS_OPTION_HOMOGENIZE,   PS_OPTION_WEIGHTS,
                                       PS_OPTION_INPUT_FORMAT, PS_OPTION_COLUMNS,
                                       PS_OPTION_SELECT_SETS,  PS_OPTION_NORMALIZE_VECTORS,
                                       PS_OPTION_MAX_DEGREE,   PS_OPTION_HEMISPHERE,
                                       PS_OPTION_NORMALIZE,    PS_OPTION_TOLERANCE,
                                       PS_OPTION_FLOOR,        PS_OPTION_PRECISION,
                                       PS_OPTION_ENGINE,       PS_OPTION_DEVICE,
                                       PS_OPTION_NO_SKIP,      PS_OPTION_NO_SELF_CHECK,
                                       PS_OPTION_OUTPUT,       PS_OPTION_FORMAT,
                                       PS_OPTION_PLOT,         PS_OPTION_PROFILE,
                                       PS_OPTION_QUIET,        PS_OPTION_VERBOSE,
                                       PS_OPTION_HELP,         PS_NUM_OPTIONS};

static pspec_status write_results(const ps_arguments *arguments, const ps_power_job *const *jobs,
                                  size_t num, ps_table_format format, ps_error *error) {
    ps_table *table = NULL;
    if (arguments->plot != NULL) {
        PS_TRY(ps_spectrum_plot(arguments, jobs, num, error));
    }
    PS_TRY(ps_angular_table(&table, arguments, jobs, num, error));
    const pspec_status status =
        ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format, error);
    ps_table_destroy(table);
    return status;
}

static pspec_status run(const ps_arguments *arguments, ps_error *error) {
    return ps_jobs_run(arguments, PS_DOMAIN_SPHERE, write_results, error);
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
    .options = options,
    .examples = {"pointspec angular --sampler healpix-jittered:nside=8 -m 100 -l 64",
                 "pointspec sample --sampler fibonacci -n 256 | pointspec angular -l 32 -"},
    .samples = PS_DOMAIN_SPHERE,
    .run = run,
};
