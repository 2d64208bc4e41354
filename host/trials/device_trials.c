#include "trials/ways.h"

#include "base/memory.h"
#include "base/round.h"
#include "device/reals.h"
#include "engines/engine.h"
#include "integrands/values.h"
#include "math/neumaier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AXES = 3 };

struct ps_device_trials {
    const ps_integrand *integrand;
    ps_trials_options options;
    ps_device *device;
    unsigned lanes;
    size_t axis_numbers, most_pieces, most_moves; /* of a batch */
    ps_kernel *kernel;
    ps_kernel *points_kernel; /* NULL: the host has all points */
    ps_buffer points, weights, pieces, moves, sums;
    ps_buffer made;  /* as ps_device_sets_write leaves them; {0} with the kernel */
    ps_buffer table; /* of the integrand, where it has_table */
    bool has_table;
    values_piece *host_pieces;
    double *host_moves, *host_sums;
    int *host_exponents;  /* of the weights of each set */
    size_t *sizes_of_one; /* points of sets whose weights there are all 1, as they lie there */
    size_t num_of_one;    /* such sets; 0 where other weights are there */
};

/* ---- which kernel ---------------------------------------------------------------------------- */

static pspec_status create_kernels(ps_device_trials *self, ps_error *error) {
    const ps_integrand_place place = self->integrand->place;
    const ps_precision precision = self->options.precision;
    ps_defines defines = ps_defines_of(ps_real_bytes(precision), self->lanes);
    const bool on_sphere = place.where != PS_SAMPLES_TORUS;
    if (self->options.makes_points) {
        ps_defines of_points = ps_defines_of(ps_real_bytes(precision), 1);
        ps_defines_add(&of_points, "-DDIMENSION=%u -DON_SPHERE=%d", place.dimension, on_sphere);
        PS_TRY(ps_kernel_get(self->device, &self->points_kernel, "samplers/coordinates.cl",
                             "sampler_coordinates", of_points.text, error));
    }
    ps_defines_add(&defines, "-DINTEGRAND=%s -DDIMENSION=%u -DROTATE=%d -DFOLD=%d",
                   ps_integrand_kernel(self->integrand, precision == PS_DOUBLE), place.dimension,
                   on_sphere, place.where == PS_SAMPLES_HEMISPHERE);
    return ps_kernel_get(self->device, &self->kernel, "integrands/values.cl", "integrand_values",
                         defines.text, error);
}

/* ---- create ---------------------------------------------------------------------------------- */

static bool find_sizes(ps_device_trials *self, size_t *num_sums) {
    const ps_trials_options *options = &self->options;
    const size_t pieces = ps_divide_up(options->most_points, VALUES_PIECE);
    size_t trials = 0;
    return options->most_points <= SIZE_MAX - VALUES_PIECE &&
           ps_size_multiply(options->batch, ps_round_up(options->most_points, self->lanes),
                            &self->axis_numbers) &&
           ps_size_multiply(options->batch, pieces, &self->most_pieces) &&
           ps_size_multiply(options->batch, options->num_trials, &trials) &&
           ps_size_multiply(trials, ps_trials_move_numbers(self->integrand), &self->most_moves) &&
           ps_size_multiply(self->most_pieces, options->num_trials, num_sums) &&
           ps_size_multiply(*num_sums, 2 * sizeof(double), &trials) &&
           ps_size_multiply(self->axis_numbers, PS_MAX_DIMENSION * sizeof(double), &trials);
}

/* The table of the integrand, which stays there. */
static pspec_status create_table(ps_device_trials *self, ps_error *error) {
    const ps_integrand *const integrand = self->integrand;
    self->has_table = integrand->num_table > 0 || integrand->num_bytes > 0;
    if (integrand->num_bytes > 0) {
        return ps_buffer_share(self->device, &self->table, integrand->bytes, integrand->num_bytes,
                               "an integrand", error);
    }
    return self->has_table
               ? ps_reals_upload(self->device, &self->table, self->options.precision,
                                 integrand->table, integrand->num_table, "an integrand", error)
               : PSPEC_OK;
}

static pspec_status create_buffers(ps_device_trials *self, ps_error *error) {
    const size_t real_bytes = ps_real_bytes(self->options.precision);
    const size_t point_bytes = self->integrand->place.dimension * real_bytes;
    size_t num_sums = 0;
    if (!find_sizes(self, &num_sums)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "%zu trials of %zu sets of %zu points are too many",
                       self->options.num_trials, self->options.batch, self->options.most_points);
    }
    PS_TRY(PS_NEW(&self->host_pieces, self->most_pieces, "pieces of sets", error));
    PS_TRY(PS_NEW(&self->host_moves, self->most_moves, "moves of trials", error));
    PS_TRY(PS_NEW(&self->host_exponents, self->options.batch, "sizes of weights", error));
    PS_TRY(PS_NEW(&self->sizes_of_one, self->options.batch, "sizes of sets", error));
    PS_TRY(PS_NEW(&self->host_sums, 2 * num_sums, "sums of trials", error));
    if (self->options.makes_points) {
        const size_t num = self->axis_numbers * self->integrand->place.dimension;
        PS_TRY(ps_buffer_create(self->device, &self->made, num * sizeof(uint64_t),
                                "points that the device makes", error));
    }
    const ps_wanted_buffer wanted[] = {
        {&self->points, self->axis_numbers * point_bytes, "points"},
        {&self->weights, self->axis_numbers * real_bytes, "weights"},
        {&self->pieces, self->most_pieces * sizeof *self->host_pieces, "pieces of sets"},
        {&self->moves, self->most_moves * real_bytes, "moves of trials"},
        {&self->sums, 2 * num_sums * real_bytes, "sums of trials"}};
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

double ps_device_trials_bytes(const ps_integrand *integrand, const ps_trials_options *options,
                              const ps_device *device) {
    const bool copies = !ps_device_get_limits(device)->has_unified_memory;
    const double real_bytes = (double)ps_real_bytes(options->precision);
    const double batch = (double)options->batch;
    const double points = batch * (double)options->most_points;
    const double pieces = batch * (double)ps_divide_up(options->most_points, VALUES_PIECE);
    const double trials = (double)options->num_trials;
    const double moves = batch * trials * (double)ps_trials_move_numbers(integrand);
    const double pair_bytes = real_bytes + (double)sizeof(double);
    return (double)integrand->num_table * real_bytes + (copies ? (double)integrand->num_bytes : 0) +
           points * (integrand->place.dimension + 1) * real_bytes +
           (options->makes_points ? points * integrand->place.dimension * sizeof(uint64_t) : 0) +
           2 * pieces * (double)sizeof(values_piece) + (moves + 2 * pieces * trials) * pair_bytes;
}

pspec_status ps_device_trials_create(ps_device_trials **out, const ps_integrand *integrand,
                                     const ps_trials_options *options, ps_device *device,
                                     ps_error *error) {
    ps_device_trials *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "trials", error));
    self->integrand = integrand;
    self->options = *options;
    self->device = device;
    self->lanes = ps_engine_lanes(ps_device_get_limits(device), options->precision);
    pspec_status status = create_kernels(self, error);
    if (status == PSPEC_OK) {
        status = create_buffers(self, error);
    }
    if (status == PSPEC_OK) {
        status = create_table(self, error);
    }
    if (status != PSPEC_OK) {
        ps_device_trials_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_device_trials_destroy(ps_device_trials *trials) {
    if (trials == NULL) {
        return;
    }
    PS_BUFFERS_RELEASE(&trials->points, &trials->weights, &trials->pieces, &trials->moves,
                       &trials->sums, &trials->made, &trials->table);
    free(trials->host_pieces);
    free(trials->host_moves);
    free(trials->host_sums);
    free(trials->host_exponents);
    free(trials->sizes_of_one);
    free(trials);
}

/* ---- what goes to the device ----------------------------------------------------------------- */

/* How numbers go to the device; apart 0: one for all. */
typedef struct putting {
    const double *from;
    size_t apart, num;
    double factor; /* a power of two */
} putting;

static void put_singles(float *to, putting numbers) {
    for (size_t j = 0; j < numbers.num; j++) {
        to[j] = (float)(numbers.from[j * numbers.apart] * numbers.factor);
    }
}

static void put_doubles(double *to, putting numbers) {
    for (size_t j = 0; j < numbers.num; j++) {
        to[j] = numbers.from[j * numbers.apart] * numbers.factor;
    }
}

/* From place `at` on, then 0 to the end of a vector. */
static void put(const ps_device_trials *self, void *to, size_t at, putting numbers) {
    const size_t real_bytes = ps_real_bytes(self->options.precision);
    const size_t rest = ps_round_up(numbers.num, self->lanes) - numbers.num;
    if (self->options.precision == PS_SINGLE) {
        put_singles((float *)to + at, numbers);
    } else {
        put_doubles((double *)to + at, numbers);
    }
    memset((char *)to + (at + numbers.num) * real_bytes, 0, rest * real_bytes);
}

static void put_points(ps_device_trials *self, void *to, const ps_batch *batch) {
    const unsigned dimension = self->integrand->place.dimension;
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const size_t num = batch->patterns[r].num_points;
        for (unsigned i = 0; i < dimension; i++) {
            put(self, to, i * self->axis_numbers + at,
                (putting){batch->patterns[r].points + i, dimension, num, 1});
        }
        at += ps_round_up(num, self->lanes);
    }
}

/* Of the largest weight, so that weights of any size are near 1 in single precision. */
static int exponent_of(const pspec_pattern *pattern) {
    const int most = 1000; /* 2^-most is a number */
    double largest = 0;
    int exponent = 0;
    for (size_t j = 0; pattern->weights != NULL && j < pattern->num_points; j++) {
        largest = fmax(largest, fabs(pattern->weights[j]));
    }
    frexp(largest, &exponent);
    exponent = exponent > most ? most : exponent;
    return pattern->weights == NULL ? 0 : exponent < -most ? -most : exponent;
}

static void put_weights(ps_device_trials *self, void *to, const ps_batch *batch) {
    static const double one = 1;
    size_t at = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const double *const weights = batch->patterns[r].weights;
        const size_t num = batch->patterns[r].num_points;
        self->host_exponents[r] = exponent_of(&batch->patterns[r]);
        put(self, to, at,
            (putting){weights != NULL ? weights : &one, weights != NULL, num,
                      ldexp(1, -self->host_exponents[r])});
        at += ps_round_up(num, self->lanes);
    }
}

/* Are weights of 1 there already, from sets of the same sizes? */
static bool has_weights(const ps_device_trials *self, const ps_batch *batch) {
    for (size_t r = 0; r < batch->num_patterns; r++) {
        if (r >= self->num_of_one || batch->patterns[r].weights != NULL ||
            batch->patterns[r].num_points != self->sizes_of_one[r]) {
            return false;
        }
    }
    return true;
}

static void note_weights(ps_device_trials *self, const ps_batch *batch) {
    self->num_of_one = batch->num_patterns;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        self->sizes_of_one[r] = batch->patterns[r].num_points;
        self->num_of_one = batch->patterns[r].weights != NULL ? 0 : self->num_of_one;
    }
}

/* Fills a buffer in its own memory. */
static pspec_status fill(ps_device_trials *self, const ps_buffer *buffer,
                         void (*put_all)(ps_device_trials *, void *, const ps_batch *),
                         const ps_batch *batch, ps_error *error) {
    ps_mapping mapping;
    PS_TRY(ps_mapping_begin(self->device, &mapping, buffer, error));
    const pspec_status status = ps_mapping_wait(&mapping, error);
    if (status != PSPEC_OK) {
        ps_mapping_abandon(self->device, &mapping);
        return status;
    }
    put_all(self, mapping.data, batch);
    return ps_mapping_end(self->device, &mapping, buffer->bytes, error);
}

/* The device makes the points itself. */
static pspec_status make_points(ps_device_trials *self, const ps_batch *batch, ps_error *error) {
    const size_t num_points = batch->patterns[0].num_points;
    const sampler_range range = {.realization = batch->realization,
                                 .num_realizations = batch->num_patterns,
                                 .step = 1,
                                 .count = num_points};
    const sampler_sets sizes = {self->axis_numbers, batch->num_patterns, num_points,
                                ps_round_up(num_points, self->lanes)};
    const size_t num = (size_t)(sizes.num_sets * sizes.padded);
    const double bytes = (double)self->made.bytes;
    const ps_range items = ps_range_light(self->device, num, 1, 1, 0, bytes);
    PS_TRY(ps_device_sets_write(batch->sets, &range, &self->made, error));
    return PS_LAUNCH(self->device, self->points_kernel, &items, error, PS_STRUCT(sizes),
                     PS_BUFFER(self->made), PS_BUFFER(self->points));
}

/* Returns how many pieces the sets make. */
static size_t make_pieces(ps_device_trials *self, const ps_batch *batch) {
    const size_t whole = VALUES_PIECE / self->lanes;
    size_t num = 0;
    size_t first = 0;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        size_t rest = ps_divide_up(batch->patterns[r].num_points, self->lanes);
        while (rest > 0) {
            const size_t own = rest < whole ? rest : whole;
            self->host_pieces[num++] = (values_piece){first, (uint32_t)own, (uint32_t)r};
            first += own;
            rest -= own;
        }
    }
    return num;
}

static pspec_status write_moves(ps_device_trials *self, size_t num_trials, const double *moves,
                                ps_error *error) {
    const size_t numbers = ps_trials_move_numbers(self->integrand);
    if (moves == NULL) {
        memset(self->host_moves, 0, num_trials * numbers * sizeof *self->host_moves);
        for (size_t i = 0; numbers == AXES * AXES && i < num_trials * AXES; i++) {
            self->host_moves[i / AXES * numbers + i % AXES * (AXES + 1)] = 1;
        }
        moves = self->host_moves;
    }
    return ps_reals_write(self->device, &self->moves, self->options.precision, moves,
                          num_trials * numbers, error);
}

/* ---- run ------------------------------------------------------------------------------------- */

/* Of a value, about that of an exponential and a sum in a pair: what it counts as in the profile,
 * and how work-groups are made. */
#define VALUE_FLOPS 40.0

#define LAUNCH_ARGUMENTS(self, sizes, numbers, table)                                              \
    PS_STRUCT(sizes), PS_STRUCT(numbers), PS_BUFFER((self)->points), PS_BUFFER((self)->weights),   \
        PS_BUFFER((self)->pieces), PS_BUFFER((self)->moves), PS_BUFFER(*table),                    \
        PS_BUFFER((self)->sums)

static pspec_status launch(ps_device_trials *self, size_t num_pieces, ps_error *error) {
    const size_t num_trials = self->options.num_trials;
    const double values = (double)num_trials * (double)num_pieces * VALUES_PIECE;
    const ps_range range = ps_range_heavy(self->device, num_trials, num_pieces, 1,
                                          VALUE_FLOPS * values, values * sizeof(float));
    const values_sizes sizes = {self->axis_numbers, num_trials};
    /* any buffer does where nothing of it is read */
    const ps_buffer *const table = self->has_table ? &self->table : &self->weights;
    values_singles singles;
    values_doubles doubles;
    for (size_t i = 0; i < PS_INTEGRAND_NUMBERS; i++) {
        doubles.numbers[i] = self->integrand->numbers[i];
        singles.numbers[i] = (float)doubles.numbers[i];
    }
    return self->options.precision == PS_SINGLE
               ? PS_LAUNCH(self->device, self->kernel, &range, error,
                           LAUNCH_ARGUMENTS(self, sizes, singles, table))
               : PS_LAUNCH(self->device, self->kernel, &range, error,
                           LAUNCH_ARGUMENTS(self, sizes, doubles, table));
}

/* Adds the pieces of each set in their order. */
static void add_pieces(const ps_device_trials *self, size_t num_pieces, double *sums) {
    const size_t num_trials = self->options.num_trials;
    for (size_t trial = 0; trial < num_trials; trial++) {
        ps_neumaier total = {0, 0};
        for (size_t piece = 0; piece < num_pieces; piece++) {
            const double *const pair = self->host_sums + 2 * (piece * num_trials + trial);
            const size_t set = self->host_pieces[piece].set;
            ps_neumaier_add(&total, pair[0]);
            ps_neumaier_add(&total, pair[1]);
            if (piece + 1 == num_pieces || self->host_pieces[piece + 1].set != set) {
                sums[set * num_trials + trial] =
                    ldexp(ps_neumaier_value(&total), self->host_exponents[set]);
                total = (ps_neumaier){0, 0};
            }
        }
    }
}

pspec_status ps_device_trials_sums(ps_device_trials *trials, const ps_batch *batch,
                                   const double *moves, double *sums, ps_error *error) {
    ps_device_trials *const self = trials;
    const size_t num_pieces = make_pieces(self, batch);
    PS_TRY(ps_buffer_write(self->device, &self->pieces, 0, self->host_pieces,
                           num_pieces * sizeof *self->host_pieces, error));
    PS_TRY(write_moves(self, batch->num_patterns * self->options.num_trials, moves, error));
    PS_TRY(batch->sets != NULL ? make_points(self, batch, error)
                               : fill(self, &self->points, put_points, batch, error));
    if (!has_weights(self, batch)) {
        self->num_of_one = 0;
        PS_TRY(fill(self, &self->weights, put_weights, batch, error));
        note_weights(self, batch);
    }
    PS_TRY(launch(self, num_pieces, error));
    PS_TRY(ps_reals_read(self->device, &self->sums, self->options.precision, self->host_sums,
                         2 * num_pieces * self->options.num_trials, error));
    add_pieces(self, num_pieces, sums);
    return PSPEC_OK;
}
