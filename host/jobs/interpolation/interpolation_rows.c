/* Rows of sets, made and added up, and all of the job. */
#include "base/memory.h"
#include "jobs/interpolation/interpolation_job.h"
#include "jobs/rows/set_loop.h"

#include <math.h>
#include <string.h>

static size_t pixels_of(const ps_interpolation_question *question) {
    return question->panorama->width * question->panorama->height;
}

static size_t num_rows(const ps_interpolation_question *question) {
    return question->num_smoothness * question->panorama->num;
}

/* The row of a set, which errors[num_smoothness][functions] follow. */
typedef struct set_row {
    uint64_t num_points;
    ps_interpolation_error errors[];
} set_row;

static pspec_status make_row(ps_interpolation_job *job, set_row *out, ps_error *error) {
    job->errors = out->errors;
    memset(out->errors, 0, num_rows(job->question) * sizeof *out->errors);
    out->num_points = job->sets.sets[0].num_points;
    return ps_interpolation_job_use_set(job, error);
}

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    ps_interpolation_job *const job = payload;
    const ps_interpolation_question *const question = job->question;
    job->number = first;
    PS_TRY(ps_watch_tell(&question->watch, "realizations", first,
                         ps_interpolation_num_sets(question), NULL, error));
    PS_TRY(ps_power_sets_fill(&job->sets, false, most, num, error));
    return *num > 0 ? make_row(job, rows, error) : PSPEC_OK;
}

static void take(void *payload, uint64_t number, const void *row) {
    ps_interpolation_job *const job = payload;
    const set_row *const set = row;
    for (size_t i = 0; i < num_rows(job->question); i++) {
        const ps_interpolation_error *const one = &set->errors[i];
        ps_interpolation_row *const sum = &job->rows[i];
        ps_sums_add(&sum->squares, one->square);
        ps_sums_add(&sum->norms, one->norm);
        sum->largest_error = fmax(sum->largest_error, one->largest_error);
        sum->residual = fmax(sum->residual, one->residual);
        sum->condition = fmax(sum->condition, one->condition);
        sum->num_steps = one->num_steps > sum->num_steps ? one->num_steps : sum->num_steps;
    }
    job->num_realizations++;
    job->num_points += set->num_points;
    if (number == 0 || set->num_points < job->smallest_points) {
        job->smallest_points = set->num_points;
    }
    if (set->num_points > job->largest_points) {
        job->largest_points = set->num_points;
    }
}

static pspec_status look(void *payload, ps_error *error) {
    const ps_interpolation_job *const job = payload;
    return ps_watch_tell(&job->question->watch, "sets passed over", 0, 0, NULL, error);
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    ps_interpolation_job *const job = payload;
    ps_passed_sets sets = {0};
    PS_TRY(ps_power_sets_skip(&job->sets, num, look, job, &sets, error));
    *passed = sets.num;
    return PSPEC_OK;
}

static size_t num_images(const ps_interpolation_question *question) {
    return question->keeps_images ? num_rows(question) : 0;
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_interpolation_job *const job = payload;
    const ps_interpolation_question *const question = job->question;
    uint64_t counts[] = {job->num_realizations, job->num_points, job->smallest_points,
                         job->largest_points};
    enum { REALIZATIONS, POINTS, SMALLEST, LARGEST, NUM };
    PS_TRY(ps_snapshot_counts(snapshot, "sets", counts, NUM, error));
    PS_TRY(ps_snapshot_bytes(snapshot, "rows", job->rows, num_rows(question) * sizeof *job->rows,
                             error));
    job->num_realizations = counts[REALIZATIONS];
    job->num_points = counts[POINTS];
    job->smallest_points = counts[SMALLEST];
    job->largest_points = counts[LARGEST];
    return ps_snapshot_doubles(snapshot, "images", job->images,
                               num_images(question) * pixels_of(question), error);
}

pspec_status ps_interpolation_job_run(ps_interpolation_job *job, ps_error *error) {
    const ps_interpolation_question *const question = job->question;
    ps_set_loop loop = {
        .stream = {.job = job,
                   .make = make,
                   .pass = pass,
                   .row_bytes = sizeof(set_row) + num_rows(question) * sizeof *job->errors,
                   .batch = 1,
                   .total = question->sampler != NULL ? ps_interpolation_num_sets(question) : 0,
                   .are_sampled = question->sampler != NULL,
                   .keeps_first = job->question->keeps_images,
                   .device = job->device},
        .take = take,
        .walk = walk,
        .spec = &question->limits.checkpoint};
    const ps_row_tape *const tape = question->limits.checkpoint.tape;
    if (tape != NULL && loop.stream.total == 1) {
        return ps_range_refuse_one(&tape->range, question->num_realizations > 1, error);
    }
    PS_TRY(PS_NEW(&job->rows, num_rows(question), "errors", error));
    if (num_images(question) > 0) {
        PS_TRY(ps_allocate_for(&job->images, num_images(question),
                               pixels_of(question) * sizeof(double), "images", error));
    }
    PS_TRY(ps_power_sets_allocate(&job->sets, 1, error));
    return ps_set_loop_run(&loop, error);
}

const ps_interpolation_row *ps_interpolation_job_row(const ps_interpolation_job *job,
                                                     size_t smoothness, size_t function) {
    return &job->rows[smoothness * job->question->panorama->num + function];
}
