#include "request/point_source.h"

#include "request/options.h"

#include <string.h>

static pspec_status fail_conflict(const char *a, const char *b, const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not go with %s: %s", a, b, why);
}

pspec_status ps_programs_refuse(const char *option, ps_error *error) {
    return fail_conflict(option, "programs", "nobody knows whether they will print the same",
                         error);
}

/* Options that are about the other kind of source, where there is but one kind. */
static pspec_status check_other_source(const ps_request *arguments, ps_error *error) {
    const bool are_files = ps_request_has_files(arguments);
    const ps_option_source other = are_files ? PS_OF_SAMPLERS : PS_OF_FILES;
    if (arguments->homogenize && ps_request_has_programs(arguments) &&
        !ps_request_has_samplers(arguments)) {
        return fail_conflict("--homogenize", "programs", "it moves the points of samplers", error);
    }
    if (arguments->is_given[PS_OPTION_RANGE] && ps_request_has_programs(arguments)) {
        return ps_programs_refuse(ps_option_show(arguments, PS_OPTION_RANGE).text, error);
    }
    if (are_files && ps_request_has_told(arguments)) {
        return PSPEC_OK;
    }
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const bool is_of_both =
            id == PS_OPTION_SEED && (arguments->frequencies.per_ring > 0 ||
                                     arguments->num_integrands > 0 || arguments->mesh != NULL);
        if (!arguments->is_given[id] || ps_options[id].source != other || is_of_both) {
            continue;
        }
        const ps_shown_option shown = ps_option_show(arguments, (ps_option_id)id);
        return are_files
                   ? fail_conflict(shown.text, "point files", "it says what samplers make", error)
                   : fail_conflict(shown.text, ps_option_show(arguments, PS_OPTION_SAMPLER).text,
                                   "it says how point files are read", error);
    }
    return PSPEC_OK;
}

static pspec_status check_lift(const ps_request *arguments, ps_error *error) {
    return arguments->reading.morph.kind == PS_MORPH_NONE ||
                   arguments->reading.lift == PS_LIFT_TO_HEMISPHERE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s is for points lifted to the hemisphere; add --lift hemisphere",
                         ps_option_show(arguments, PS_OPTION_MORPH).text);
}

pspec_status ps_sample_check_counts(const ps_request *arguments, ps_error *error) {
    return ps_request_check_one_count(arguments,
                                      "and an output has sets of one, for what reads it averages "
                                      "over them; use a command for each",
                                      error);
}

/* A file has one weight for each point. */
pspec_status ps_weights_check_counts(const ps_request *arguments, ps_error *error) {
    return arguments->weights.kind == PS_WEIGHTS_FILE
               ? ps_request_check_one_count(arguments, "and a file of weights is for one", error)
               : PSPEC_OK;
}

pspec_status ps_sources_check(const ps_request *arguments, const char *what, ps_error *error) {
    if (arguments->num_sources == 0 && arguments->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: name point files (- for standard input) or a --sampler", what);
    }
    return arguments->num_sources == 0 || arguments->num_files == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s does not go with %s: points come from one of them; --set NAME=FILES "
                         "names files whose points stand beside those of samplers",
                         ps_request_has_told(arguments) ? "--sampler" : "--set",
                         arguments->files[0]);
}

static bool takes_points(const ps_request *arguments, size_t source) {
    const char *const command = ps_request_program(arguments, source);
    return command != NULL && strstr(command, PS_PROGRAM_POINTS) != NULL;
}

bool ps_request_has_own_counts(const ps_request *arguments) {
    size_t i = 0;
    while (i < arguments->num_sources &&
           (arguments->sources[i].files == NULL || takes_points(arguments, i) ||
            ps_given_sets_find(&arguments->reading.given, arguments->sources[i].files) != NULL)) {
        i++;
    }
    return i < arguments->num_sources || arguments->num_sources == 0;
}

pspec_status ps_point_options_check(const ps_request *arguments, ps_error *error) {
    PS_TRY(check_other_source(arguments, error));
    if (ps_request_has_own_counts(arguments)) {
        PS_TRY(ps_request_check_one_count(arguments,
                                          ps_request_has_programs(arguments)
                                              ? "of which a program is told by " PS_PROGRAM_POINTS
                                              : "and point files have their own",
                                          error));
    }
    return check_lift(arguments, error);
}

/* A sampler that misses its number of points misses it by less than this factor. */
static ps_point_programs limit_programs(const ps_request *arguments) {
    enum { MOST_TIMES = 16 };
    ps_point_programs out = arguments->reading.programs;
    bool is_asked = arguments->is_given[PS_OPTION_POINTS];
    for (size_t i = 0; i < arguments->num_sources; i++) {
        is_asked = is_asked || takes_points(arguments, i);
    }
    out.num_sets = arguments->num_realizations;
    out.most_points = is_asked ? MOST_TIMES * arguments->counts[arguments->num_counts - 1] : 0;
    return out;
}

ps_point_options ps_point_options_make(const ps_request *arguments) {
    ps_point_options options = arguments->reading;
    options.dimension = arguments->is_given[PS_OPTION_DIMENSION] ? arguments->dimension : 0;
    options.points_per_set = arguments->is_given[PS_OPTION_POINTS] && arguments->num_counts == 1
                                 ? (size_t)arguments->counts[0]
                                 : 0;
    options.points_vary = ps_request_has_told(arguments);
    options.memory_limit = arguments->limits.constraints.memory_limit;
    options.programs = limit_programs(arguments);
    return options;
}

/* A standard error needs a limit, for a sampler may never reach it. */
uint64_t ps_num_realizations_asked(const ps_request *arguments) {
    const uint64_t most = 1000000;
    return arguments->accuracy.standard_error > 0 && !arguments->is_given[PS_OPTION_REALIZATIONS]
               ? most
               : arguments->num_realizations;
}

pspec_status ps_sampler_request_read(ps_sampler_request *out, const ps_request *arguments,
                                     size_t question, ps_error *error) {
    const bool has_points = arguments->is_given[PS_OPTION_POINTS];
    *out = (ps_sampler_request){
        .num_points = has_points ? (size_t)ps_request_points(arguments, question) : 0,
        .dimension = arguments->is_given[PS_OPTION_DIMENSION] ? arguments->dimension : 0,
        .seed = arguments->seed,
        .homogenize = arguments->homogenize};
    const char *const text = ps_request_sampler(arguments, question);
    return text != NULL ? ps_sampler_parse(out, text, error)
                        : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                  "--sampler %s is a program, which prints its points already",
                                  ps_request_name(arguments, question));
}

/* Kept sets need no device. */
static pspec_status check_device(const ps_sampler_request *request, const ps_request *arguments,
                                 ps_error *error) {
    const uint64_t num = ps_num_realizations_asked(arguments);
    const ps_sets_options sets = ps_limits_sets(&arguments->limits, arguments->accuracy.no_skip);
    return !ps_sampler_uses_device(request) || ps_sets_count_kept(request, &sets.place, num) == num
               ? PSPEC_OK
               : ps_sampler_check_device(request, arguments->limits.device, error);
}

pspec_status ps_sampler_request_resolve(ps_sampler_request *out, const ps_request *arguments,
                                        ps_error *error) {
    PS_TRY(ps_sampler_resolve(out, error));
    return check_device(out, arguments, error);
}

pspec_status ps_sampler_request_make(ps_sampler_request *out, const ps_request *arguments,
                                     size_t question, ps_error *error) {
    PS_TRY(ps_sampler_request_read(out, arguments, question, error));
    return ps_sampler_request_resolve(out, arguments, error);
}
