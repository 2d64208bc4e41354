#include "answers/spectra/question.h"

#include "base/memory.h"
#include "request/options.h"
#include "request/point_source.h"
#include "spectra/shape/low_end.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pspec_status check_source(const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_sources_check(arguments, "nothing to take a spectrum of", error));
    return ps_point_options_check(arguments, error);
}

/* What there is one of. */
static pspec_status check_several(const ps_request *arguments, ps_error *error) {
    const size_t num = ps_request_num_questions(arguments);
    if (num > 1 && arguments->plot != NULL && arguments->frequencies.num_shown > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--scatter does not go with several %s: a picture shows the sets of one",
                       arguments->num_sources > 1 ? "samplers or sets" : "numbers of points");
    }
    PS_TRY(ps_weights_check_counts(arguments, error));
    return arguments->plot == NULL || num <= PS_MAX_CURVES
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--plot: %zu samplers and sets with %zu numbers of points are %zu curves, "
                         "and a "
                         "picture has %d at most; pointspec run deals them out to panels",
                         arguments->num_sources, arguments->num_counts, num, PS_MAX_CURVES);
}

/* Of files nobody knows how many sets they have; then the header says it. */
static pspec_status check_fit(const ps_request *arguments, ps_error *error) {
    const uint64_t num = ps_num_realizations_asked(arguments);
    return !arguments->wants_fit || !ps_request_has_samplers(arguments) ||
                   num >= PS_FEWEST_FITTED_REALIZATIONS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s weighs powers by their standard errors, which need %d realizations "
                         "or more (--realizations), not %llu",
                         ps_option_show(arguments, PS_OPTION_FIT).text,
                         PS_FEWEST_FITTED_REALIZATIONS, (unsigned long long)num);
}

/* The powers of a picture, those of an array and coefficients are different ones, as are the
 * coefficients of a row. */
static int count_arrays(const ps_request *arguments) {
    return (arguments->wants_array || arguments->wants_picture) + arguments->wants_coefficients +
           (arguments->frequencies.num_shown > 0);
}

_Static_assert(PS_SUM_BLOCK == 128, "the sentence says so");
#define WHOLE_BLOCKS "must begin with a multiple of 128: sums are added in such blocks"

/* Whether the end may be no multiple depends on how many there are. */
static pspec_status check_range(const ps_request *arguments, ps_error *error) {
    return arguments->range.first % PS_SUM_BLOCK == 0
               ? PSPEC_OK
               : ps_range_refuse(&arguments->range, WHOLE_BLOCKS, error);
}

static pspec_status check_results(const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_option_pairs_check(arguments, PS_COMMAND_power, error));
    PS_TRY(check_range(arguments, error));
    PS_TRY(check_fit(arguments, error));
    if (count_arrays(arguments) > 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "an answer has one array: that of arrays, of pictures or of scatter");
    }
    return check_several(arguments, error);
}

static void fill_points(ps_power_question *question, const ps_request *arguments,
                        ps_domain domain) {
    question->weights = arguments->weights;
    question->point_options = ps_point_options_make(arguments);
    question->point_options.domain = domain;
}

static bool wants_coefficients(const ps_request *arguments) {
    return arguments->coefficients != NULL || arguments->wants_coefficients ||
           arguments->frequencies.num_shown > 0;
}

static ps_harmonics find_harmonics(const ps_request *arguments, ps_question_kind kind) {
    if (!wants_coefficients(arguments)) {
        return PS_NO_HARMONICS;
    }
    if (kind == PS_QUESTION_POWER) {
        return PS_EXPONENTIALS;
    }
    return arguments->harmonics != NULL && strcmp(arguments->harmonics, "hemispherical") == 0
               ? PS_HEMISPHERICAL_HARMONICS
               : PS_SPHERICAL_HARMONICS;
}

static pspec_normalization choose_normalization(const ps_request *arguments,
                                                ps_question_kind kind) {
    return kind == PS_QUESTION_PAIRS ? PSPEC_NORMALIZATION_PAIRS : arguments->normalization;
}

static ps_domain domain_of(ps_question_kind kind) {
    return kind == PS_QUESTION_POWER ? PS_DOMAIN_TORUS : PS_DOMAIN_SPHERE;
}

/* What else this may be asked of, as check_results has it. */
static unsigned find_offers(const ps_request *arguments, ps_question_kind kind) {
    const bool is_whole = arguments->full != NULL || arguments->accuracy.standard_error > 0;
    if (kind != PS_QUESTION_POWER || is_whole || arguments->frequencies.path != NULL ||
        arguments->frequencies.per_ring > 0) {
        return 0;
    }
    return PS_OFFER_RINGS | (arguments->plot == NULL && arguments->frequencies.num_shown == 0 &&
                                     arguments->frequencies.bins.kind != PS_BINS_SHELLS
                                 ? (unsigned)PS_OFFER_LISTS
                                 : 0);
}

/* Of one question alone: points of one sampler beside the curves of many would be taken for those
 * of all. Callers of the library who ask for the array draw it by themselves. */
static bool shows_points(const ps_request *arguments, ps_question_kind kind) {
    const char *const word = arguments->plot_points;
    const bool is_drawn_elsewhere = arguments->wants_array && arguments->wants_errors;
    const bool is_of_scene = arguments->wants_picture &&
                             ps_request_sampler(arguments, 0) == NULL; /* others `sample` has */
    return (arguments->plot != NULL || is_drawn_elsewhere || is_of_scene) &&
           ps_request_num_questions(arguments) == 1 && kind != PS_QUESTION_PAIRS &&
           (word == NULL || strcmp(word, "no") != 0);
}

static ps_power_question make_question(const ps_request *arguments, ps_question_kind kind) {
    ps_power_question question = {
        .on_sphere = domain_of(kind) == PS_DOMAIN_SPHERE,
        .wants_pair_sums = kind == PS_QUESTION_PAIRS,
        .on_hemisphere = arguments->hemisphere,
        .harmonics = find_harmonics(arguments, kind),
        .max_degree = (int64_t)arguments->max_degree,
        .num_realizations = ps_num_realizations_asked(arguments),
        .range = arguments->range,
        .frequencies = arguments->frequencies,
        .has_rings_of_box = kind == PS_QUESTION_POWER,
        .per_ring_seed = arguments->seed,
        /* the picture of one spectrum shows the corners; several, and subsets, are curves only */
        .wants_full_array = arguments->full != NULL || wants_coefficients(arguments) ||
                            (arguments->wants_picture && domain_of(kind) == PS_DOMAIN_TORUS) ||
                            arguments->wants_array ||
                            (arguments->plot != NULL && ps_request_num_questions(arguments) == 1 &&
                             arguments->frequencies.per_ring == 0),
        .keeps_sums = arguments->wants_state,
        .fills_boxes = kind == PS_QUESTION_POWER &&
                       (arguments->coefficients != NULL || arguments->wants_coefficients),
        .keeps_first = shows_points(arguments, kind),
        .normalization = choose_normalization(arguments, kind),
        .accuracy = arguments->accuracy,
        .may_loosen = arguments->accuracy.standard_error > 0 && arguments->accuracy.floor > 0 &&
                      !arguments->is_given[PS_OPTION_TOLERANCE],
        .limits = arguments->limits,
    };
    question.limits.constraints.offers = find_offers(arguments, kind);
    fill_points(&question, arguments, domain_of(kind));
    return question;
}

/* The wrong domain is named before anything else that may be wrong with a sampler. */
static pspec_status make_request_of_domain(ps_sampler_request *out, const ps_request *arguments,
                                           size_t question, ps_domain domain, ps_error *error) {
    const char *const text = ps_request_sampler(arguments, question);
    PS_TRY(ps_sampler_request_read(out, arguments, question, error));
    if (domain == PS_DOMAIN_TORUS && ps_sampler_is_on_sphere(out)) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "--sampler %s makes points of the sphere, and this spectrum is of the torus; "
            "pointspec angular is for the sphere",
            text);
    }
    if (domain == PS_DOMAIN_SPHERE && !ps_sampler_is_on_sphere(out)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--sampler %s makes points of the torus, and this spectrum is of the "
                       "sphere; " PS_LIFT_KEY "=sphere or " PS_LIFT_KEY
                       "=hemisphere takes them there",
                       text);
    }
    return ps_sampler_request_resolve(out, arguments, error);
}

pspec_status ps_questions_find_domain(bool *on_sphere, const ps_request *arguments,
                                      ps_error *error) {
    ps_sampler_request sampler = {0};
    const bool is_said =
        arguments->reading.domain == PS_DOMAIN_SPHERE || arguments->reading.lift != PS_NO_LIFT ||
        arguments->is_given[PS_OPTION_HEMISPHERE] || arguments->is_given[PS_OPTION_MAX_DEGREE];
    *on_sphere = is_said && arguments->reading.domain != PS_DOMAIN_TORUS;
    for (size_t i = 0; i < arguments->num_sources; i++) {
        if (arguments->sources[i].sampler != NULL) { /* the first; others are compared with it */
            PS_TRY(ps_sampler_parse(&sampler, arguments->sources[i].sampler, error));
            *on_sphere = ps_sampler_is_on_sphere(&sampler);
            return PSPEC_OK;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_questions_make(ps_question_list *out, const ps_request *arguments,
                               ps_question_kind kind, ps_error *error) {
    *out = (ps_question_list){0};
    PS_TRY(check_source(arguments, error));
    PS_TRY(check_results(arguments, error));
    const size_t num = ps_request_num_questions(arguments);
    PS_TRY(PS_NEW(&out->questions, num, "questions", error));
    PS_TRY(PS_NEW(&out->requests, num, "questions", error));
    out->num = num;
    PS_TRY(ps_file_lists_make(&out->files, arguments, error));
    for (size_t i = 0; i < out->num; i++) {
        out->questions[i] = make_question(arguments, kind);
        out->questions[i].limits.checkpoint.part += (unsigned)i;
        if (arguments->replans != NULL) {
            out->questions[i].replan = arguments->replans[i];
        }
        if (out->files[i].num > 0) {
            out->questions[i].paths = out->files[i].paths;
            out->questions[i].num_paths = out->files[i].num;
            continue;
        }
        ps_sampler_request *request = &out->requests[i];
        PS_TRY(make_request_of_domain(request, arguments, i, domain_of(kind), error));
        out->questions[i].sampler = request;
    }
    return PSPEC_OK;
}

void ps_questions_free(ps_question_list *list) {
    free(list->questions);
    free(list->requests);
    ps_file_lists_free(list->files, list->num);
    *list = (ps_question_list){0};
}
