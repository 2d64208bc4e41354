/* Options that do not go together, one row a pair. Kinds of answers and commands ask the same rows,
 * whether a command line, a scene or a program filled the request. */
#include "request/option_rows.h"

#include <stdio.h>

/* What is no option, or one value of an option: the keys of scenes that ask for arrays, and what an
 * answer has several of. */
enum { ARRAYS = PS_NUM_OPTIONS, COEFFICIENTS, WEIGHTS_OF_COLUMN, OPTIMAL_WEIGHTS, SEVERAL, SPACES };

/* The first pair that was given is the one that is named, as it stands here: a, then b. */
typedef struct option_pair {
    int a, b; /* a ps_option_id, or one of those above */
    const char *why;
    ps_command_set takers; /* who refuses it; 0: all that take both options */
} option_pair;

static const option_pair pairs[] = {
    {PS_OPTION_FREQUENCIES, PS_OPTION_MAX_FREQUENCY, "the list says it all", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_BINS, "a list is not averaged", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_FULL, "a list is not an array", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_FIT, "it is of rings, and a list has none", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_PLOT, "only grids are drawn", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_PER_RING, "the list says it all", 0},
    {PS_OPTION_FREQUENCIES, PS_OPTION_STANDARD_ERROR, "it is that of rings, and a list has none",
     0},
    {PS_OPTION_PER_RING, PS_OPTION_STANDARD_ERROR,
     "more realizations do not mend the error of the choice", 0},
    {PS_OPTION_CHECKPOINT, PS_OPTION_COEFFICIENTS, "it has sums, and nothing of single sets", 0},
    {PS_OPTION_CHECKPOINT, PS_OPTION_SCATTER, "it has sums, and nothing of single sets", 0},
    {PS_OPTION_CHECKPOINT, PS_OPTION_HOMOGENEOUS, "phases are of single sets, which it has not", 0},
    {PS_OPTION_CHECKPOINT, PS_OPTION_WEIGHTS_OUT, "it has sums, and nothing of single sets", 0},
    {PS_OPTION_COEFFICIENTS, PS_OPTION_STANDARD_ERROR,
     "coefficients are of sets whose number is known before", 0},
    {PS_OPTION_COEFFICIENTS, PS_OPTION_PER_RING, "a subset does not fill an array", 0},
    {PS_OPTION_SCATTER, PS_OPTION_FREQUENCIES, "a list has no row of frequencies", 0},
    {PS_OPTION_SCATTER, PS_OPTION_STANDARD_ERROR,
     "coefficients are of sets whose number is known before", 0},
    {PS_OPTION_SCATTER, PS_OPTION_PER_RING, "a subset may not have the frequency", 0},
    {PS_OPTION_SCATTER, PS_OPTION_PLOT_LOG, "coefficients have both signs", 0},
    {PS_OPTION_SCATTER, PS_OPTION_PLOT_RANGE, "its panels have axes of their own", 0},
    {PS_OPTION_SCATTER, PS_OPTION_PLOT_POINTS, "its picture has none", 0},
    {PS_OPTION_FULL, PS_OPTION_PER_RING, "a subset does not fill an array", 0},

    {PS_OPTION_RANGE, PS_OPTION_STANDARD_ERROR,
     "which realizations there are is known when all have been looked at", 0},
    {PS_OPTION_RANGE, PS_OPTION_COEFFICIENTS, "coefficients of single sets are not merged", 0},
    {PS_OPTION_RANGE, PS_OPTION_SCATTER, "coefficients of single sets are not merged", 0},
    {PS_OPTION_RANGE, PS_OPTION_SET, "every set of files has a number of realizations of its own",
     0},
    {PS_OPTION_RANGE, PS_OPTION_WEIGHTS_OUT, "a part has rows, and nothing of single sets", 0},
    {PS_OPTION_RANGE, COEFFICIENTS, "coefficients of single sets are not merged", 0},

    {PS_OPTION_FREQUENCIES, ARRAYS, "they do not fill an array", 0},
    {PS_OPTION_PER_RING, ARRAYS, "they do not fill an array", 0},
    {PS_OPTION_PER_RING, COEFFICIENTS, "they are of whole arrays of every set", 0},
    {PS_OPTION_STANDARD_ERROR, COEFFICIENTS, "they are of whole arrays of every set", 0},
    {PS_OPTION_FULL, SEVERAL, "one array has one file", 0},
    {PS_OPTION_COEFFICIENTS, SEVERAL, "one array has one file", 0},
    {WEIGHTS_OF_COLUMN, PS_OPTION_SAMPLER, "samplers make points only", ~BIT(variance)},

    {OPTIMAL_WEIGHTS, PS_OPTION_VIEW, "they are made for a whole lobe", 0},
    {SPACES, PS_OPTION_BRDF, "an error is that of one space", 0},
    {PS_OPTION_SHIFTS, PS_OPTION_IN_PLACE, "sets are moved, or they are not", 0},
    {PS_OPTION_WEIGHTS, PS_OPTION_SAMPLER, "all of its points count the same", BIT(variance)},
    {PS_OPTION_HEMISPHERE, PS_OPTION_SAMPLER, "it says where its points are", BIT(variance)},

    {PS_OPTION_FORMAT, PS_OPTION_PREFETCH, "it writes no points", 0},
    {PS_OPTION_PLOT, PS_OPTION_PREFETCH, "it writes no points", 0},
    {PS_OPTION_OUTPUT, PS_OPTION_PREFETCH, "it writes no points", 0},

    {PS_OPTION_AGAINST, PS_OPTION_HOMOGENEOUS,
     "one is about a saved spectrum, the other about realizations alone", 0},
    /* not of the spectrum that check asks for: its request has what the saved one says */
    {PS_OPTION_DIMENSION, PS_OPTION_AGAINST, "the saved spectrum says it", BIT(check)},
    {PS_OPTION_MAX_FREQUENCY, PS_OPTION_AGAINST, "the saved spectrum says it", BIT(check)},
    {PS_OPTION_MAX_DEGREE, PS_OPTION_AGAINST, "the saved spectrum says it", BIT(check)},
    {PS_OPTION_HEMISPHERE, PS_OPTION_AGAINST, "the saved spectrum says it", BIT(check)},
    {PS_OPTION_DOMAIN, PS_OPTION_AGAINST, "the saved spectrum says it", BIT(check)},

    {PS_OPTION_ENGINE, PS_OPTION_SCENES, "scenes are timed as they are", 0},
    {PS_OPTION_PRECISION, PS_OPTION_SCENES, "scenes are timed as they are", 0},
    {PS_OPTION_PLOT, PS_OPTION_SCENES, "scenes are timed as they are", 0},
    {PS_OPTION_CALIBRATE, PS_OPTION_SCENES, "one at a time", 0},
    {PS_OPTION_CASE, PS_OPTION_SCENES, "scenes are timed as they are", 0},
    {PS_OPTION_QUICK, PS_OPTION_SCENES, "scenes are timed as they are", 0},
    {PS_OPTION_ENGINE, PS_OPTION_CALIBRATE, "all engines are measured", 0},
    {PS_OPTION_PRECISION, PS_OPTION_CALIBRATE, "all engines are measured", 0},
    {PS_OPTION_PLOT, PS_OPTION_CALIBRATE, "all engines are measured", 0},
};
enum { NUM_PAIRS = sizeof pairs / sizeof pairs[0] };

/* Scenes name sets of files by the key of samplers. */
static bool is_there(const ps_request *request, int id) {
    switch (id) {
    case ARRAYS:
        return request->wants_array;
    case COEFFICIENTS:
        return request->wants_coefficients;
    case WEIGHTS_OF_COLUMN:
        return request->weights.kind == PS_WEIGHTS_COLUMN;
    case OPTIMAL_WEIGHTS:
        return request->weights.kind == PS_WEIGHTS_OPTIMAL;
    case SEVERAL:
        return ps_request_num_questions(request) > 1;
    case SPACES:
        return request->num_smoothness > 1;
    default:
        return request->is_given[id] &&
               (id != PS_OPTION_SAMPLER || ps_request_has_samplers(request));
    }
}

static ps_shown_option show(const ps_request *request, int id) {
    ps_shown_option out;
    switch (id) {
    case ARRAYS:
        return (ps_shown_option){"arrays"};
    case COEFFICIENTS:
        return (ps_shown_option){"arrays: coefficients"};
    case WEIGHTS_OF_COLUMN:
    case OPTIMAL_WEIGHTS:
        snprintf(out.text, sizeof out.text, "%.20s %s",
                 ps_option_show(request, PS_OPTION_WEIGHTS).text,
                 id == OPTIMAL_WEIGHTS ? "optimal" : "column");
        return out;
    case SPACES:
        return (ps_shown_option){"several numbers of smoothness"};
    case SEVERAL:
        return request->num_sources > 1 ? (ps_shown_option){"several samplers or sets"}
                                        : (ps_shown_option){"several numbers of points"};
    default:
        return ps_option_show(request, (ps_option_id)id);
    }
}

pspec_status ps_option_pairs_check(const ps_request *request, ps_command_id taker,
                                   ps_error *error) {
    for (size_t i = 0; i < NUM_PAIRS; i++) {
        const option_pair *const pair = &pairs[i];
        const bool is_refused = pair->takers == 0 || (pair->takers >> taker & 1) != 0;
        if (is_refused && is_there(request, pair->a) && is_there(request, pair->b)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s does not go with %s: %s",
                           show(request, pair->a).text, show(request, pair->b).text, pair->why);
        }
    }
    return PSPEC_OK;
}

bool ps_option_is_refused(ps_option_id a, ps_option_id b) {
    size_t i = 0;
    while (i < NUM_PAIRS && (pairs[i].a != (int)a || pairs[i].b != (int)b)) {
        i++;
    }
    return i < NUM_PAIRS;
}

pspec_status ps_option_domains_check(const ps_request *request, bool on_sphere, ps_error *error) {
    static const ps_option_id torus[] = {PS_OPTION_DIMENSION, PS_OPTION_MAX_FREQUENCY,
                                         PS_OPTION_WRAP, PS_NUM_OPTIONS};
    static const ps_option_id sphere[] = {PS_OPTION_MAX_DEGREE, PS_OPTION_HEMISPHERE,
                                          PS_OPTION_NORMALIZE_VECTORS, PS_OPTION_LIFT,
                                          PS_NUM_OPTIONS};
    for (const ps_option_id *id = on_sphere ? torus : sphere; *id != PS_NUM_OPTIONS; id++) {
        if (request->is_given[*id]) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "%s is for points of the %s, and these are of the %s",
                           ps_option_show(request, *id).text, on_sphere ? "torus" : "sphere",
                           on_sphere ? "sphere" : "torus");
        }
    }
    return PSPEC_OK;
}
