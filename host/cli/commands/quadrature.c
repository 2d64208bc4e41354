/* pointspec quadrature: quadrature spectrum and worst-case error of rules for a BRDF. */
#include "cli/command.h"
#include "cli/jobs.h"
#include "cli/output_check.h"
#include "cli/picture.h"
#include "report/quadrature_table.h"
#include "jobs/quadrature/quadrature_looks.h"

#include <stdio.h>

static void tell_plan(void *payload, const ps_plan *plan) {
    (void)payload;
    ps_print_plan(plan);
}

static void tell_profile(void *payload, const ps_profile_row *rows, size_t num_rows) {
    (void)payload;
    ps_print_profile(rows, num_rows);
}

static void warn_of_standard_error(const ps_quadrature_result *result, double standard_error) {
    char where[48];
    if (result->has_look && !(result->look.corrected <= standard_error)) {
        ps_quadrature_look_name(where, sizeof where, &result->look);
        fprintf(stderr,
                "pointspec: the standard error %.3g was not reached in %llu realizations: it is "
                "%.3g of %s\n",
                standard_error, (unsigned long long)result->num_realizations,
                result->look.corrected, where);
    }
}

static pspec_status run_job(ps_quadrature_result *result, const ps_request *arguments,
                            ps_quadrature_question *question, const ps_answer_hooks *hooks,
                            ps_error *error) {
    question->watch = hooks->watch;
    question->open_device = hooks->device;
    question->tell_plan = arguments->verbose ? tell_plan : NULL;
    question->tell_profile = arguments->profile ? tell_profile : NULL;
    return ps_quadrature_run(result, question, error);
}

static pspec_status run_shown(ps_quadrature_result *result, const ps_request *arguments,
                              ps_quadrature_question *question, ps_device *device,
                              ps_error *error) {
    ps_progress *const progress = ps_progress_begin(arguments, "realizations");
    const ps_answer_hooks hooks = {.watch = {ps_progress_tell, progress}, .device = device};
    const pspec_status status = run_job(result, arguments, question, &hooks, error);
    ps_progress_end(progress);
    if (status == PSPEC_OK && !arguments->quiet) {
        warn_of_standard_error(result, arguments->standard_error);
    }
    return status;
}

pspec_status ps_quadrature_answer(ps_table **out, const ps_request *request,
                                  const ps_answer_hooks *hooks, ps_error *error) {
    ps_quadrature_list list = {0};
    ps_quadrature_result result = {0};
    pspec_status status = ps_quadrature_list_make(&list, request, error);
    if (status == PSPEC_OK) {
        status = run_job(&result, request, &list.questions[0], hooks, error);
    }
    if (status == PSPEC_OK) {
        status = ps_quadrature_table(out, request, &list, &result, error);
    }
    ps_quadrature_free(&result);
    ps_quadrature_list_free(&list);
    return status;
}

static pspec_status write_results(const ps_request *arguments, const ps_quadrature_list *list,
                                  const ps_quadrature_result *results, ps_table_format format,
                                  ps_error *error) {
    ps_table *table = NULL;
    PS_TRY(ps_quadrature_table(&table, arguments, list, results, error));
    pspec_status status =
        ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format, error);
    ps_table_destroy(table);
    if (status == PSPEC_OK && arguments->plot != NULL) {
        status = ps_picture_settle(arguments, ps_quadrature_plot(arguments, list, results, error),
                                   error);
    }
    return status;
}

static pspec_status check_outputs(const ps_request *arguments, ps_table_format *format,
                                  ps_error *error) {
    PS_TRY(ps_picture_check(arguments, error));
    PS_TRY(ps_table_choose_format(format, arguments->format,
                                  arguments->output != NULL ? arguments->output : "-", error));
    return ps_outputs_check(arguments, true, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_table_format format = PS_FORMAT_CSV;
    ps_quadrature_list list = {0};
    ps_quadrature_result results[PS_MAX_SAMPLERS] = {{0}};
    pspec_status status = PSPEC_OK;
    PS_TRY(check_outputs(arguments, &format, error));
    ps_device *device = NULL;
    PS_TRY_OUT(status, ps_quadrature_list_make(&list, arguments, error));
    PS_TRY_OUT(status, ps_jobs_open_device(&device, arguments, &list.questions[0].constraints,
                                           list.num, error));
    for (size_t i = 0; i < list.num; i++) {
        PS_TRY_OUT(status, run_shown(&results[i], arguments, &list.questions[i], device, error));
    }
    status = write_results(arguments, &list, results, format, error);
out:
    for (size_t i = 0; i < list.num; i++) {
        ps_quadrature_free(&results[i]);
    }
    ps_quadrature_list_free(&list);
    ps_device_close(device);
    return status;
}

/* Beside those of the question. */
static const ps_option_id options[] = {PS_OPTION_DEVICE,  PS_OPTION_OUTPUT,  PS_OPTION_FORMAT,
                                       PS_OPTION_PLOT,    PS_OPTION_PROFILE, PS_OPTION_QUIET,
                                       PS_OPTION_VERBOSE, PS_OPTION_HELP,    PS_NUM_OPTIONS};

const ps_command ps_command_quadrature = {
    .name = "quadrature",
    .summary = "quadrature spectrum and worst-case error of rules for a BRDF",
    .usage = "quadrature --brdf NAME [options] --sampler NAME | quadrature --brdf NAME [options] "
             "FILE...",
    .description =
        "For directions u_j with weights w_j (1/N unless given) as a rule for the integral of "
        "light times a BRDF, averages over realizations d_l^2 = (b_l - c_l0)^2, C_l^2 = 2 "
        "sum_{m>0} |c_lm|^2, c_lm = sum_j w_j Y_lm(u_j), and their share a_l (d_l^2 + C_l^2) of "
        "the squared worst-case error E^2 over the unit ball of the Sobolev space H^S. The header "
        "has E by the kernel form, the root of the mean of E^2, and the rest of E^2 beyond degree "
        "L. Points of samplers of the hemisphere are morphed to the BRDF unless morph= says "
        "otherwise.",
    .result = &ps_result_quadrature,
    .options = options,
    .examples = {"pointspec quadrature --sampler fibonacci-hemisphere -n 256 --brdf diffuse "
                 "--smoothness 1.5 --weights optimal",
                 "pointspec quadrature --sampler white-hemisphere -n 64 -m 50 --brdf glossy:n=30 "
                 "-l 40"},
    .run = run,
};
