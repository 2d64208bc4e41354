#include "jobs/variance/variance_sets.h"

#include "base/memory.h"
#include "jobs/rows/set_loop.h"
#include "points/lists/weight_list.h"

#include <math.h>
#include <stdlib.h>

/* What counting has so far. */
typedef struct count {
    const ps_power_question *question;
    ps_point_set set;
    double *shares; /* [num] V/W^2 of every set */
    size_t num, capacity;
} count;

pspec_status ps_variance_sets_next(ps_source *source, ps_point_set *set, ps_error *error) {
    bool has_set = false;
    PS_TRY(ps_source_next_whole(source, set, &has_set, error));
    return has_set ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INPUT,
                             "the files have fewer sets now than when they were counted");
}

/* ---- counting ------------------------------------------------------------------------------ */

/* The set counts, and so do its weights. */
static pspec_status add_set(ps_variance_sets *sets, count *so_far, ps_error *error) {
    const ps_point_set *const set = &so_far->set;
    const double *const own = set->has_weights ? set->weights : NULL;
    const pspec_pattern pattern = {set->dimension, set->num_points, set->points,
                                   sets->weights != NULL ? sets->weights : own};
    ps_pattern_count points = {.realization = so_far->num,
                               .on_sphere = so_far->question->on_sphere};
    ps_pattern_sums sums;
    void *memory = so_far->shares;
    if (sets->weights != NULL && sets->num_weights != set->num_points) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "\"%s\" holds %zu weights, but a set has %zu points",
                       so_far->question->weights.path, sets->num_weights, set->num_points);
    }
    PS_TRY(ps_pattern_check_dimension(set->dimension, sets->dimension, so_far->num, error));
    PS_TRY(ps_pattern_count_add(&points, &pattern, error));
    PS_TRY(ps_pattern_count_finish(&points, PSPEC_NORMALIZATION_INTEGRAL, &sums, error));
    PS_TRY(
        ps_grow(&memory, &so_far->capacity, so_far->num + 1, sizeof(double), "point sets", error));
    so_far->shares = memory;
    const double sum2 = sums.weight_sum * sums.weight_sum;
    sets->size = so_far->num == 0 ? sums.weight_size_sum * sums.weight_size_sum / sum2 : sets->size;
    sets->most_points = set->num_points > sets->most_points ? set->num_points : sets->most_points;
    so_far->shares[so_far->num++] = sums.weight_square_sum / sum2;
    return PSPEC_OK;
}

static pspec_status begin(ps_variance_sets *sets, const count *so_far, ps_error *error) {
    const ps_power_question *const question = so_far->question;
    sets->dimension = so_far->set.dimension;
    return question->weights.path == NULL
               ? PSPEC_OK
               : ps_read_weights(question->weights.path, so_far->set.num_points, &sets->weights,
                                 &sets->num_weights, error);
}

static pspec_status count_all(ps_variance_sets *sets, count *so_far, ps_error *error) {
    bool has_set = true;
    while (has_set) {
        PS_TRY(
            ps_watch_tell(&so_far->question->watch, "sets counted", so_far->num, 0, NULL, error));
        PS_TRY(ps_source_next_whole(sets->source, &so_far->set, &has_set, error));
        if (has_set && so_far->num == 0) {
            PS_TRY(begin(sets, so_far, error));
        }
        PS_TRY(has_set ? add_set(sets, so_far, error) : PSPEC_OK);
    }
    return so_far->num > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to measure");
}

static void finish(ps_variance_sets *sets, const count *so_far, bool measures) {
    long double sum = 0;
    sets->num = so_far->num;
    sets->num_predicting = measures ? (sets->num + 1) / 2 : sets->num;
    for (uint64_t i = 0; i < sets->num_predicting; i++) {
        sum += so_far->shares[i];
    }
    sets->white = (double)(sum / sets->num_predicting);
}

pspec_status ps_variance_sets_open(ps_variance_sets *sets, const ps_power_question *question,
                                   bool measures, ps_error *error) {
    const ps_source_options options = {.points = question->point_options, .kept_bytes = UINT64_MAX};
    count so_far = {.question = question};
    *sets = (ps_variance_sets){0};
    PS_TRY(ps_source_files(&sets->source, question->paths, question->num_paths, &options, error));
    pspec_status status = count_all(sets, &so_far, error);
    if (status == PSPEC_OK) {
        finish(sets, &so_far, measures);
        status = ps_source_rewind(sets->source, error);
    }
    ps_point_set_free(&so_far.set);
    free(so_far.shares);
    return status;
}

void ps_variance_sets_close(ps_variance_sets *sets) {
    ps_source_destroy(sets->source);
    free(sets->weights);
    *sets = (ps_variance_sets){0};
}

/* ---- what is measured ---------------------------------------------------------------------- */

uint64_t ps_variance_sets_measured(const ps_variance_sets *sets) {
    return sets->num > 1 ? sets->num - sets->num_predicting : 1;
}

pspec_status ps_variance_sets_seek(ps_variance_sets *sets, ps_error *error) {
    const uint64_t before = sets->num > 1 ? sets->num_predicting : 0;
    uint64_t passed = 0;
    PS_TRY(ps_source_rewind(sets->source, error));
    return ps_source_pass(sets->source, before, NULL, &passed, error);
}
