#include "jobs/interpolation/interpolation_job.h"

#include "base/memory.h"
#include "spectra/row_tape.h"
#include "math/neumaier.h"
#include "math/sobolev.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels times points of one call, which nobody can stop: some tenths of a second of two cores; and
 * pixels, whose directions and values take little memory then. */
static const double call_pairs = 1 << 26;
static const double call_pixels = 1 << 14;

/* ---- create -------------------------------------------------------------------------------- */

static pspec_status open_source(ps_interpolation_job *job, ps_error *error) {
    const ps_interpolation_question *const question = job->question;
    ps_source **const source = &job->sets.source;
    if (question->sampler != NULL) {
        const ps_sets_options options = ps_limits_sets(&question->limits, question->no_skip);
        return ps_source_sampler(source, question->sampler, ps_interpolation_num_sets(question),
                                 &options, &question->watch, error);
    }
    const ps_source_options options = {.points = question->point_options,
                                       .whole_bytes = UINT64_MAX}; /* a system is of all points */
    return ps_source_files(source, question->paths, question->num_paths, &options, error);
}

static pspec_status find_points(ps_interpolation_job *job, ps_error *error) {
    const ps_sampler_request *const sampler = job->question->sampler;
    bool has_set = false;
    if (sampler != NULL) {
        job->first_points = ps_sampler_most_points(sampler);
        return PSPEC_OK;
    }
    PS_TRY(ps_power_sets_peek(&job->sets, &has_set, error));
    job->first_points = job->sets.next.num_points;
    return has_set ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to interpolate at");
}

static pspec_status check_memory(const ps_interpolation_question *question, size_t num_points,
                                 ps_error *error) {
    const uint64_t limit = question->limits.constraints.memory_limit;
    const uint64_t bytes = ps_interpolation_bytes(question, num_points);
    return limit == 0 || bytes <= limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "interpolation at %zu points takes %llu bytes, more than the memory limit "
                         "(--memory) of %llu",
                         num_points, (unsigned long long)bytes, (unsigned long long)limit);
}

static pspec_status prepare(ps_interpolation_job *job, ps_error *error) {
    const ps_interpolation_question *const question = job->question;
    PS_TRY(open_source(job, error));
    PS_TRY(find_points(job, error));
    PS_TRY(check_memory(question, job->first_points, error));
    return ps_interpolation_is_dense(question, job->first_points)
               ? PSPEC_OK
               : ps_limits_open_device(&question->limits, question->open_device, true, &job->device,
                                       &job->owns_device, error);
}

pspec_status ps_interpolation_job_create(ps_interpolation_job **out,
                                         const ps_interpolation_question *question,
                                         ps_error *error) {
    ps_interpolation_job *job = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&job, 1, "a job", error));
    job->question = question;
    const pspec_status status = prepare(job, error);
    if (status != PSPEC_OK) {
        ps_interpolation_job_destroy(job);
        return status;
    }
    *out = job;
    return PSPEC_OK;
}

void ps_interpolation_job_release(ps_interpolation_job *job) {
    ps_power_sets_free(&job->sets);
    free(job->block);
    free(job->directions);
    job->block = job->directions = NULL;
    job->most_points = 0;
}

void ps_interpolation_job_destroy(ps_interpolation_job *job) {
    if (job == NULL) {
        return;
    }
    ps_interpolation_job_release(job);
    if (job->owns_device) {
        ps_device_close(job->device);
    }
    free(job->rows);
    free(job->images);
    free(job);
}

/* ---- one set ------------------------------------------------------------------------------- */

/* For a set of so many points, which files may have more of than the first. */
static pspec_status make_room(ps_interpolation_job *job, size_t num_points, ps_error *error) {
    const ps_panorama *const panorama = job->question->panorama;
    if (num_points <= job->most_points) {
        return PSPEC_OK;
    }
    const double fit = fmin(call_pixels, call_pairs / (double)num_points) / (double)panorama->width;
    free(job->block);
    free(job->directions);
    job->block = job->directions = NULL;
    job->most_points = num_points;
    job->rows_of_block = fit < (double)panorama->height ? (size_t)fit + 1 : panorama->height;
    PS_TRY(ps_allocate_for(&job->block, num_points, 2 * panorama->num * sizeof(double), "values",
                           error));
    job->values = job->block;
    job->alpha = job->values + panorama->num * num_points;
    PS_TRY(PS_NEW(&job->directions, job->rows_of_block * panorama->width * (3 + panorama->num),
                  "pixels", error));
    job->pixels = job->directions + job->rows_of_block * panorama->width * 3;
    return PSPEC_OK;
}

/* Unit vectors, and the functions there. */
static pspec_status take_values(ps_interpolation_job *job, ps_point_set *set, ps_error *error) {
    const ps_panorama *const panorama = job->question->panorama;
    ps_pattern_count count = {.realization = job->number, .on_sphere = true};
    PS_TRY(ps_pattern_count_add(&count, &job->sets.patterns[0], error));
    PS_TRY(check_memory(job->question, set->num_points, error));
    PS_TRY(make_room(job, set->num_points, error));
    for (size_t j = 0; j < set->num_points; j++) {
        ps_pattern_straighten(set->points + 3 * j);
    }
    for (size_t f = 0; f < panorama->num; f++) {
        PS_TRY(ps_panorama_values(panorama, f, set->points, set->num_points,
                                  job->values + f * set->num_points, error));
    }
    return PSPEC_OK;
}

/* ---- a kernel ------------------------------------------------------------------------------ */

/* All functions by one kernel. */
typedef struct interpolant {
    ps_interpolation_job *job;
    const ps_point_set *set;
    size_t index; /* of the kernel */
    ps_error *error;
} interpolant;

static size_t num_functions(const interpolant *self) {
    return self->job->question->panorama->num;
}

/* With the set. */
static ps_interpolation_error *error_of(const interpolant *self, size_t function) {
    return &self->job->errors[self->index * num_functions(self) + function];
}

static void evaluate(const interpolant *self, size_t num, const double *at, double *values) {
    ps_kernel_interpolate(self->set->num_points, self->set->points,
                          self->job->question->smoothness[self->index], num_functions(self),
                          self->job->alpha, num, at, values);
}

/* Adds the largest differences at some of the points to those of each function. */
static void compare_points(const interpolant *self, size_t first, size_t num, double *off) {
    for (size_t i = 0; i < num_functions(self); i++) {
        const double *const f = self->job->values + i * self->set->num_points + first;
        const double *const found = self->job->pixels + i * num;
        for (size_t j = 0; j < num; j++) {
            off[i] = fmax(off[i], fabs(found[j] - f[j]));
        }
    }
}

/* What is left of the equations, by sums that solved none of them. */
static pspec_status check_points(const interpolant *self) {
    const ps_interpolation_job *const job = self->job;
    const size_t num = self->set->num_points;
    const size_t at_a_time = job->rows_of_block * job->question->panorama->width;
    double off[PS_SOBOLEV_MOST_SUMS] = {0};
    for (size_t first = 0; first < num; first += at_a_time) {
        const size_t some = num - first < at_a_time ? num - first : at_a_time;
        PS_TRY(ps_watch_tell(&job->question->watch, "interpolation: points", first, num, NULL,
                             self->error));
        evaluate(self, some, self->set->points + 3 * first, job->pixels);
        compare_points(self, first, some, off);
    }
    for (size_t i = 0; i < num_functions(self); i++) {
        double most = 0;
        for (size_t j = 0; j < num; j++) {
            most = fmax(most, fabs(job->values[i * num + j]));
        }
        error_of(self, i)->residual = most > 0 ? off[i] / most : off[i];
    }
    return PSPEC_OK;
}

/* Returns the part of the mean square that a line of pixels has. */
static double compare_line(const interpolant *self, size_t function, size_t line,
                           const double *found) {
    const ps_panorama *const panorama = self->job->question->panorama;
    const double *const f =
        panorama->values + (function * panorama->height + line) * panorama->width;
    ps_interpolation_error *const error = error_of(self, function);
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < panorama->width; j++) {
        const double off = found[j] - f[j];
        ps_neumaier_add(&sum, off * off);
        error->largest_error = fmax(error->largest_error, fabs(off));
    }
    return ps_neumaier_value(&sum) * ps_panorama_share(panorama, line);
}

/* Adds the squares of num lines, whose values are there; keeps the image of the first set. */
static void compare_lines(const interpolant *self, size_t first, size_t num, ps_neumaier *squares) {
    const ps_interpolation_job *const job = self->job;
    const ps_panorama *const panorama = job->question->panorama;
    const size_t width = panorama->width;
    for (size_t i = 0; i < num_functions(self); i++) {
        const double *const found = job->pixels + i * num * width;
        for (size_t line = 0; line < num; line++) {
            ps_neumaier_add(&squares[i], compare_line(self, i, first + line, found + line * width));
        }
        if (job->images != NULL &&
            job->number == ps_row_tape_first(job->question->limits.checkpoint.tape)) {
            const size_t image = self->index * num_functions(self) + i;
            memcpy(job->images + (image * panorama->height + first) * width, found,
                   num * width * sizeof *found);
        }
    }
}

static pspec_status compare(const interpolant *self) {
    ps_interpolation_job *const job = self->job;
    const ps_panorama *const panorama = job->question->panorama;
    ps_neumaier squares[PS_SOBOLEV_MOST_SUMS] = {{0, 0}};
    for (size_t first = 0; first < panorama->height; first += job->rows_of_block) {
        const size_t left = panorama->height - first;
        const size_t num = left < job->rows_of_block ? left : job->rows_of_block;
        PS_TRY(ps_watch_tell(&job->question->watch, "interpolation: rows of pixels", first,
                             panorama->height, NULL, self->error));
        ps_panorama_directions(panorama, first, num, job->directions);
        evaluate(self, num * panorama->width, job->directions, job->pixels);
        compare_lines(self, first, num, squares);
    }
    for (size_t i = 0; i < num_functions(self); i++) {
        error_of(self, i)->square = ps_neumaier_value(&squares[i]);
    }
    return PSPEC_OK;
}

static pspec_status solve(const interpolant *self, ps_kernel_system *system) {
    const size_t num = self->set->num_points;
    for (size_t i = 0; i < num_functions(self); i++) {
        const double *const f = self->job->values + i * num;
        double *const alpha = self->job->alpha + i * num;
        ps_interpolation_error *const own = error_of(self, i);
        PS_TRY(ps_kernel_system_solve(system, f, alpha, NULL, self->error));
        const ps_kernel_facts facts = ps_kernel_system_facts(system);
        const double square = ps_kernel_dot(num, f, alpha);
        own->norm = fmax(square, 0); /* of 0, rounding may leave less */
        own->condition = facts.condition;
        own->num_steps = facts.num_steps;
    }
    return PSPEC_OK;
}

static pspec_status interpolate(const interpolant *self) {
    const ps_interpolation_question *const question = self->job->question;
    const ps_kernel_options options = {.memory_limit = question->limits.constraints.memory_limit,
                                       .most_dense = PS_INTERPOLATION_MOST_DENSE,
                                       .residual = question->residual,
                                       .device = self->job->device,
                                       .watch = &question->watch};
    ps_kernel_system *system = NULL;
    PS_TRY(ps_kernel_system_create(&system, self->set->num_points, self->set->points,
                                   question->smoothness[self->index], &options, self->error));
    pspec_status status = ps_kernel_system_check_distinct(system, self->error);
    if (status == PSPEC_OK) {
        status = solve(self, system);
    }
    ps_kernel_system_destroy(system);
    PS_TRY(status);
    PS_TRY(check_points(self));
    return compare(self);
}

pspec_status ps_interpolation_job_use_set(ps_interpolation_job *job, ps_error *error) {
    ps_point_set *const set = &job->sets.sets[0];
    PS_TRY(take_values(job, set, error));
    for (size_t s = 0; s < job->question->num_smoothness; s++) {
        const interpolant one = {job, set, s, error};
        PS_TRY(interpolate(&one));
    }
    return PSPEC_OK;
}
