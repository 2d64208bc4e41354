#include "answers/homogeneity/homogeneity_question.h"

#include "request/options.h"

/* Unless -m is given: enough to find what jitter of 256 points does to the products. */
enum { DEFAULT_REALIZATIONS = 128 };

/* Frequencies up to 2 N^(1/d): see spectra/phases/shift_products.h. */
static const double reach = 2;

ps_request ps_homogeneity_request(const ps_request *arguments) {
    ps_request own = *arguments;
    if (!own.is_given[PS_OPTION_REALIZATIONS]) {
        own.num_realizations = DEFAULT_REALIZATIONS;
    }
    return own;
}

/* Samplers say where their points lie; files are of the sphere when one of --domain sphere, --lift,
 * --hemisphere and --max-degree says so. */
static pspec_status find_domain(bool *on_sphere, const ps_request *arguments, ps_error *error) {
    ps_sampler_request sampler = {0};
    const bool is_said =
        arguments->reading.domain == PS_DOMAIN_SPHERE || arguments->reading.lift != PS_NO_LIFT ||
        arguments->is_given[PS_OPTION_HEMISPHERE] || arguments->is_given[PS_OPTION_MAX_DEGREE];
    *on_sphere = is_said && arguments->reading.domain != PS_DOMAIN_TORUS;
    if (arguments->num_sources > 0) {
        PS_TRY(ps_sampler_parse(&sampler, ps_request_source_name(arguments, 0), error));
        *on_sphere = ps_sampler_is_on_sphere(&sampler);
    }
    return PSPEC_OK;
}

static pspec_status check_request(const ps_request *own, ps_error *error) {
    PS_TRY(ps_option_pairs_check(own, PS_COMMAND_check, error));
    PS_TRY(ps_request_check_one_count(own, "and sets of one are checked at a time", error));
    return own->num_sources <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one sampler is checked at a time, but %zu were given", own->num_sources);
}

pspec_status ps_homogeneity_question_make(ps_question_list *out, const ps_request *own,
                                          ps_error *error) {
    bool on_sphere = false;
    PS_TRY(check_request(own, error));
    PS_TRY(find_domain(&on_sphere, own, error));
    PS_TRY(ps_option_domains_check(own, on_sphere, error));
    PS_TRY(ps_questions_make(out, own, on_sphere ? PS_QUESTION_ANGULAR : PS_QUESTION_POWER, error));
    ps_power_question *const question = &out->questions[0];
    question->harmonics = on_sphere ? PS_SPHERICAL_HARMONICS : PS_EXPONENTIALS;
    question->keeps_sets = true;
    question->wants_full_array = true;
    question->has_rings_of_box = false; /* phases are of the torus */
    question->reach = reach;
    question->limits.constraints.offers = 0;
    return PSPEC_OK;
}
