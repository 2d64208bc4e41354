/* Estimates of integrals by moved realizations, and their variance about the known integrals. */
#ifndef PS_JOBS_VARIANCE_MEASUREMENT_H
#define PS_JOBS_VARIANCE_MEASUREMENT_H

#include "integrands/integrand.h"
#include "jobs/source.h"
#include "spectra/accumulate.h"

typedef struct ps_measurement_plan {
    const ps_sampler_request *sampler; /* not homogenized */
    const ps_integrand *const *integrands;
    size_t num_integrands;
    uint64_t first, num_sets; /* realizations; those of a deterministic sampler are one set */
    uint64_t num_shifts;
    bool is_moved;
    ps_sets_options sets; /* where they are kept */
    ps_device *device;    /* NULL: values are made on the host */
    const ps_watch *watch;
} ps_measurement_plan;

/* variances[num_integrands]: mean over sets, and its standard error over them (nan of one set), of
 * the mean over the shifts of a set of (I - int F)^2. */
pspec_status ps_measurement_run(const ps_measurement_plan *plan, ps_mean *variances,
                                ps_error *error) PS_MUST_CHECK;

#endif
