#include "cli/question.h"

#include <string.h>

static pspec_status fail_conflict(const char *a, const char *b, const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not go with %s: %s", a, b, why);
}

static pspec_status check_source(const ps_arguments *arguments, ps_error *error) {
    if (arguments->num_samplers == 0 && arguments->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to take a spectrum of: name point files (- for standard input) or "
                       "a --sampler");
    }
    if (arguments->num_samplers > 0 && arguments->num_files > 0) {
        return fail_conflict("--sampler", arguments->files[0], "points come from one of them",
                             error);
    }
    static const struct {
        ps_option_id option;
        const char *name;
    } sampler_only[] = {{PS_OPTION_POINTS, "--points"},
                        {PS_OPTION_REALIZATIONS, "--realizations"},
                        {PS_OPTION_SEED, "--seed"},
                        {PS_OPTION_HOMOGENIZE, "--homogenize"}};
    for (size_t i = 0; i < sizeof sampler_only / sizeof sampler_only[0]; i++) {
        if (arguments->num_files > 0 && arguments->is_given[sampler_only[i].option]) {
            return fail_conflict(sampler_only[i].name, "point files",
                                 "it says what a --sampler makes", error);
        }
    }
    if (arguments->weights != NULL && strcmp(arguments->weights, "column") == 0 &&
        arguments->num_samplers > 0) {
        return fail_conflict("--weights column", "--sampler", "samplers make points only", error);
    }
    return PSPEC_OK;
}

static pspec_status check_results(const ps_arguments *arguments, ps_error *error) {
    if (arguments->frequencies != NULL) {
        if (arguments->max_frequency > 0) {
            return fail_conflict("--frequencies", "--max-frequency", "the list says it all", error);
        }
        if (arguments->shells) {
            return fail_conflict("--frequencies", "--shells", "a list is not averaged", error);
        }
        if (arguments->full != NULL) {
            return fail_conflict("--frequencies", "--full", "a list is not an array", error);
        }
        if (arguments->plot != NULL) {
            return fail_conflict("--frequencies", "--plot", "only grids are drawn", error);
        }
    }
    if (arguments->full != NULL && arguments->num_samplers > 1) {
        return fail_conflict("--full", "several samplers", "one array has one file", error);
    }
    return PSPEC_OK;
}

static void fill_points(ps_power_question *question, const ps_arguments *arguments) {
    const char *weights = arguments->weights;
    const bool is_word =
        weights == NULL || strcmp(weights, "column") == 0 || strcmp(weights, "equal") == 0;
    question->paths = arguments->files;
    question->num_paths = arguments->num_files;
    question->weights_path = is_word ? NULL : weights;
    question->point_options = (ps_point_options){
        .format = arguments->input_format,
        .dimension = arguments->is_given[PS_OPTION_DIMENSION] ? arguments->dimension : 0,
        .weight_column = weights != NULL && strcmp(weights, "column") == 0,
        .wrap = arguments->wrap,
    };
}

static ps_power_question make_question(const ps_arguments *arguments) {
    ps_power_question question = {
        .num_realizations = arguments->num_realizations,
        .max_frequency = arguments->max_frequency,
        .frequencies_path = arguments->frequencies,
        .exact_shells = arguments->shells,
        /* the picture of one spectrum shows the corners; several are drawn as curves only */
        .wants_full_array =
            arguments->full != NULL || (arguments->plot != NULL && arguments->num_samplers <= 1),
        .normalization =
            arguments->effective ? PSPEC_NORMALIZATION_EFFECTIVE : PSPEC_NORMALIZATION_POWER,
        .tolerance = arguments->tolerance,
        .floor = arguments->floor,
        .no_skip = arguments->no_skip,
        .no_self_check = arguments->no_self_check,
        .constraints = {.engine = arguments->engine, .precision = arguments->precision},
        .device = arguments->device,
        .profile = arguments->profile,
    };
    fill_points(&question, arguments);
    return question;
}

pspec_status ps_questions_make(ps_question_list *out, const ps_arguments *arguments,
                               ps_error *error) {
    PS_TRY(check_source(arguments, error));
    PS_TRY(check_results(arguments, error));
    out->num = arguments->num_samplers > 0 ? arguments->num_samplers : 1;
    for (size_t i = 0; i < out->num; i++) {
        out->questions[i] = make_question(arguments);
        if (arguments->num_samplers == 0) {
            continue;
        }
        ps_sampler_request *request = &out->requests[i];
        *request = (ps_sampler_request){.num_points = (size_t)arguments->num_points,
                                        .dimension = arguments->dimension,
                                        .seed = arguments->seed,
                                        .homogenize = arguments->homogenize};
        PS_TRY(ps_sampler_parse(request, arguments->samplers[i], error));
        PS_TRY(ps_sampler_check(request, error));
        out->questions[i].sampler = request;
    }
    return PSPEC_OK;
}
