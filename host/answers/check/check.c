/* Is the spectrum of a sampler, or of files, the saved one? Or are realizations homogeneous? */
#include "answers/check/check_table.h"
#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "request/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The question is that of the saved spectrum, but for the seed: realizations must be independent of
 * those that were saved. */
static ps_request request_of(const ps_request *arguments, const ps_saved_spectrum *saved) {
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

/* Does the option say what the saved spectrum says itself? Then it does not go with one. */
static bool is_of_spectrum(ps_option_id id) {
    return ps_option_is_refused(id, PS_OPTION_AGAINST);
}

/* One question, of what request_of gave; it borrows from `own`. */
static pspec_status make_question(ps_question_list *out, const ps_request *own,
                                  const ps_saved_spectrum *saved, ps_error *error) {
    PS_TRY(ps_questions_make(out, own, saved->on_sphere ? PS_QUESTION_ANGULAR : PS_QUESTION_POWER,
                             error));
    out->questions[0].per_ring_seed = saved->seed;
    out->questions[0].bins_alone = true;
    out->questions[0].limits.constraints.offers = 0; /* the saved spectrum says which frequencies */
    return PSPEC_OK;
}

static pspec_status find_both_saved(bool *are_both, const ps_request *request, ps_error *error) {
    *are_both = false;
    return request->against != NULL && request->num_sources == 0 && request->num_files == 1 &&
                   ps_given_sets_find(&request->reading.given, request->files[0]) == NULL
               ? ps_saved_spectrum_find(are_both, request->files[0], error)
               : PSPEC_OK;
}

/* Options about points, and about how they are computed with, have no place here. */
static pspec_status check_both(const ps_request *request, ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const bool is_of_points = ps_options[id].source != PS_OF_BOTH || id == PS_OPTION_POINTS ||
                                  id == PS_OPTION_WEIGHTS || id == PS_OPTION_ENGINE ||
                                  id == PS_OPTION_TOLERANCE || id == PS_OPTION_PRECISION ||
                                  id == PS_OPTION_PROFILE || id == PS_OPTION_CHECKPOINT;
        if (request->is_given[id] && is_of_points) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "%s does not go with two saved spectra, \"%s\" and \"%s\": nothing is "
                           "computed",
                           ps_option_show(request, (ps_option_id)id).text, request->files[0],
                           request->against);
        }
    }
    return PSPEC_OK;
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    bool are_both_saved = false;
    if (request->homogeneous) {
        return ps_homogeneity_check(request, error);
    }
    if (request->against == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--against FILE, the saved spectrum, or --homogeneous is needed");
    }
    PS_TRY(ps_option_pairs_check(request, PS_COMMAND_check, error));
    PS_TRY(find_both_saved(&are_both_saved, request, error));
    if (are_both_saved) {
        return check_both(request, error);
    }
    PS_TRY(ps_request_check_one_count(request, "and a saved spectrum is of one", error));
    return request->num_sources <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one sampler is compared with one saved spectrum, but %zu were given",
                         request->num_sources);
}

static void discard(void *computed) {
    ps_check *const check = computed;
    if (check == NULL) {
        return;
    }
    ps_homogeneity_discard(check->homogeneity);
    ps_power_job_destroy(check->job);
    ps_questions_free(&check->list);
    ps_saved_spectrum_free(&check->saved);
    ps_saved_spectrum_free(&check->measured);
    free(check->rows);
    free(check);
}

static pspec_status read_other(ps_check *check, const ps_request *request, ps_error *error) {
    const ps_check_side saved = {&check->saved, request->against};
    const ps_check_side other = {&check->measured, request->files[0]};
    check->own = *request;
    PS_TRY(ps_saved_spectrum_read(&check->measured, other.path, error));
    return ps_check_same_kind(&saved, &other, error);
}

/* Reads the saved spectrum and finds out what it asks of the measured side. *out is for discard,
 * also after an error. */
static pspec_status ask(ps_check **out, const ps_request *request, ps_error *error) {
    bool are_both_saved = false;
    PS_TRY(check_question(request, error));
    PS_TRY(PS_NEW(out, 1, "a check", error));
    ps_check *const check = *out;
    PS_TRY(ps_saved_spectrum_read(&check->saved, request->against, error));
    PS_TRY(find_both_saved(&are_both_saved, request, error));
    if (are_both_saved) {
        return read_other(check, request, error);
    }
    check->own = request_of(request, &check->saved);
    return make_question(&check->list, &check->own, &check->saved, error);
}

static pspec_status plan_nothing(ps_planner *planner, ps_error *error) {
    const ps_phases phases = ps_plan_table_begin_phases(planner);
    return ps_plan_table_add_host(planner, &phases, 0, "both spectra were saved", error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_check *check = NULL;
    if (request->homogeneous) {
        return ps_homogeneity_plan(planner, request, error);
    }
    pspec_status status = ask(&check, request, error);
    if (status == PSPEC_OK) {
        status = check->list.num == 0
                     ? plan_nothing(planner, error)
                     : ps_spectra_plan_list(planner, &check->own, &check->list, error);
    }
    discard(check);
    return status;
}

/* ---- the answer -------------------------------------------------------------------------- */

/* The bins that differ most. */
static void append_worst(ps_text *text, const ps_check *check) {
    enum { MOST_NAMED = 3 };
    const ps_saved_spectrum *const measured = &check->measured;
    size_t named[MOST_NAMED];
    size_t num = 0;
    while (num < MOST_NAMED && num < check->num_different) {
        size_t worst = SIZE_MAX;
        for (size_t b = 0; b < measured->num_bins; b++) {
            bool is_new = check->rows[b].differs;
            for (size_t i = 0; i < num; i++) {
                is_new = is_new && named[i] != b;
            }
            if (is_new && (worst == SIZE_MAX ||
                           fabs(check->rows[b].score) > fabs(check->rows[worst].score))) {
                worst = b;
            }
        }
        ps_text_append(text, "%s %s %lld (power %.4g, saved %.4g, z = %.3g)", num > 0 ? "," : "",
                       ps_check_bin_name(&check->saved), (long long)measured->bins[worst].key,
                       measured->bins[worst].power, check->saved.bins[worst].power,
                       check->rows[worst].score);
        named[num++] = worst;
    }
    ps_text_append(text, "%s", num < check->num_different ? ", ..." : "");
}

static pspec_status judge(const ps_check *check, ps_error *error) {
    ps_text worst = {0};
    if (check->num_different == 0) {
        return PSPEC_OK;
    }
    append_worst(&worst, check);
    pspec_status status = ps_text_check(&worst, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "not the spectrum of \"%s\": %zu of %zu %ss differ at a false alarm rate "
                         "of %g:%s",
                         check->own.against, check->num_different, check->saved.num_bins,
                         ps_check_bin_name(&check->saved), check->own.false_alarm_rate,
                         ps_text_string(&worst));
    }
    ps_text_free(&worst);
    return status;
}

/* ---- the kind of answer ---------------------------------------------------------------------- */

/* As many as were saved where nobody says how many. */
static pspec_status look_at_shares(uint64_t *num, ps_error *why, const ps_request *request,
                                   ps_error *error) {
    bool are_both_saved = false;
    ps_request own = *request;
    if (!request->is_given[PS_OPTION_REALIZATIONS]) {
        own.num_realizations = UINT64_MAX;
    }
    PS_TRY(ps_answer_look_at_rows(num, why, &own, error));
    PS_TRY(find_both_saved(&are_both_saved, request, error));
    if (request->homogeneous || are_both_saved) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s",
                request->homogeneous ? "phases of every set are kept" : "nothing is computed");
    }
    return PSPEC_OK;
}

static pspec_status compute_homogeneity(void **out, const ps_request *request,
                                        const ps_answer_hooks *hooks, ps_error *error) {
    ps_check *check = NULL;
    PS_TRY(PS_NEW(&check, 1, "a check", error));
    *out = check;
    return ps_homogeneity_compute(&check->homogeneity, request, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    ps_check *check = NULL;
    if (request->homogeneous) {
        return compute_homogeneity(out, request, hooks, error);
    }
    const pspec_status asked = ask(&check, request, error);
    *out = check;
    PS_TRY(asked);
    const bool is_measured = check->list.num > 0;
    const ps_check_side saved = {&check->saved, request->against};
    const ps_check_side other = {&check->measured, is_measured ? NULL : request->files[0]};
    if (is_measured) {
        PS_TRY(ps_spectra_run_one(&check->job, &check->list.questions[0], hooks, error));
        PS_TRY(ps_check_measured(&check->measured, check->job, error));
    } else {
        ps_answer_begin_next(hooks);
    }
    PS_TRY(PS_NEW(&check->rows, check->saved.num_bins, "compared bins", error));
    PS_TRY(ps_check_compare(check->rows, &saved, &other, request->false_alarm_rate, error));
    for (size_t b = 0; b < check->saved.num_bins; b++) {
        check->num_different += check->rows[b].differs;
    }
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_check *const check = computed;
    (void)request;
    if (check->homogeneity != NULL) {
        return ps_homogeneity_tabulate(out, check->homogeneity, error);
    }
    PS_TRY(ps_check_table(&out->table, check, error));
    return ps_verdict_take(out, judge(check, error), error);
}

static const char *const summary[] = {
    "points",    "points_smallest",  "points_largest", "realizations",
    "different", "adjusted_p_value", "verdict",        NULL};
/* A table of rings has bins, one of degrees has degrees. */
static const ps_picture_kind pictures[] = {{.suffix = "-scores",
                                            .what = "difference",
                                            .make = ps_lines_figure,
                                            .by = PS_BY_SCENE,
                                            .x = "bin",
                                            .lines = {{.y = "z_score"}},
                                            .x_label = "ring",
                                            .y_label = "in standard errors"},
                                           {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"against", "", PS_ENTRY, 0, "--against", "the saved spectrum"},
    {"measured", "", PS_ENTRY, 0, "--against with a second one", "the other saved spectrum"},
    {"saved_realizations", "", PS_ENTRY, 0, "--against",
     "how many the saved spectrum is the mean of"},
    {"invariance", "", PS_ENTRY, 0, "--homogeneous", "what was tested, translations or rotations"},
    {"different", "", PS_ENTRY, 0, "", "how many rings, degrees or phases differ, of how many"},
    {"adjusted_p_value", "", PS_ENTRY, 0, "", "the smallest of that column"},
    {"verdict", "", PS_ENTRY, 0, "", "same or different, of all rows together"},
    {"bin", "", PS_COLUMN, 0, "on the torus", "number b of the ring; |k|^2 of shells"},
    {"frequency", "cycles per cell", PS_COLUMN, 0, "--against, on the torus",
     "mean |k| of the ring"},
    {"degree", "", PS_COLUMN, 0, "on the sphere", "l"},
    {"saved", "", PS_COLUMN, 0, "--against", "power of the saved spectrum"},
    {"saved_error", "", PS_COLUMN, 0, "--against", "its standard error"},
    {"measured", "", PS_COLUMN, 0, "--against", "power of the points"},
    {"measured_error", "", PS_COLUMN, 0, "--against", "its standard error"},
    {"phases", "", PS_COLUMN, 0, "--homogeneous",
     "how many quantities there are, amplitudes and sums of products"},
    {"resultant", "", PS_COLUMN, 0, "--homogeneous",
     "length of the mean of exp(i phase) over the realizations, of the one with the smallest "
     "probability"},
    {"z_score", "", PS_COLUMN, 0, "",
     "normal score of the ratio, positive where more was measured; with --homogeneous of p_value"},
    {"p_value", "", PS_COLUMN, 0, "",
     "probability of a score as far from 0, of this row alone; with --homogeneous of its phases "
     "together"},
    {"adjusted_p_value", "", PS_COLUMN, 0, "", "the same for all rows together"},
    {"detectable_change", "", PS_COLUMN, 0, "--against",
     "relative change of power that would be found with probability 0.9"},
    {"worst", "", PS_COLUMN, 0, "--homogeneous", "which quantity has the smallest probability"},
    {"verdict", "", PS_COLUMN, 0, "", "same or different"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked, ps_fields_points, own_fields,
                                             ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"verdict", NULL, true, NULL}, {.value = NULL}};

const ps_kind ps_kind_check = {
    .name = "check",
    .purpose = "is this the spectrum that was saved, statistically?",
    .usage = "check --against FILE|--homogeneous [options] FILE... | check --against "
             "FILE|--homogeneous --sampler NAME",
    .description =
        "Measures the spectrum that the saved one is of (domain, dimension, K or L, rings or "
        "shells, "
        "normalization and number of points are taken from it) and compares the powers of all "
        "rings "
        "or degrees, with the standard errors of both sides. Exit status 0: nothing differs; 3: "
        "some do, the table and the message say which. For samplers that have not changed that "
        "happens with the probability of --false-alarm-rate at most, for all rings together. The "
        "saved spectrum is a table of power or angular as NPZ. "
        "Another one in the place of the point files is compared with it, nothing being computed. "
        "A sampler gets as many points and realizations as were saved and the seed after the saved "
        "one, unless others are given. With --homogeneous the question is whether realizations "
        "have the law of their own translates (on the sphere: rotations), as prediction of "
        "variance from spectra wants it: the phases of S(k), or of c_lm, and of sums of their "
        "products must then be uniform.",
    .examples = {"pointspec power --sampler jittered -n 256 -m 64 -o saved.npz && pointspec check "
                 "--against saved.npz --sampler jittered -m 16",
                 "pointspec check --homogeneous --sampler jittered -n 256 --homogenize"},
    .takes = PS_COMMAND_BIT(check),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .has_words = true,
    .leaves_default = is_of_spectrum,
    .check_arguments = check_question,
    .check_question = check_question,
    .plan = plan,
    .look_at_shares = look_at_shares,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .compared = compared,
};
