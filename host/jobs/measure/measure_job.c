#include "jobs/measure/measure_job.h"

#include "base/memory.h"
#include "jobs/rows/set_loop.h"
#include "math/neumaier.h"
#include "rules/worst_case_error.h"

#include <math.h>
#include <stdlib.h>

/* The numbers of a set, which are averaged. */
enum {
    ROW_POINTS,
    ROW_DIMENSION,
    ROW_MEASURES,
    ROW_CORRELATION = ROW_MEASURES + PS_NUM_MEASURES,
    ROW_VARIANCE = ROW_CORRELATION + NEAR_BINS,
    ROW_NUMBERS = ROW_VARIANCE + NEAR_WINDOWS
};

typedef struct work {
    ps_measure_question *question;
    ps_measure_result *result;
    ps_device *device;
    ps_source *source; /* of a sampler, or borrowed from the result */
    ps_point_set set;
    ps_near *near;               /* NULL: not yet, or nothing needs it */
    ps_discrepancy *discrepancy; /* the same */
    ps_sums sums[ROW_NUMBERS];
} work;

/* ---- what is needed -------------------------------------------------------------------------- */

static bool is_wanted(const ps_measure_question *question, size_t measure, unsigned dimension) {
    return (question->wanted >> measure & 1) != 0 &&
           ps_measure_is_of(&ps_measure_rows[measure], dimension, question->spectrum.on_sphere);
}

static bool is_too_large(const ps_measure_question *question, size_t measure, size_t num) {
    const size_t most = ps_measure_rows[measure].most_points;
    return most > 0 && num > most && !question->are_named;
}

/* Of a set of so many points. */
static unsigned find_needs(const ps_measure_question *question, unsigned dimension, size_t num) {
    unsigned needs = 0;
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        if (is_wanted(question, i, dimension) && !is_too_large(question, i, num)) {
            needs |= ps_measure_rows[i].needs;
        }
    }
    return needs;
}

/* ---- sets ------------------------------------------------------------------------------------ */

/* A set that is the same every time is looked at once. */
static bool is_one_for_all(const ps_measure_question *question) {
    const ps_sampler_request *const sampler = question->spectrum.sampler;
    return sampler != NULL && !question->spectrum.accuracy.no_skip &&
           ps_sampler_has_constant_power(sampler);
}

static uint64_t count_sets(const ps_measure_question *question) {
    return question->spectrum.sampler == NULL ? 0
           : is_one_for_all(question)         ? 1
                                              : question->spectrum.num_realizations;
}

static pspec_status open_source(work *self, ps_error *error) {
    const ps_power_question *const spectrum = &self->question->spectrum;
    if (spectrum->sampler == NULL) {
        self->source = self->result->source;
        return self->result->spectrum != NULL ? ps_source_rewind(self->source, error) : PSPEC_OK;
    }
    const ps_sets_options sets = ps_limits_sets(&spectrum->limits, spectrum->accuracy.no_skip);
    return ps_source_sampler(&self->source, spectrum->sampler, count_sets(self->question), &sets,
                             &spectrum->watch, error);
}

/* Vectors stand for their directions. */
static void normalize(ps_point_set *set) {
    for (size_t j = 0; j < set->num_points; j++) {
        double *const u = set->points + 3 * j;
        const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        for (size_t i = 0; i < 3; i++) {
            u[i] /= length;
        }
    }
}

static pspec_status next_set(work *self, uint64_t number, bool *has_set, ps_error *error) {
    ps_measure_result *const result = self->result;
    const bool on_sphere = self->question->spectrum.on_sphere;
    PS_TRY(ps_source_next_whole(self->source, &self->set, has_set, error));
    const pspec_pattern pattern = {self->set.dimension, self->set.num_points, self->set.points,
                                   NULL};
    ps_pattern_count count = {.realization = number, .on_sphere = on_sphere};
    if (!*has_set) {
        return PSPEC_OK;
    }
    result->dimension = result->dimension == 0 ? pattern.dimension : result->dimension;
    PS_TRY(ps_pattern_check_dimension(pattern.dimension, result->dimension, number, error));
    if (self->question->spectrum.sampler == NULL) {
        PS_TRY(ps_pattern_count_add(&count, &pattern, error));
    }
    if (on_sphere) {
        normalize(&self->set);
    }
    return PSPEC_OK;
}

/* ---- one set --------------------------------------------------------------------------------- */

static pspec_status look(work *self, ps_measured_set *set, unsigned needs, ps_error *error) {
    if ((needs & PS_MEASURE_NEEDS_NEAR) != 0) {
        const bool with_windows = (needs & PS_MEASURE_NEEDS_WINDOWS) != 0;
        PS_TRY(self->near == NULL ? ps_near_create(&self->near, set->dimension, set->on_sphere,
                                                   with_windows, self->device, error)
                                  : PSPEC_OK);
        PS_TRY(ps_near_look(self->near, set->points, set->num, error));
        set->near = self->near;
    }
    if ((needs & PS_MEASURE_NEEDS_DISCREPANCY) != 0) {
        PS_TRY(self->discrepancy == NULL
                   ? ps_discrepancy_create(&self->discrepancy, set->dimension, self->device, error)
                   : PSPEC_OK);
        PS_TRY(ps_discrepancy_find(self->discrepancy, set->points, set->num, &set->discrepancies,
                                   error));
    }
    if ((needs & PS_MEASURE_NEEDS_CHORDS) != 0) {
        const double smoothness = 1.5; /* |u - v|^(2s - 2) is the distance */
        const ps_rule rule = {set->num, set->points, NULL};
        PS_TRY(ps_rule_distance(&rule, smoothness, &self->question->spectrum.watch,
                                &set->mean_chord, error));
    }
    return PSPEC_OK;
}

static pspec_status fill_row(const work *self, const ps_measured_set *set, double *row,
                             ps_error *error) {
    row[ROW_POINTS] = (double)set->num;
    row[ROW_DIMENSION] = set->dimension;
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        const bool is_made = is_wanted(self->question, i, set->dimension) &&
                             !is_too_large(self->question, i, set->num) &&
                             ps_measure_rows[i].of_set != NULL;
        row[ROW_MEASURES + i] = NAN;
        PS_TRY(is_made ? ps_measure_rows[i].of_set(set, &row[ROW_MEASURES + i], error) : PSPEC_OK);
    }
    for (size_t b = 0; b < NEAR_BINS; b++) {
        row[ROW_CORRELATION + b] =
            set->near != NULL ? ps_near_correlation(set->near, b) : (double)NAN;
    }
    for (size_t w = 0; w < NEAR_WINDOWS; w++) {
        row[ROW_VARIANCE + w] =
            set->near != NULL ? ps_near_number_variance(set->near, w, false) : (double)NAN;
    }
    return PSPEC_OK;
}

static pspec_status make_row(work *self, double *row, ps_error *error) {
    ps_measured_set set = {.points = self->set.points,
                           .num = self->set.num_points,
                           .dimension = self->set.dimension,
                           .on_sphere = self->question->spectrum.on_sphere};
    const unsigned needs = find_needs(self->question, set.dimension, set.num);
    PS_TRY(look(self, &set, needs, error));
    return fill_row(self, &set, row, error);
}

/* ---- all of them ----------------------------------------------------------------------------- */

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    work *const self = payload;
    const uint64_t total = count_sets(self->question);
    bool has_set = most > 0 && (total == 0 || first < total);
    PS_TRY(
        ps_watch_tell(&self->question->spectrum.watch, "sets measured", first, total, NULL, error));
    PS_TRY(has_set ? next_set(self, first, &has_set, error) : PSPEC_OK);
    *num = has_set ? 1 : 0;
    return has_set ? make_row(self, rows, error) : PSPEC_OK;
}

static void take(void *payload, uint64_t number, const void *row) {
    work *const self = payload;
    const double *const numbers = row;
    const uint64_t num = (uint64_t)numbers[ROW_POINTS];
    ps_measure_result *const result = self->result;
    result->smallest_points =
        number == 0 || num < result->smallest_points ? num : result->smallest_points;
    result->largest_points = num > result->largest_points ? num : result->largest_points;
    result->dimension = (unsigned)numbers[ROW_DIMENSION];
    result->num_realizations++;
    for (size_t i = 0; i < ROW_NUMBERS; i++) {
        ps_sums_add(&self->sums[i], numbers[i]);
    }
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    const work *const self = payload;
    return ps_source_pass(self->source, num, &self->question->spectrum.watch, passed, error);
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    work *const self = payload;
    ps_measure_result *const result = self->result;
    enum { REALIZATIONS, SMALLEST, LARGEST, DIMENSION, NUM };
    enum { SUMS = ROW_NUMBERS * sizeof(ps_sums) / sizeof(double) };
    uint64_t counts[] = {result->num_realizations, result->smallest_points, result->largest_points,
                         result->dimension};
    PS_TRY(ps_snapshot_counts(snapshot, "sets", counts, NUM, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "sums", (double *)self->sums, SUMS, error));
    result->num_realizations = counts[REALIZATIONS];
    result->smallest_points = counts[SMALLEST];
    result->largest_points = counts[LARGEST];
    result->dimension = (unsigned)counts[DIMENSION];
    return PSPEC_OK;
}

static ps_mean finish_number(const work *self, size_t i) {
    ps_mean out;
    const ps_measure_result *const result = self->result;
    ps_sums_finish(&self->sums[i], result->num_realizations, &out.mean, &out.standard_error);
    if (is_one_for_all(self->question) && self->question->spectrum.num_realizations > 1) {
        out.standard_error = 0;
    }
    return out;
}

static void finish_sets(work *self) {
    ps_measure_result *const result = self->result;
    const ps_measure_question *const question = self->question;
    result->mean_points = finish_number(self, ROW_POINTS).mean;
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        const ps_measure_set bit = UINT32_C(1) << i;
        result->known |= is_wanted(question, i, result->dimension) ? bit : 0;
        result->left_out |= is_too_large(question, i, result->largest_points) ? bit : 0;
        result->values[i] = finish_number(self, ROW_MEASURES + i);
    }
    result->left_out &= result->known;
    for (size_t b = 0; b < NEAR_BINS; b++) {
        result->correlation[b] = finish_number(self, ROW_CORRELATION + b);
    }
    for (size_t w = 0; w < NEAR_WINDOWS; w++) {
        result->number_variance[w] = finish_number(self, ROW_VARIANCE + w);
    }
    result->reach = (find_needs(question, result->dimension, 0) & PS_MEASURE_NEEDS_NEAR) != 0
                        ? ps_near_reach(result->dimension, question->spectrum.on_sphere)
                        : (double)NAN;
    if (is_one_for_all(question)) {
        result->num_realizations = question->spectrum.num_realizations;
    }
}

static pspec_status measure_sets(work *self, ps_error *error) {
    const ps_power_question *const spectrum = &self->question->spectrum;
    ps_set_loop loop = {.stream = {.job = self,
                                   .make = make,
                                   .pass = pass,
                                   .row_bytes = ROW_NUMBERS * sizeof(double),
                                   .batch = 1,
                                   .total = count_sets(self->question),
                                   .is_whole = is_one_for_all(self->question),
                                   .are_sampled = spectrum->sampler != NULL,
                                   .device = self->device},
                        .take = take,
                        .walk = walk,
                        .spec = &self->question->checkpoint};
    PS_TRY(ps_set_loop_run(&loop, error));
    if (self->result->num_realizations == 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "the files have no point sets");
    }
    finish_sets(self);
    return PSPEC_OK;
}

/* ---- the spectrum ---------------------------------------------------------------------------- */

bool ps_measure_has_spectrum(const ps_measure_question *question) {
    bool has = false;
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        has = has || ((question->wanted >> i & 1) != 0 && ps_measure_rows[i].of_spectrum != NULL);
    }
    return has;
}

/* Once for both. */
static pspec_status open_files(ps_measure_result *result, ps_measure_question *question,
                               ps_error *error) {
    ps_power_question *const spectrum = &question->spectrum;
    const ps_source_options options = {.points = spectrum->point_options};
    if (spectrum->sampler == NULL) {
        PS_TRY(ps_source_files(&result->source, spectrum->paths, spectrum->num_paths, &options,
                               error));
        spectrum->source = result->source;
    }
    return PSPEC_OK;
}

static pspec_status measure_spectrum(ps_measure_result *result, const ps_measure_question *question,
                                     ps_shape *shape, ps_error *error) {
    PS_TRY(ps_power_job_create(&result->spectrum, &question->spectrum, error));
    PS_TRY(ps_power_job_run(result->spectrum, error));
    PS_TRY(ps_shape_find(shape, &result->spectrum->spectrum, NAN, error));
    result->no_exponent = shape->low_reason;
    return PSPEC_OK;
}

static void add_spectrum(ps_measure_result *result, const ps_shape *shape) {
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        if ((result->known >> i & 1) != 0 && ps_measure_rows[i].of_spectrum != NULL) {
            result->values[i] = ps_measure_rows[i].of_spectrum(&result->spectrum->spectrum, shape);
        }
    }
}

/* ---- all of it ------------------------------------------------------------------------------- */

pspec_status ps_measure_run(ps_measure_result *out, ps_measure_question *question,
                            ps_error *error) {
    work self = {.question = question, .result = out, .device = question->spectrum.open_device};
    ps_shape shape = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY(open_files(out, question, error));
    if (ps_measure_has_spectrum(question)) {
        PS_TRY(measure_spectrum(out, question, &shape, error));
    }
    PS_TRY_OUT(status, open_source(&self, error));
    PS_TRY_OUT(status, measure_sets(&self, error));
    add_spectrum(out, &shape);
out:
    ps_near_destroy(self.near);
    ps_discrepancy_destroy(self.discrepancy);
    ps_point_set_free(&self.set);
    if (self.source != out->source) {
        ps_source_destroy(self.source);
    }
    return status;
}

void ps_measure_result_free(ps_measure_result *result) {
    ps_power_job_destroy(result->spectrum);
    ps_source_destroy(result->source);
    *result = (ps_measure_result){0};
}

/* ---- plan ------------------------------------------------------------------------------------ */

/* Of a point of a set, one core of a Zen 4 (PoCL 3.1, a white set of a million points of the
 * plane): near pairs, windows of them, Voronoi cells; of a pair of points, discrepancies. */
static const double near_seconds = 3e-7, window_seconds = 2e-6;
static const double cell_seconds = 1e-6, paired_seconds = 2.5e-10;

void ps_measure_phases(const ps_measure_question *question, ps_phases *phases) {
    const ps_power_question *const spectrum = &question->spectrum;
    const size_t num = spectrum->sampler != NULL ? (size_t)spectrum->sampler->num_points : 0;
    const unsigned dimension = spectrum->sampler != NULL ? spectrum->sampler->dimension : 0;
    const unsigned needs = find_needs(question, dimension, num);
    const double sets = (double)count_sets(question);
    const double points = sets * (double)num;
    ps_phases_add(phases, "cells",
                  (needs & PS_MEASURE_NEEDS_CELLS) != 0 ? points * cell_seconds : 0);
    ps_phases_add(phases, "near pairs",
                  (needs & PS_MEASURE_NEEDS_NEAR) != 0 ? points * near_seconds : 0);
    ps_phases_add(phases, "near pairs",
                  (needs & PS_MEASURE_NEEDS_WINDOWS) != 0 ? points * window_seconds : 0);
    ps_phases_add(
        phases, "discrepancies",
        (needs & PS_MEASURE_NEEDS_DISCREPANCY) != 0 ? points * (double)num * paired_seconds : 0);
}
