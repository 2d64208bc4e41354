#include "jobs/occlusion/occlusion_job.h"

#include "base/memory.h"
#include "jobs/occlusion/rays.h"
#include "jobs/rows/set_loop.h"
#include "math/neumaier.h"
#include "math/random/random.h"

#include <math.h>
#include <stdlib.h>

typedef struct work {
    const ps_occlusion_question *question;
    ps_occlusion_result *result;
    ps_source *source;
    ps_point_set set;
    ps_rays *rays;
    size_t most_points; /* that rays have room for */
    uint64_t seed;
    uint32_t *counts; /* [num_pixels] */
    ps_sums squares;  /* of realizations: means over pixels */
    ps_sums pixels;   /* squares of the last realization */
    ps_neumaier seen, points;
} work;

/* Of a realization. */
typedef struct set_row {
    uint64_t num_points;
    double seen;    /* sum of V over pixels */
    ps_sums pixels; /* of squares of what they are off */
} set_row;

/* ---- memory ---------------------------------------------------------------------------------- */

uint64_t ps_occlusion_bytes(const ps_occlusion_size *size) {
    const uint64_t pixels = (uint64_t)size->view->width * size->view->height;
    const ps_view all = {.num_pixels = pixels, .num_triangles = size->view->num_triangles};
    /* counts, and sums of two kinds for the reference */
    const uint64_t of_pixel =
        sizeof(uint32_t) + 2 * sizeof(double) + size->num_images * sizeof(double);
    return pixels * of_pixel + 3 * size->num_points * sizeof(double) +
           ps_view_bytes(pixels, all.num_triangles) +
           ps_rays_bytes(&all, size->num_points, size->device);
}

pspec_status ps_occlusion_check_memory(const ps_occlusion_size *size, uint64_t limit,
                                       ps_error *error) {
    const uint64_t bytes = ps_occlusion_bytes(size);
    return limit == 0 || bytes <= limit
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%zu x %zu pixels and sets of %zu directions take %llu bytes, more than "
                         "the memory limit (--memory) of %llu",
                         size->view->width, size->view->height, size->num_points,
                         (unsigned long long)bytes, (unsigned long long)limit);
}

/* ---- sets ----------------------------------------------------------------------------------- */

static bool is_folded(const ps_occlusion_question *question) {
    return question->is_folded ||
           (question->sampler != NULL && ps_sampler_is_on_hemisphere(question->sampler));
}

/* Samplers, sets of a request and numbers of points have turns of their own, so that answers beside
 * each other are independent. */
static pspec_status choose_seed(work *self, ps_error *error) {
    const ps_occlusion_question *const question = self->question;
    const ps_sampler_request *const sampler = question->sampler;
    ps_text text = {0};
    ps_text_append(&text, "occlusion\n");
    if (sampler != NULL) {
        ps_sampler_identify(sampler, &text);
        ps_text_append(&text, "lift %d\n", (int)sampler->lift);
    } else {
        ps_text_append(&text, "set %s\n", question->name != NULL ? question->name : "");
    }
    const pspec_status status = ps_text_check(&text, error);
    self->seed = ps_random_seed_of(sampler != NULL ? sampler->seed : question->seed,
                                   PS_STREAM_TRIALS, ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

static pspec_status open_source(work *self, ps_error *error) {
    const ps_occlusion_question *const question = self->question;
    const ps_source_options options = {.points = question->point_options};
    return question->sampler != NULL
               ? ps_source_sampler(&self->source, question->sampler, question->num_realizations,
                                   &question->sets, question->watch, error)
               : ps_source_files(&self->source, question->paths, question->num_paths, &options,
                                 error);
}

static pspec_status next_set(work *self, uint64_t number, bool *has_set, ps_error *error) {
    PS_TRY(ps_source_next_whole(self->source, &self->set, has_set, error));
    const pspec_pattern pattern = {self->set.dimension, self->set.num_points, self->set.points,
                                   NULL};
    ps_pattern_count count = {.realization = number, .on_sphere = true};
    return *has_set && self->question->sampler == NULL
               ? ps_pattern_count_add(&count, &pattern, error)
               : PSPEC_OK;
}

static pspec_status make_room(work *self, ps_error *error) {
    const ps_occlusion_question *const question = self->question;
    if (self->rays != NULL && self->set.num_points <= self->most_points) {
        return PSPEC_OK;
    }
    const ps_occlusion_size size = {question->view, self->set.num_points, question->num_images,
                                    question->device};
    PS_TRY(ps_occlusion_check_memory(&size, question->memory_limit, error));
    ps_rays_destroy(self->rays);
    self->rays = NULL;
    self->most_points = self->set.num_points;
    return ps_rays_create(&self->rays, question->view, self->most_points, question->device, error);
}

/* ---- one realization ------------------------------------------------------------------------ */

/* Keeps the image of the first set. */
static void compare(work *self, uint64_t number, set_row *row) {
    const ps_reference *const reference = self->question->reference;
    const size_t num_pixels = self->question->view->num_pixels;
    const double share = (is_folded(self->question) ? 1.0 : 2.0) / (double)self->set.num_points;
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < num_pixels; i++) {
        const double seen = share * self->counts[i];
        const double off = seen - reference->seen[i];
        ps_sums_add(&row->pixels, off * off);
        ps_neumaier_add(&sum, seen);
        if (number == ps_row_tape_first(self->question->checkpoint.tape)) {
            self->result->seen[i] = seen;
        }
    }
    row->seen = ps_neumaier_value(&sum);
}

static pspec_status make_row(work *self, uint64_t number, set_row *row, ps_error *error) {
    const ps_occlusion_question *const question = self->question;
    const ps_ray_set set = {.points = self->set.points,
                            .num = self->set.num_points,
                            .is_folded = is_folded(question),
                            .seed = self->seed,
                            .number = number};
    *row = (set_row){.num_points = self->set.num_points};
    PS_TRY(make_room(self, error));
    PS_TRY(ps_rays_count(self->rays, &set, self->counts, question->watch, error));
    compare(self, number, row);
    return PSPEC_OK;
}

/* ---- all of them ---------------------------------------------------------------------------- */

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    work *const self = payload;
    const ps_occlusion_question *const question = self->question;
    const uint64_t total = question->sampler != NULL ? question->num_realizations : 0;
    bool has_set = most > 0 && (total == 0 || first < total);
    PS_TRY(ps_watch_tell(question->watch, "realizations", first, total, NULL, error));
    PS_TRY(has_set ? next_set(self, first, &has_set, error) : PSPEC_OK);
    *num = has_set ? 1 : 0;
    return has_set ? make_row(self, first, rows, error) : PSPEC_OK;
}

static void take(void *payload, uint64_t number, const void *row) {
    work *const self = payload;
    const set_row *const set = row;
    ps_occlusion_result *const result = self->result;
    const uint64_t num = set->num_points;
    double mean = 0;
    double unused = 0;
    ps_sums_finish(&set->pixels, self->question->view->num_pixels, &mean, &unused);
    ps_sums_add(&self->squares, mean);
    self->pixels = set->pixels;
    ps_neumaier_add(&self->seen, set->seen);
    ps_neumaier_add(&self->points, (double)num);
    result->smallest_points =
        number == 0 || num < result->smallest_points ? num : result->smallest_points;
    result->largest_points = num > result->largest_points ? num : result->largest_points;
    result->num_realizations++;
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    const work *const self = payload;
    return ps_source_pass(self->source, num, self->question->watch, passed, error);
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    work *const self = payload;
    ps_occlusion_result *const result = self->result;
    enum { REALIZATIONS, SMALLEST, LARGEST, NUM, SUMS = sizeof(ps_sums) / sizeof(double) };
    uint64_t counts[] = {result->num_realizations, result->smallest_points, result->largest_points};
    double *const totals[] = {&self->seen.sum, &self->seen.lost, &self->points.sum,
                              &self->points.lost};
    PS_TRY(ps_snapshot_counts(snapshot, "sets", counts, NUM, error));
    PS_TRY(ps_snapshot_gather(snapshot, "totals", totals, 4, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "squares", (double *)&self->squares, SUMS, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "pixels", (double *)&self->pixels, SUMS, error));
    result->num_realizations = counts[REALIZATIONS];
    result->smallest_points = counts[SMALLEST];
    result->largest_points = counts[LARGEST];
    return ps_snapshot_doubles(snapshot, "image", result->seen, self->question->view->num_pixels,
                               error);
}

static pspec_status add_all(work *self, ps_error *error) {
    const ps_occlusion_question *const question = self->question;
    ps_set_loop loop = {
        .stream = {.job = self,
                   .make = make,
                   .pass = pass,
                   .row_bytes = sizeof(set_row),
                   .batch = 1,
                   .total = question->sampler != NULL ? question->num_realizations : 0,
                   .are_sampled = question->sampler != NULL,
                   .keeps_first = true,
                   .device = question->device},
        .take = take,
        .walk = walk,
        .spec = &question->checkpoint};
    PS_TRY(ps_set_loop_run(&loop, error));
    return self->result->num_realizations > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "the files have no point sets");
}

static void finish(work *self) {
    ps_occlusion_result *const result = self->result;
    const size_t num_pixels = self->question->view->num_pixels;
    const double num = (double)result->num_realizations;
    double unused = 0;
    ps_sums_finish(&self->squares, result->num_realizations, &result->squared.mean,
                   &result->squared.standard_error);
    if (result->num_realizations < 2) {
        ps_sums_finish(&self->pixels, num_pixels, &unused, &result->squared.standard_error);
    }
    result->squared.mean -= self->question->reference->variance;
    result->squared.standard_error =
        hypot(result->squared.standard_error, self->question->reference->variance_error);
    result->mean = ps_neumaier_value(&self->seen) / (num * (double)num_pixels);
    result->mean_points = ps_neumaier_value(&self->points) / num;
}

pspec_status ps_occlusion_run(ps_occlusion_result *out, const ps_occlusion_question *question,
                              ps_error *error) {
    const size_t num_pixels = question->view->num_pixels;
    work self = {.question = question, .result = out};
    pspec_status status = PSPEC_OK;
    *out = (ps_occlusion_result){0};
    PS_TRY_OUT(status, PS_NEW(&out->seen, num_pixels, "pixels", error));
    PS_TRY_OUT(status, PS_NEW(&self.counts, num_pixels, "counts of rays", error));
    PS_TRY_OUT(status, choose_seed(&self, error));
    PS_TRY_OUT(status, open_source(&self, error));
    PS_TRY_OUT(status, add_all(&self, error));
    finish(&self);
out:
    ps_source_destroy(self.source);
    ps_point_set_free(&self.set);
    ps_rays_destroy(self.rays);
    free(self.counts);
    return status;
}

void ps_occlusion_result_free(ps_occlusion_result *result) {
    free(result->seen);
    *result = (ps_occlusion_result){0};
}
