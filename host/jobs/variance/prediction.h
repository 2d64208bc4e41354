/* The variance that a spectrum and an integrand predict: (V1) on the torus, (S1) on the sphere and
 * (H1) on the hemisphere, as a weighted sum of powers up to the cut-off, and (V3) for the rest.
 */
#ifndef PS_JOBS_VARIANCE_PREDICTION_H
#define PS_JOBS_VARIANCE_PREDICTION_H

#include "frequencies/frequencies.h"
#include "integrands/integrand.h"
#include "spectra/accumulate/accumulate.h"
#include "spectra/spectrum.h"
#include "base/watch.h"
#include "device/device.h"

/* The powers of an integrand that is weighted points: pixels. */

/* Where the engine runs. */
typedef struct ps_point_way {
    ps_device *device;     /* NULL: an engine of the host */
    uint64_t memory_limit; /* bytes that somebody typed; 0: none */
    const ps_watch *watch; /* told about every second; may be NULL */
} ps_point_way;

/* |f_k|^2 of frequencies that are enumerated, by the cheapest engine that has sums to 1e-9 of those
 * of white noise. */
pspec_status ps_point_powers(const ps_integrand *integrand, const ps_frequencies *frequencies,
                             const ps_point_way *way, double *powers,
                             ps_error *error) PS_MUST_CHECK;

/* The seconds of that; 0 where no engine does it, which the run will say. */
pspec_status ps_point_powers_seconds(double *seconds, const ps_integrand *integrand,
                                     const ps_frequencies *frequencies, const ps_point_way *way,
                                     ps_error *error) PS_MUST_CHECK;

typedef struct ps_prediction {
    double variance;       /* with what lies beyond the cut-off as white */
    double standard_error; /* over realizations; nan of one */
    /* With nothing beyond the cut-off, and with the most power there: (V3), without statistics */
    double lower, upper;
    double white; /* of as many independent points */
} ps_prediction;

/* The most power that sets have beyond the cut-off. */
typedef struct ps_power_beyond {
    double white; /* that of independent points with the same weights: 1 where all count the same */
    double most;
    bool is_known; /* a bound of the sampler's expected power, or N of a single set; else the
                      largest that was measured in a ring or degree, at least 1 */
    /* false: the cut-off has the reach of every integrand, and what lies beyond is rounding. The
     * largest power was then measured in few rings, and nothing depends on it. */
    bool matters;
} ps_power_beyond;

/* weights [frequencies->num] of the powers, so that N Var is their sum: those of both k and -k on
 * the torus, of all orders of a degree. Over shells, of a box, the corners beyond its rings have
 * none. *held: energy of the integrand at the frequencies summed. The way is for
 * integrands by points. */
pspec_status ps_prediction_weigh(const ps_integrand *integrand, const ps_frequencies *frequencies,
                                 bool over_shells, const ps_point_way *way, double *weights,
                                 double *held, ps_error *error) PS_MUST_CHECK;
/* The largest |k_i|, of the ball of shells |k|, or degree that matters to any of them; infinite
 * where there is no such. At least that of the first frequency or even degree. */
double ps_prediction_reach(const ps_integrand *const *integrands, size_t num, bool over_shells);
/* sampler NULL: of files, of which nothing is known; reach: as above. */
ps_power_beyond ps_prediction_power_beyond(const ps_sampler_request *sampler,
                                           const ps_spectrum *spectrum, double reach);
/* sum is the weighted sum, its mean and standard error over realizations. */
ps_prediction ps_prediction_make(const ps_integrand *integrand, ps_mean sum, double held,
                                 double num_points, const ps_power_beyond *beyond);

#endif
