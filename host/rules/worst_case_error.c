#include "rules/worst_case_error.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "math/neumaier.h"
#include "math/sobolev.h"
#include "rules/distance_split.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* ---- weights ------------------------------------------------------------------------------- */

static double sum_weights(const ps_rule *rule, double (*of)(double)) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < rule->num_points; j++) {
        ps_neumaier_add(&sum, of(rule->weights[j]));
    }
    return ps_neumaier_value(&sum);
}

static double itself(double weight) {
    return weight;
}

static double square(double weight) {
    return weight * weight;
}

ps_weight_sums ps_rule_weight_sums(const ps_rule *rule) {
    if (rule->weights == NULL) {
        return (ps_weight_sums){1, 1, 1 / (double)rule->num_points};
    }
    return (ps_weight_sums){sum_weights(rule, itself), sum_weights(rule, fabs),
                            sum_weights(rule, square)};
}

/* ---- pairs --------------------------------------------------------------------------------- */

/* Points whose pairs with themselves and with all later ones are one thing to do. */
enum { BLOCK = PS_SOBOLEV_CHUNK };

typedef struct pair_work {
    const ps_rule *rule;
    double smoothness;
    ps_neumaier *sums; /* [num_blocks] */
    size_t begin, end; /* of the strip of later blocks */
} pair_work;

static double weight_of(const ps_rule *rule, size_t j) {
    return rule->weights != NULL ? rule->weights[j] : 1;
}

static size_t count_blocks(const ps_rule *rule) {
    return (rule->num_points + BLOCK - 1) / BLOCK;
}

static size_t block_size(const ps_rule *rule, size_t block) {
    const size_t left = rule->num_points - block * BLOCK;
    return left < BLOCK ? left : BLOCK;
}

/* All pairs of a point of one block and one of the other. */
static double sum_two_blocks(const pair_work *work, size_t rows, size_t columns) {
    const ps_rule *const rule = work->rule;
    const size_t first = columns * BLOCK;
    ps_sobolev_chunk chunk;
    ps_neumaier sum = {0, 0};
    ps_sobolev_chunk_fill(&chunk, block_size(rule, columns), rule->points + 3 * first,
                          rule->weights != NULL ? rule->weights + first : NULL);
    for (size_t i = rows * BLOCK; i < rows * BLOCK + block_size(rule, rows); i++) {
        const double row = ps_sobolev_chunk_sum(work->smoothness, rule->points + 3 * i, &chunk);
        ps_neumaier_add(&sum, weight_of(rule, i) * row);
    }
    return ps_neumaier_value(&sum);
}

/* Blocks with which the sums of all blocks grow before anyone is told: with one of them a block has
 * some hundredths of a second to do. */
enum { BLOCKS_AT_A_TIME = (1 << 22) / BLOCK / BLOCK };

/* Pairs of the block with itself, and twice those with all later ones: as far as the blocks before
 * `end`. */
static void grow_sum(void *payload, size_t block) {
    const pair_work *const work = payload;
    ps_neumaier *const sum = &work->sums[block];
    for (size_t later = block > work->begin ? block : work->begin; later < work->end; later++) {
        const double of_two = sum_two_blocks(work, block, later);
        if (later == block) {
            *sum = (ps_neumaier){of_two, 0};
        } else {
            ps_neumaier_add(sum, 2 * of_two);
        }
    }
}

/* Strip after strip of later blocks, so that no thread is away for long; the order of a sum's terms
 * is that of the blocks in any case. */
static pspec_status sum_pairs(pair_work *work, ps_pieces *pieces, ps_error *error) {
    const size_t num_blocks = count_blocks(work->rule);
    for (size_t begin = 0; begin < num_blocks; begin += BLOCKS_AT_A_TIME) {
        const size_t left = num_blocks - begin;
        work->begin = begin;
        work->end = begin + (left < BLOCKS_AT_A_TIME ? left : BLOCKS_AT_A_TIME);
        PS_TRY(ps_pieces_do(pieces, work->end, grow_sum, work, error));
    }
    return PSPEC_OK;
}

/* What is counted: blocks of points, once for every strip that they meet. */
static uint64_t count_pieces(size_t num_blocks) {
    uint64_t total = 0;
    for (size_t begin = 0; begin < num_blocks; begin += BLOCKS_AT_A_TIME) {
        const size_t left = num_blocks - begin;
        total += begin + (left < BLOCKS_AT_A_TIME ? left : BLOCKS_AT_A_TIME);
    }
    return total;
}

/* Over all pairs. */
static pspec_status sum_whole(const ps_rule *rule, double smoothness, const ps_watch *watch,
                              double *sum, ps_error *error) {
    pair_work work = {.rule = rule, .smoothness = smoothness};
    const size_t num_blocks = count_blocks(rule);
    PS_TRY(PS_NEW(&work.sums, num_blocks, "sums of pairs", error));
    ps_pieces pieces = {.workers = rule->num_points * (rule->num_points / 2) >= PS_WORKERS_LEAST
                                       ? ps_workers_create(PS_WORKERS_MOST)
                                       : NULL,
                        .each = 1,
                        .watch = watch,
                        .phase = "blocks of pairs of points",
                        .total = count_pieces(num_blocks)};
    const pspec_status status = sum_pairs(&work, &pieces, error);
    ps_neumaier total = {0, 0};
    for (size_t block = 0; block < num_blocks; block++) {
        ps_neumaier_add(&total, ps_neumaier_value(&work.sums[block]));
    }
    *sum = ps_neumaier_value(&total);
    ps_workers_destroy(pieces.workers);
    free(work.sums);
    return status;
}

/* Over near and far pairs, where that pays. */
static pspec_status sum_split(const ps_rule *rule, double smoothness, const ps_watch *watch,
                              bool *pays, double *sum, ps_error *error) {
    ps_distance_split *split = NULL;
    pspec_status status = ps_distance_split_create(&split, rule, pays, error);
    if (status == PSPEC_OK && *pays) {
        status = ps_distance_split_sum(split, smoothness, watch, sum, error);
    }
    ps_distance_split_destroy(split);
    return status;
}

pspec_status ps_rule_distance(const ps_rule *rule, double smoothness, const ps_watch *watch,
                              double *sum, ps_error *error) {
    const double num = (double)rule->num_points;
    bool is_split = false;
    if (rule->num_points > PS_DISTANCE_MOST_WHOLE) {
        PS_TRY(sum_split(rule, smoothness, watch, &is_split, sum, error));
    }
    PS_TRY(is_split ? PSPEC_OK : sum_whole(rule, smoothness, watch, sum, error));
    *sum /= rule->weights != NULL ? 1 : num * num;
    return PSPEC_OK;
}

/* ---- kernel form --------------------------------------------------------------------------- */

/* E^2 from a sum of distances that something else made, a device, say. */
static ps_kernel_error error_from_sums(const ps_representer *representer,
                                       const ps_weight_sums *weights, double distance,
                                       double kappa) {
    enum {
        ROUNDINGS = 8
    }; /* measured: 2.4e-15 of c (sum|w|)^2 against tests/reference, with room */
    const double c = representer->constant;
    const double gap = weights->sum - 1;
    const double d = c * weights->sum - kappa; /* sum w D */
    ps_neumaier sum = {0, 0};
    ps_neumaier_add(&sum, c * gap * gap);
    ps_neumaier_add(&sum, -distance);
    ps_neumaier_add(&sum, 2 * d);
    ps_neumaier_add(&sum, -representer->d_0);
    return (ps_kernel_error){
        .squared = ps_neumaier_value(&sum),
        .bound = ROUNDINGS * DBL_EPSILON * c * (1 + weights->size * weights->size) +
                 2 * weights->size * representer->kappa_estimate + representer->kappa_0_error,
        .distance = distance,
        .kappa = kappa};
}

/* sum w kappa. */
static double sum_kappa(const ps_rule *rule, const double *kappa) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < rule->num_points; j++) {
        ps_neumaier_add(&sum, weight_of(rule, j) * kappa[j]);
    }
    return ps_neumaier_value(&sum) / (rule->weights != NULL ? 1 : (double)rule->num_points);
}

pspec_status ps_kernel_error_of(const ps_representer *representer, const ps_rule *rule,
                                const double *kappa, const double *distance, const ps_watch *watch,
                                ps_kernel_error *out, ps_error *error) {
    double own_distance = 0;
    double *own = NULL;
    PS_TRY(distance != NULL
               ? PSPEC_OK
               : ps_rule_distance(rule, representer->smoothness, watch, &own_distance, error));
    if (kappa == NULL) {
        PS_TRY(PS_NEW(&own, rule->num_points, "kappa", error));
        ps_representer_kappa(representer, rule->num_points, rule->points, own);
        kappa = own;
    }
    const ps_weight_sums weights = ps_rule_weight_sums(rule);
    *out = error_from_sums(representer, &weights, distance != NULL ? *distance : own_distance,
                           sum_kappa(rule, kappa));
    free(own);
    return PSPEC_OK;
}

/* ---- spectral form ------------------------------------------------------------------------- */

pspec_status ps_spectral_error_of(const ps_representer *representer, size_t max_degree,
                                  const double *c_l0, const double *c2,
                                  const ps_weight_sums *weights, ps_degree_error *degrees,
                                  ps_spectral_error *out, ps_error *error) {
    PS_TRY(ps_representer_check(representer, max_degree, error));
    ps_neumaier zonal = {0, 0};
    ps_neumaier anisotropic = {0, 0};
    for (size_t l = max_degree + 1; l-- > 0;) { /* small ones first */
        const double d = representer->b[l] - c_l0[l];
        const double c2_of_l = l > 0 ? c2[l] : 0;
        const double a = representer->a[l];
        ps_neumaier_add(&zonal, a * d * d);
        ps_neumaier_add(&anisotropic, a * c2_of_l);
        if (degrees != NULL) {
            degrees[l] =
                (ps_degree_error){representer->b[l], d * d, c2_of_l, a, a * (d * d + c2_of_l)};
        }
    }
    double half_width = 0;
    const double rest = ps_representer_rest(representer, max_degree, &half_width);
    const double tau =
        ps_sobolev_tail(representer->smoothness, max_degree, representer->a[max_degree + 1]);
    const double root = weights->size * sqrt(tau) + sqrt(rest + half_width);
    const double gap = 1 - weights->sum;
    *out =
        (ps_spectral_error){.zonal = ps_neumaier_value(&zonal),
                            .anisotropic = ps_neumaier_value(&anisotropic),
                            .tail_model = weights->square * fmax(tau - rest, 0) + gap * gap * rest,
                            .tail_bound = root * root};
    return PSPEC_OK;
}
