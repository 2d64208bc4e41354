#include "answers/check/check_question.h"

#include "request/options.h"

#include <math.h>

ps_request ps_check_request(const ps_request *arguments, const ps_saved_spectrum *saved) {
    ps_request own = *arguments;
    own.is_given[PS_OPTION_DIMENSION] = !saved->on_sphere;
    own.dimension = saved->dimension;
    own.frequencies.max_frequency = saved->on_sphere ? 0 : saved->max_frequency;
    own.max_degree = saved->on_sphere ? (uint64_t)saved->max_frequency : 0;
    own.hemisphere = saved->on_hemisphere;
    own.frequencies.bins = saved->bin_rule;
    own.frequencies.per_ring = saved->per_ring;
    own.normalization = saved->normalization;
    if (arguments->num_sources == 0) {
        return own;
    }
    if (!arguments->is_given[PS_OPTION_POINTS]) {
        own.is_given[PS_OPTION_POINTS] = true;
        own.counts[0] = (uint64_t)llround(saved->mean_points);
    }
    if (!arguments->is_given[PS_OPTION_REALIZATIONS]) {
        own.num_realizations = saved->num_realizations;
    }
    if (!arguments->is_given[PS_OPTION_SEED] && saved->has_seed) {
        own.seed = saved->seed + 1;
    }
    return own;
}

bool ps_check_is_of_spectrum(ps_option_id id) {
    return ps_option_is_refused(id, PS_OPTION_AGAINST);
}

pspec_status ps_check_question_make(ps_question_list *out, const ps_request *own,
                                    const ps_saved_spectrum *saved, ps_error *error) {
    PS_TRY(ps_questions_make(out, own, saved->on_sphere ? PS_QUESTION_ANGULAR : PS_QUESTION_POWER,
                             error));
    out->questions[0].per_ring_seed = saved->seed;
    out->questions[0].limits.constraints.offers = 0; /* the saved spectrum says which frequencies */
    return PSPEC_OK;
}
