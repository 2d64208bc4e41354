#include "plan/memory_model.h"

#include "accumulate/blocks.h"
#include "base/round.h"
#include "device/reals.h"

#include <math.h>

/* Realizations side by side in sums of pieces of bins: whole vectors, shorter ones where most lanes
 * would be empty (analysis/accumulate_device). */
static double padded_rows(const ps_device_limits *limits, ps_precision precision, size_t batch) {
    unsigned lanes = ps_engine_lanes(limits, precision);
    while (lanes > 1 && lanes >= 4 * batch) {
        lanes /= 2;
    }
    return (double)ps_round_up(batch, lanes);
}

/* Slots whose powers are added up in one go: PS_ACCUMULATE_BLOCK. */
static const double block = 512;

/* Adds what weighted sums of rows on the device bring: their weights by slots, on the host, too,
 * while they are brought there, and sums of blocks of slots in pairs, read back in turns. */
static void add_weighted(ps_memory *sum, const ps_work *work, const ps_problem *problem,
                         double rows, double real_bytes) {
    const double num = (double)problem->num_weighted;
    const double stride = work->row_bytes / real_bytes;
    const double numbers = num * rows * ceil(stride / block) * 2;
    sum->device += num * work->row_bytes + numbers * real_bytes;
    sum->host += (num > 0 ? stride : 0) * (double)sizeof(double) + 2 * numbers * real_bytes;
}

/* Numbers that are kept of every sum over realizations (spectra/sums.h): an open block, and
 * the levels of whole ones; where nobody knows how many there are, as of one batch. */
static double running_states(const ps_problem *problem, size_t batch) {
    const uint64_t known = problem->num_realizations;
    return 4 * (1.0 + sum_levels(known > 0 ? known : batch));
}

/* Those that GPUs have besides, of each block that a batch is part of
 * (spectra/accumulate/accumulate_states.c). */
static double strip_states(const ps_device_limits *limits, size_t batch) {
    return limits->has_dedicated_local_memory ? 4.0 * most_strips(batch) : 0;
}

/* Adds what rows of powers on the device bring: their sums over realizations, also read
 * back, and strips; members of bins, and the pieces of bins in the blocks of a row: 3 numbers for
 * each, and its sum in pairs, two of which are on their way to the host. In one dimension all
 * frequencies of a block are of one ring, which makes pieces of PS_ACCUMULATE_PIECE; else rings
 * cross a block in about 36, some of them in two pieces. */
static void add_accumulator(ps_memory *sum, const ps_work *work, const ps_problem *problem,
                            double rows, double states, double strips, double real_bytes) {
    const double pieces_of_block = problem->frequencies->dimension == 1 ? 32 : 44;
    const double num = (double)problem->frequencies->num;
    const double blocks = ceil(work->row_bytes / real_bytes / block);
    const double pieces = fmin(num, blocks * pieces_of_block);
    sum->device += (states + strips) * work->row_bytes + num * (double)sizeof(uint16_t) +
                   pieces * (2 * rows * real_bytes + 3 * (double)sizeof(uint32_t));
    sum->host += states * work->row_bytes + 2 * pieces * 2 * rows * real_bytes;
}

double ps_memory_of_set(const ps_problem *problem, const ps_work *work) {
    const unsigned columns = problem->frequencies->dimension + (problem->has_weights ? 1 : 0);
    const uint64_t points = work->takes_blocks && problem->block_points > 0 ? problem->block_points
                                                                            : problem->num_points;
    return (double)points * columns * (double)sizeof(double);
}

/* The result, where all are kept that of all realizations and of one, boxes that have both k and
 * -k, and for hemispherical harmonics the stretched points. */
static double coefficient_bytes(const ps_problem *problem) {
    const double stretched = problem->harmonics == PS_HEMISPHERICAL_HARMONICS
                                 ? (double)problem->num_points * PS_SPHERE_DIMENSION
                                 : 0;
    const double num_sets = problem->num_realizations > 0 ? (double)problem->num_realizations : 1;
    const double sets = 1 + (problem->keeps_coefficients ? num_sets : 0) +
                        (problem->fills_boxes ? 2 * num_sets : 0);
    const bool on_sphere = problem->frequencies->kind == PS_FREQUENCIES_DEGREES;
    const double num = on_sphere ? (double)ps_num_coefficients(problem->frequencies->max_frequency)
                                 : 2 * (double)problem->frequencies->num;
    return problem->harmonics == PS_NO_HARMONICS
               ? 0
               : (sets * num + stretched) * (double)sizeof(double);
}

ps_memory ps_memory_count(const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, const ps_work *work,
                          const ps_device_limits *limits, size_t batch) {
    const unsigned dimension = problem->frequencies->dimension;
    const double num = (double)problem->frequencies->num;
    const bool is_unified = limits == NULL || limits->has_unified_memory;
    const double coordinates = work->coordinate_bytes;
    const double sums_bytes = 2 * 4 * sizeof(double); /* their pairs, and the array of these */
    /* of every frequency twice its vector and its slot, its place in a bin, mean and standard
     * error; and the weights of weighted sums */
    ps_memory sum = {.device = work->fixed_bytes - work->host_bytes +
                               (work->bytes_per_realization + work->point_bytes + coordinates) *
                                   (double)batch,
                     .host = work->host_bytes + coefficient_bytes(problem) +
                             (is_unified ? 0 : work->twin_bytes + (double)PS_STAGED_BYTES) +
                             (ps_memory_of_set(problem, work) + work->point_bytes +
                              (is_unified ? -coordinates : coordinates)) *
                                 (double)batch +
                             num * (2 * dimension * (double)sizeof(int32_t) +
                                    3 * (double)sizeof(uint32_t) + 2 * (double)sizeof(double)) +
                             num * (double)problem->num_weighted * (double)sizeof(double) +
                             (problem->keeps_sums ? num * sums_bytes : 0) + problem->making_bytes};
    const double states = running_states(problem, batch);
    if (limits == NULL || engine->rows_on_host) {
        sum.host += num * states * (double)sizeof(double); /* the sums of the accumulator */
    }
    if (limits == NULL) {
        sum.host += sum.device;
        sum.device = 0;
    }
    if (limits == NULL || engine->rows_on_host) {
        return sum;
    }
    const double rows = padded_rows(limits, precision, batch);
    const double real_bytes = (double)ps_real_bytes(precision);
    add_accumulator(&sum, work, problem, rows, states, strip_states(limits, batch), real_bytes);
    add_weighted(&sum, work, problem, rows, real_bytes);
    return sum;
}
