#include "engines/torus/nufft/variants.h"

#include "device/reals.h"

#include <math.h>

/* ---- means of cells ---------------------------------------------------------------------- */

/* A sum of weights, and more of them. */
static double add_weights(double sum, const pspec_pattern *pattern, int exponent) {
    if (pattern->weights == NULL) {
        return sum + (double)pattern->num_points;
    }
    for (size_t j = 0; j < pattern->num_points; j++) {
        sum += ldexp(pattern->weights[j], -exponent);
    }
    return sum;
}

/* What frequency 0 leaves in a cell, to be taken off: it then does not round into the others. */
static double mean_of_cells(const ps_nufft_state *self, double weight_sum) {
    const ps_nufft_choice *choice = &self->layout.choice;
    double mean = weight_sum;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const ps_nufft_axis *axis = &choice->axes[i];
        const double q = i == 0 && choice->stride != 0 ? axis->max_frequency : 0;
        mean *= ps_nufft_window_transform(&axis->window, q / axis->n) / axis->n;
    }
    return mean;
}

static int exponent_of(const ps_batch *batch, size_t pattern) {
    return batch->exponents != NULL ? batch->exponents[pattern] : 0;
}

static pspec_status upload_means(ps_nufft_state *self, const ps_batch *some, ps_error *error) {
    for (size_t r = 0; r < some->num_patterns; r++) {
        self->means_of_parts[r] =
            mean_of_cells(self, add_weights(0, &some->patterns[r], exponent_of(some, r)));
    }
    return ps_reals_write(self->device, &self->means, self->precision, self->means_of_parts,
                          some->num_patterns, error);
}

/* ---- very large sets --------------------------------------------------------------------- */

void ps_nufft_large_begin(ps_nufft_state *self) {
    self->large_sum = 0;
    ps_nufft_grid_begin(&self->large);
}

pspec_status ps_nufft_large_add(ps_nufft_state *self, const ps_batch *block, ps_error *error) {
    self->large_sum = add_weights(self->large_sum, &block->patterns[0], exponent_of(block, 0));
    return ps_nufft_grid_add(&self->large, block, error);
}

pspec_status ps_nufft_large_end(ps_nufft_state *self, const ps_nufft_target *target,
                                ps_error *error) {
    const double mean = mean_of_cells(self, self->large_sum);
    PS_TRY(ps_reals_write(self->device, &self->means, self->precision, &mean, 1, error));
    return ps_nufft_grid_finish(&self->large, &self->means, target, error);
}

/* ---- variants ---------------------------------------------------------------------------- */

static pspec_status create_places(ps_nufft_state *self, ps_error *error) {
    return ps_nufft_places_create(&self->places, &self->layout,
                                  self->problem.frequencies->dimension, self->precision,
                                  self->device, error);
}

/* Sorting, then one or two launches that spread and transform, for some realizations at a time; as
 * many for frequency 0 of axis 0, where it is a line, for all of a batch. */
static double count_tiles_launches(const ps_nufft_layout *layout, double num_points,
                                   double realizations) {
    unsigned num_last = 0;
    (void)num_points;
    ps_nufft_last_axes(&layout->choice, &num_last);
    const double of_lines = layout->choice.has_line ? num_last : 0;
    return ceil(realizations / (double)layout->parts) * (1 + num_last) + of_lines;
}

static pspec_status create_tiles(ps_nufft_state *self, ps_error *error) {
    PS_TRY(create_places(self, error));
    return ps_nufft_tiles_create(&self->tiles, &self->layout, self->batch, self->plans,
                                 &self->places, self->precision, self->device, error);
}

/* Points go first: what is written after them waits for the launch before. */
static pspec_status sort_realizations(ps_nufft_state *self, const ps_batch *some, ps_error *error) {
    PS_TRY(ps_nufft_places_upload(&self->places, some, error));
    PS_TRY(upload_means(self, some, error));
    return ps_nufft_places_sort(&self->places, some->num_patterns, error);
}

static pspec_status run_tiles(ps_nufft_state *self, const ps_batch *some,
                              const ps_nufft_target *target, ps_error *error) {
    PS_TRY(sort_realizations(self, some, error));
    return ps_nufft_tiles_run(&self->tiles, some->num_patterns, &self->means, target, error);
}

static pspec_status finish_tiles(ps_nufft_state *self, size_t num_realizations,
                                 const ps_nufft_target *target, ps_error *error) {
    return ps_nufft_tiles_finish(&self->tiles, num_realizations, target, error);
}

static void describe_tiles(const ps_nufft_state *self, ps_text *text) {
    const char *const line = self->layout.choice.has_line ? " line" : "";
    ps_text_append(text, "%s group=%lu", line, (unsigned long)self->layout.group);
}

static void free_tiles(ps_nufft_state *self) {
    ps_nufft_tiles_free(&self->tiles);
    ps_nufft_places_free(&self->places);
}

/* Sorting of every chunk and a launch for each colour of boxes, then one for each axis. */
static double count_large_launches(const ps_nufft_layout *layout, double num_points,
                                   double realizations) {
    unsigned num_last = 0;
    ps_nufft_last_axes(&layout->choice, &num_last);
    const double chunks = ceil(num_points / ((double)layout->parts * (double)layout->part_points));
    const uint32_t *const colours = layout->boxes.colours;
    const double spreading = (double)(colours[0] * colours[1] * colours[2]);
    return realizations * ((1 + spreading) * chunks + 1 + num_last);
}

static pspec_status create_large(ps_nufft_state *self, ps_error *error) {
    PS_TRY(create_places(self, error));
    return ps_nufft_grid_create(&self->large, &self->layout, self->plans, &self->places,
                                self->precision, self->device, error);
}

static pspec_status run_large(ps_nufft_state *self, const ps_batch *one,
                              const ps_nufft_target *target, ps_error *error) {
    ps_nufft_large_begin(self);
    PS_TRY(ps_nufft_large_add(self, one, error));
    return ps_nufft_large_end(self, target, error);
}

static void describe_large(const ps_nufft_state *self, ps_text *text) {
    (void)self;
    ps_text_append(text, " gridded");
}

static void free_large(ps_nufft_state *self) {
    ps_nufft_grid_free(&self->large);
    ps_nufft_places_free(&self->places);
}

static double count_whole_launches(const ps_nufft_layout *layout, double num_points,
                                   double realizations) {
    (void)num_points;
    return ceil(realizations / (double)layout->parts);
}

static pspec_status create_whole(ps_nufft_state *self, ps_error *error) {
    return ps_nufft_whole_create(&self->whole, &self->layout, self->plans, self->precision,
                                 self->device, error);
}

/* Points go first, as those of tiles. */
static pspec_status run_whole(ps_nufft_state *self, const ps_batch *some,
                              const ps_nufft_target *target, ps_error *error) {
    PS_TRY(ps_nufft_whole_upload(&self->whole, some, error));
    PS_TRY(upload_means(self, some, error));
    return ps_nufft_whole_run(&self->whole, some->num_patterns, &self->means, target, error);
}

static void describe_whole(const ps_nufft_state *self, ps_text *text) {
    const uint32_t *const lengths = self->layout.choice.lengths;
    ps_text_append(text, " whole=%lux%lu", (unsigned long)lengths[0], (unsigned long)lengths[1]);
}

static void free_whole(ps_nufft_state *self) {
    ps_nufft_whole_free(&self->whole);
}

/* Sorting and all the rest. */
static double count_strips_launches(const ps_nufft_layout *layout, double num_points,
                                    double realizations) {
    (void)num_points;
    return 2 * ceil(realizations / (double)layout->parts);
}

static pspec_status create_strips(ps_nufft_state *self, ps_error *error) {
    PS_TRY(create_places(self, error));
    return ps_nufft_strips_create(&self->strips, &self->layout, self->plans, &self->places,
                                  self->precision, self->device, error);
}

static pspec_status run_strips(ps_nufft_state *self, const ps_batch *some,
                               const ps_nufft_target *target, ps_error *error) {
    PS_TRY(sort_realizations(self, some, error));
    return ps_nufft_strips_run(&self->strips, some->num_patterns, &self->means, target, error);
}

static void describe_strips(const ps_nufft_state *self, ps_text *text) {
    ps_text_append(text, " strips=%lu", (unsigned long)self->layout.strips.columns);
}

static void free_strips(ps_nufft_state *self) {
    ps_nufft_strips_free(&self->strips);
    ps_nufft_places_free(&self->places);
}

/* Kernels: the sort, and rows and columns of tiles; all that makes tiles of a grid; whole.cl alone;
 * the sort and strips.cl. */
const ps_nufft_variant ps_nufft_variants[PS_NUFFT_NUM_WAYS] = {
    [PS_NUFFT_TILES] = {.count_launches = count_tiles_launches,
                        .kernels = {2, 3},
                        .has_transforms = true,
                        .create = create_tiles,
                        .run = run_tiles,
                        .finish = finish_tiles,
                        .describe = describe_tiles,
                        .free = free_tiles},
    [PS_NUFFT_LARGE] = {.count_launches = count_large_launches,
                        .kernels = {5, 5},
                        .has_transforms = true,
                        .takes_one = true,
                        .create = create_large,
                        .run = run_large,
                        .describe = describe_large,
                        .free = free_large},
    [PS_NUFFT_WHOLE] = {.count_launches = count_whole_launches,
                        .kernels = {1, 1},
                        .create = create_whole,
                        .run = run_whole,
                        .describe = describe_whole,
                        .free = free_whole},
    [PS_NUFFT_STRIPS] = {.count_launches = count_strips_launches,
                         .kernels = {2, 2},
                         .has_transforms = true,
                         .create = create_strips,
                         .run = run_strips,
                         .describe = describe_strips,
                         .free = free_strips},
};
