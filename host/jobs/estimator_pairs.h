/* What pair sums have besides Q(l): C_l^2 = 2 sum_{m > 0} |c_lm|^2 of every realization, on
 * average. */
#ifndef PS_JOBS_ESTIMATOR_PAIRS_H
#define PS_JOBS_ESTIMATOR_PAIRS_H

#include "engines/engine.h"
#include "spectra/accumulate/accumulate.h"
#include "spectra/sums.h"

/* Told of the realizations, one after the other in their order and before ps_estimator_add returns,
 * which waits for their rows then: Z(l) = sum_j w_j P_l(z_j) and C_l^2
 * for l = 0 .. L, borrowed until it returns. */
typedef struct ps_pair_observer {
    void (*tell)(void *payload, const double *zonal, const double *c2); /* NULL: nobody asks */
    void *payload;
} ps_pair_observer;

/* Sums over realizations. */
typedef struct ps_pair_sums {
    const ps_frequencies *frequencies;
    size_t batch;
    ps_pair_observer observer;
    double *scales; /* [batch], of the batch that was begun */
    double *zonal;  /* [batch][max_degree + 1] */
    double *c2;     /* [max_degree + 1] of one realization, and behind it its Z(l) */
    void *scratch;  /* of the threads */
    ps_sums *sums;  /* [frequencies->num] */
    uint64_t num_realizations;
} ps_pair_sums;

/* Zeroed memory must be given; free it also after a failure. */
pspec_status ps_pair_sums_create(ps_pair_sums *out, const ps_frequencies *frequencies, size_t batch,
                                 ps_pair_observer observer, ps_error *error) PS_MUST_CHECK;
void ps_pair_sums_free(ps_pair_sums *sums);
void ps_pair_sums_reset(ps_pair_sums *sums);
/* What a batch is to have beside its rows: all that is looked at of its points. */
void ps_pair_sums_begin(ps_pair_sums *sums, const ps_batch *batch);
/* Adds the realizations of the batch that was begun last, whose rows are on the host. */
void ps_pair_sums_add(ps_pair_sums *sums, const ps_rows *rows, const uint32_t *slots);
/* means[frequencies->num] */
void ps_pair_sums_finish(const ps_pair_sums *sums, ps_mean *means);

#endif
