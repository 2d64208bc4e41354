#include "answers/variance/variance_table.h"

#include "answers/variance/parts.h"
#include "base/memory.h"
#include "request/options.h"
#include "request/point_source.h"

#include <stdlib.h>

/* Of a single set in files, unless --shifts is given. */
enum { SINGLE_SHIFTS = 100 };

static pspec_status fail_without_integrand(ps_error *error) {
    ps_text names = {0};
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        ps_text_append(&names, "%s%s", i > 0 ? ", " : "", ps_integrand_kinds[i]->name);
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--integrand NAME is needed; there are %s",
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

/* The sum is over whole frequencies: rings of a width have no part in it. */
static pspec_status check_bins(const ps_request *arguments, ps_error *error) {
    const ps_bin_rule *const bins = &arguments->frequencies.bins;
    return bins->kind == PS_BINS_ROUND || bins->kind == PS_BINS_SHELLS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s %s: variances are sums over whole frequencies, in a box (round) or "
                         "over exact shells (shells)",
                         ps_option_show(arguments, PS_OPTION_BINS).text,
                         ps_bin_rule_write(bins).text);
}

static pspec_status check_source(const ps_request *arguments, ps_error *error) {
    if (arguments->num_integrands == 0) {
        return fail_without_integrand(error);
    }
    PS_TRY(ps_sources_check(arguments, "nothing to take a variance of", error));
    PS_TRY(ps_variance_parts_check(arguments, error));
    PS_TRY(ps_point_options_check(arguments, error));
    PS_TRY(ps_option_pairs_check(arguments, PS_COMMAND_variance, error));
    return check_bins(arguments, error);
}

/* ---- files --------------------------------------------------------------------------------- */

static pspec_status check_files(const ps_file_list *files, const ps_given_sets *given,
                                ps_error *error) {
    for (size_t i = 0; i < files->num; i++) {
        if (ps_given_sets_find(given, files->paths[i]) == NULL) {
            PS_TRY(ps_saved_result_refuse(files->paths[i], error));
        }
    }
    return PSPEC_OK;
}

/* Where all of the integrands are; 0: nowhere. */
static pspec_status find_domains(unsigned *domains, const ps_request *arguments, ps_error *error) {
    *domains = ~0U;
    for (size_t i = 0; i < arguments->num_integrands; i++) {
        const ps_integrand_kind *kind = NULL;
        if (ps_given_integrands_find(&arguments->integrands_given, arguments->integrands[i]) !=
            NULL) {
            continue; /* it is anywhere */
        }
        PS_TRY(ps_integrand_find(&kind, arguments->integrands[i], error));
        *domains &= kind->domains;
    }
    return PSPEC_OK;
}

/* Points are where it is said that they are, else where the integrands are: on the torus where
 * these are everywhere. */
static pspec_status find_place(bool *on_sphere, const ps_request *arguments, ps_error *error) {
    unsigned domains = 0;
    PS_TRY(find_domains(&domains, arguments, error));
    const bool is_said = arguments->is_given[PS_OPTION_DOMAIN];
    *on_sphere = is_said ? arguments->reading.domain == PS_DOMAIN_SPHERE
                         : arguments->hemisphere || arguments->reading.lift != PS_NO_LIFT ||
                               (domains & PS_INTEGRAND_ON(PS_SAMPLES_TORUS)) == 0;
    return PSPEC_OK;
}

static pspec_status fill_files(ps_power_question *out, const ps_file_list *files,
                               const ps_request *arguments, ps_error *error) {
    bool on_sphere = false;
    PS_TRY(check_files(files, &arguments->reading.given, error));
    PS_TRY(find_place(&on_sphere, arguments, error));
    PS_TRY(ps_option_domains_check(arguments, on_sphere, error));
    out->paths = files->paths;
    out->num_paths = files->num;
    out->weights = arguments->weights;
    out->point_options = ps_point_options_make(arguments);
    out->point_options.domain = on_sphere ? PS_DOMAIN_SPHERE : PS_DOMAIN_TORUS;
    out->on_sphere = on_sphere;
    out->on_hemisphere = arguments->hemisphere || arguments->reading.lift == PS_LIFT_TO_HEMISPHERE;
    return PSPEC_OK;
}

/* ---- samplers ------------------------------------------------------------------------------ */

/* Estimates by morphed points have other weights than 1/N. */
static pspec_status check_sampler(const ps_sampler_request *request, const char *text,
                                  ps_error *error) {
    return request->morph.kind == PS_MORPH_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--sampler %s: morphed points have the density of a lobe, and these "
                         "estimates are means over uniform points",
                         text);
}

static pspec_status fill_sampler(ps_power_question *out, ps_sampler_request *request,
                                 const ps_request *arguments, size_t index, ps_error *error) {
    PS_TRY(ps_sampler_request_make(request, arguments, index, error));
    PS_TRY(check_sampler(request, ps_request_sampler(arguments, index), error));
    out->sampler = request;
    out->num_realizations = arguments->num_realizations;
    out->on_sphere = ps_sampler_is_on_sphere(request);
    out->on_hemisphere = ps_sampler_is_on_hemisphere(request);
    return ps_option_domains_check(arguments, out->on_sphere, error);
}

/* ---- questions ----------------------------------------------------------------------------- */

static ps_variance_question make_question(const ps_request *arguments) {
    const bool has_shifts = arguments->is_given[PS_OPTION_SHIFTS];
    const bool over_shells = arguments->frequencies.bins.kind == PS_BINS_SHELLS;
    ps_frequencies_spec frequencies = arguments->frequencies;
    frequencies.bins = (ps_bin_rule){.kind = PS_BINS_ROUND}; /* the largest power is of a ring */
    return (ps_variance_question){
        .spectrum = {.max_degree = (int64_t)arguments->max_degree,
                     .frequencies = frequencies,
                     /* all of the box: its energy is what the rest is told from */
                     .wants_full_array = !over_shells,
                     .bins_alone = true,
                     .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                     .accuracy = arguments->accuracy,
                     .limits = arguments->limits},
        .texts = arguments->integrands,
        .num_integrands = arguments->num_integrands,
        .given = arguments->integrands_given,
        .over_shells = over_shells,
        .wants_paper = arguments->paper_formula,
        .num_shifts = arguments->num_shifts,
        .single_shifts = has_shifts ? arguments->num_shifts : SINGLE_SHIFTS,
        .seed = arguments->seed,
        .is_moved = !arguments->in_place,
    };
}

pspec_status ps_variance_list_make(ps_variance_list *out, const ps_request *arguments,
                                   ps_error *error) {
    const size_t num = ps_request_num_questions(arguments);
    *out = (ps_variance_list){0};
    PS_TRY(check_source(arguments, error));
    PS_TRY(PS_NEW(&out->questions, num, "questions", error));
    PS_TRY(PS_NEW(&out->requests, num, "questions", error));
    out->num = num;
    PS_TRY(ps_file_lists_make(&out->files, arguments, error));
    for (size_t i = 0; i < num; i++) {
        ps_variance_question *const question = &out->questions[i];
        *question = make_question(arguments);
        question->made =
            arguments->integrands_made != NULL ? arguments->integrands_made : &out->made;
        question->bounds = ps_request_bounds(arguments, i);
        question->name = ps_request_name(arguments, i);
        question->spectrum.limits.checkpoint.part += (unsigned)i;
        question->trials_part = question->spectrum.limits.checkpoint.part + (unsigned)num;
        PS_TRY(out->files[i].num > 0
                   ? fill_files(&question->spectrum, &out->files[i], arguments, error)
                   : fill_sampler(&question->spectrum, &out->requests[i], arguments, i, error));
        PS_TRY(ps_variance_question_check(question, error));
    }
    return PSPEC_OK;
}

void ps_variance_list_free(ps_variance_list *list) {
    free(list->questions);
    free(list->requests);
    ps_file_lists_free(list->files, list->num);
    ps_made_integrands_free(&list->made);
    *list = (ps_variance_list){0};
}
