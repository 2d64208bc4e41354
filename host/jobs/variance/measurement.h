/* Estimates of integrals by moved realizations, and their variance about the known integrals. */
#ifndef PS_JOBS_VARIANCE_MEASUREMENT_H
#define PS_JOBS_VARIANCE_MEASUREMENT_H

#include "integrands/integrand.h"
#include "jobs/source.h"
#include "spectra/accumulate/accumulate.h"

typedef struct ps_measurement_plan {
    ps_source *source; /* at the first set that is measured; not of sets that the device makes */
    /* Realizations of the sampler that the device makes for trials; NULL: the source has them */
    const ps_sampler_request *made;
    bool is_one_set; /* it has one, and num_sets are moves of that */
    size_t most_points;
    const double *weights; /* [most_points] of every set; NULL: theirs */
    const ps_integrand *const *integrands;
    size_t num_integrands;
    uint64_t first, num_sets; /* numbers of the sets, for their moves */
    uint64_t num_shifts;
    uint64_t seed; /* of the moves */
    bool is_moved;
    uint64_t memory_limit; /* bytes that somebody typed; 0: none */
    double making_bytes;   /* while the source makes a set */
    ps_device *device;     /* NULL: values are made on the host */
    const ps_watch *watch;
    const ps_checkpoint_spec *checkpoint; /* NULL: none */
} ps_measurement_plan;

/* May the device of the plan make sets of the sampler? For trials that are all there. */
bool ps_measurement_may_make(const ps_measurement_plan *plan, const ps_sampler_request *sampler);

/* Bytes that the measurement takes, in batches that the limit and what is free leave, where source
 * and weights are not looked at. PSPEC_ERROR_MEMORY where single sets are too much. */
pspec_status ps_measurement_bytes(const ps_measurement_plan *plan, double *bytes,
                                  ps_error *error) PS_MUST_CHECK;

/* *num_sets: those of the plan, or of a range of them, which may have none, and then leaves
 * variances as they are. variances[num_integrands]: mean over sets, and its standard error over
 * them (nan of one set), of the mean over the shifts of a set of (I - int F)^2. blocks
 * [num_integrands], {0} before, have the same by blocks of sets. */
pspec_status ps_measurement_run(const ps_measurement_plan *plan, uint64_t *num_sets,
                                ps_mean *variances, ps_block_sums *blocks,
                                ps_error *error) PS_MUST_CHECK;

#endif
