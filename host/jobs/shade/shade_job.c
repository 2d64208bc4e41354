#include "jobs/shade/shade_job.h"

#include "base/memory.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "math/random/rotation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { USUAL_ORIENTATIONS = 1000 };
/* Values of one call: half a second of a processor, after which somebody may stop the work. */
enum { CALL_VALUES = 1 << 24 };

/* ---- one rule ------------------------------------------------------------------------------ */

static void begin(void *payload) {
    ps_shade_job *const job = payload;
    job->measured = job->predicted = job->beyond = job->orientations = (ps_sums){0};
    job->num_rules = 0;
}

/* Trials for sets of so many points, which files may have more of than was known. */
static pspec_status make_room(ps_shade_job *job, size_t num_points, ps_error *error) {
    ps_device *const device = job->rules->setup.device;
    const bool has_doubles = device == NULL || ps_device_get_limits(device)->has_fp64;
    if (job->trials != NULL && num_points <= job->most_points) {
        return PSPEC_OK;
    }
    const uint64_t fit = CALL_VALUES / num_points + 1;
    const uint64_t num = job->result.num_orientations;
    ps_trials_destroy(job->trials);
    free(job->moves);
    job->trials = NULL;
    job->moves = NULL;
    job->most_points = num_points;
    job->trials_of_call = (size_t)(num < fit ? num : fit);
    PS_TRY(PS_NEW(&job->moves, job->trials_of_call * (PS_ROTATION_NUMBERS + 1), "orientations",
                  error));
    job->estimates = job->moves + job->trials_of_call * PS_ROTATION_NUMBERS;
    const ps_trials_options options = {has_doubles ? PS_DOUBLE : PS_SINGLE, 1, num_points,
                                       job->trials_of_call};
    return ps_trials_create(&job->trials, job->question->light->integrand, &options, device, error);
}

/* Squares of the errors of some orientations; those behind the last are there, and not counted. */
static pspec_status measure_some(ps_shade_job *job, const pspec_pattern *pattern, double weight_sum,
                                 ps_random *random, size_t num, ps_sums *squares, ps_error *error) {
    for (size_t i = 0; i < job->trials_of_call; i++) {
        const ps_rotation rotation = ps_rotation_random(random);
        memcpy(job->moves + i * PS_ROTATION_NUMBERS, rotation.matrix, sizeof rotation.matrix);
    }
    PS_TRY(ps_trials_run(job->trials, pattern, 1, job->moves, job->estimates, error));
    for (size_t i = 0; i < num; i++) {
        const double *const move = job->moves + i * PS_ROTATION_NUMBERS;
        const double normal[3] = {move[2], move[5], move[8]}; /* R z */
        const double estimate = job->estimates[i] * weight_sum / PS_FOUR_PI;
        const double off = estimate - ps_light_shading(job->question->light, normal);
        ps_sums_add(squares, off * off);
    }
    return PSPEC_OK;
}

static pspec_status measure(ps_shade_job *job, uint64_t rule, const pspec_pattern *pattern,
                            double weight_sum, ps_error *error) {
    const uint64_t num = job->result.num_orientations;
    ps_random random = ps_random_init(job->seed, PS_STREAM_TRIALS, rule);
    ps_sums squares = {0};
    ps_mean mean;
    PS_TRY(make_room(job, pattern->num_points, error));
    for (uint64_t done = 0; done < num; done += job->trials_of_call) {
        const uint64_t left = num - done;
        PS_TRY(ps_watch_tell(&job->question->rules.watch, "orientations", done, num, NULL, error));
        PS_TRY(measure_some(job, pattern, weight_sum, &random,
                            left < job->trials_of_call ? (size_t)left : job->trials_of_call,
                            &squares, error));
    }
    ps_sums_finish(&squares, num, &mean.mean, &mean.standard_error);
    job->orientations = squares;
    ps_sums_add(&job->measured, mean.mean);
    return PSPEC_OK;
}

/* (Q5) up to the degrees that both have; beyond, V/(4 pi) of the energy. */
static void predict(ps_shade_job *job, const ps_degree_error *degrees, size_t max_degree,
                    double weight_square) {
    const ps_light *const light = job->question->light;
    const size_t last = max_degree < light->max_degree ? max_degree : light->max_degree;
    double sum = 0;
    for (size_t l = 0; l <= last; l++) {
        sum += light->powers[l] * (degrees[l].d2 + degrees[l].c2);
    }
    const double beyond = weight_square / PS_FOUR_PI * ps_light_beyond(light, last);
    ps_sums_add(&job->predicted, sum + beyond);
    ps_sums_add(&job->beyond, beyond);
}

static pspec_status hear(void *payload, uint64_t rule, const pspec_pattern *pattern,
                         const ps_degree_error *degrees, size_t max_degree, ps_error *error) {
    ps_shade_job *const job = payload;
    const ps_rule view = {pattern->num_points, pattern->points, pattern->weights};
    const ps_weight_sums weights = ps_rule_weight_sums(&view);
    predict(job, degrees, max_degree, weights.square);
    job->num_rules++;
    return job->result.num_orientations > 0 ? measure(job, rule, pattern, weights.sum, error)
                                            : PSPEC_OK;
}

/* ---- all of them --------------------------------------------------------------------------- */

/* Samplers and numbers of points have orientations of their own. */
static pspec_status choose_seed(ps_shade_job *job, ps_error *error) {
    const ps_sampler_request *const sampler = job->question->rules.sampler;
    ps_text text = {0};
    ps_text_append(&text, "shade\n");
    if (sampler != NULL) {
        ps_sampler_identify(sampler, &text);
    }
    const pspec_status status = ps_text_check(&text, error);
    job->seed = ps_random_seed_of(job->question->seed, PS_STREAM_TRIALS, ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

static uint64_t choose_orientations(const ps_shade_job *job) {
    const ps_quadrature_setup *const setup = &job->rules->setup;
    const uint64_t num =
        setup->needs.one_realization || setup->num_realizations == 0 ? 1 : setup->num_realizations;
    return job->question->num_orientations != PS_USUAL_ORIENTATIONS
               ? job->question->num_orientations
               : (USUAL_ORIENTATIONS + num - 1) / num;
}

pspec_status ps_shade_job_create(ps_shade_job **out, const ps_shade_question *question,
                                 ps_error *error) {
    ps_shade_job *job = NULL;
    PS_TRY(PS_NEW(&job, 1, "a job", error));
    job->question = question;
    job->rules_question = question->rules;
    job->rules_question.observer = (ps_rule_observer){begin, hear, job};
    pspec_status status = ps_quadrature_job_create(&job->rules, &job->rules_question, error);
    if (status == PSPEC_OK) {
        job->result.num_orientations = choose_orientations(job);
        status = choose_seed(job, error);
    }
    if (status != PSPEC_OK) {
        ps_shade_job_destroy(job);
        return status;
    }
    *out = job;
    return PSPEC_OK;
}

void ps_shade_job_destroy(ps_shade_job *job) {
    if (job == NULL) {
        return;
    }
    ps_trials_destroy(job->trials);
    ps_quadrature_job_destroy(job->rules);
    free(job->moves);
    free(job);
}

static ps_mean finish(const ps_sums *sums, uint64_t num) {
    ps_mean out;
    ps_sums_finish(sums, num, &out.mean, &out.standard_error);
    return out;
}

pspec_status ps_shade_job_run(ps_shade_job *job, ps_error *error) {
    ps_shade_result *const out = &job->result;
    PS_TRY(ps_quadrature_job_run(job->rules, error));
    out->measured = finish(&job->measured, job->num_rules);
    out->predicted = finish(&job->predicted, job->num_rules);
    out->beyond = finish(&job->beyond, job->num_rules).mean;
    if (out->num_orientations == 0) {
        out->measured = (ps_mean){NAN, NAN};
    }
    if (job->num_rules == 1 && out->num_orientations > 0) {
        out->measured = finish(&job->orientations, out->num_orientations);
    }
    if (job->num_rules == 1) {
        out->predicted.standard_error = 0;
    }
    ps_trials_destroy(job->trials);
    job->trials = NULL;
    return PSPEC_OK;
}
