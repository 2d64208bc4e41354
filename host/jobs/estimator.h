/* The streaming estimator: point sets go in, averages come out. Batches, memory, numerical error.
 *
 * Normalization. Rows hold N |S|^2 / W^2 with N of each realization, or |S|^2 / V. What variances
 * of integrals need, mean(N) mean(|S|^2 / W^2), is mean(N) / N_ref mean(q), rows being
 * q = N_ref |S|^2 / W^2 (N_ref fixed for the job: powers of order 1 in float;
 * docs/mathematics/statistics.md#different-numbers-of-points).
 */
#ifndef PS_JOBS_ESTIMATOR_H
#define PS_JOBS_ESTIMATOR_H

#include "base/log.h"
#include "jobs/pattern_check.h"
#include "plan/choose.h"
#include "spectra/spectrum_sums.h"

typedef struct ps_estimator ps_estimator;

/* Told of the realizations, one after the other in their order and before ps_estimator_add returns,
 * which waits for their rows then: Z(l) = sum_j w_j P_l(z_j) and C_l^2
 * for l = 0 .. L, borrowed until it returns. */
typedef struct ps_pair_observer {
    void (*tell)(void *payload, const double *zonal, const double *c2); /* NULL: nobody asks */
    void *payload;
} ps_pair_observer;

typedef struct ps_estimator_options {
    ps_problem problem; /* frequencies enumerated; num_points of the largest set so far known */
    const ps_engine *engine;
    ps_precision precision;
    size_t batch;          /* realizations at a time; halved when memory is refused */
    bool want_frequencies; /* keep sums per frequency */
    bool mean_only; /* no sums of squares: every standard error is nan, means have the same bits */
    bool no_frequency_errors; /* those of single frequencies are nan, means have the same bits */
    /* Averages are of bins and weighted sums alone, and realizations may be shared: not with
     * want_frequencies, want_c2, is_range */
    bool forms_bins;
    bool makes_rows;           /* then: what is added becomes rows (ps_estimator_begin_rows) */
    bool want_c2;              /* C_l^2 of the realizations, on the sphere: ps_estimator_c2 */
    ps_pair_observer observer; /* with want_c2: told of every realization */
    /* [num_weighted][frequencies->num] of ps_accumulator_options, in the order of
     * problem.frequencies; they outlive the estimator. ps_estimator_weighted has the sums.
     * problem.num_weighted lets the plan count their memory. */
    const double *weights;
    size_t num_weighted;
    bool self_check;
    /* The realizations are some of a larger job, `first` being the number of the first of them, a
     * multiple of a block: answers are ps_estimator_sums alone, which have parts */
    bool is_range;
    uint64_t first;
    pspec_normalization normalization;
    /* [ps_num_coefficients_at] or NULL: where a realization that comes alone in its batch leaves
     * its coefficients, of problem.harmonics; what there is to sum twice is summed once */
    double *coefficients;
    /* Is given them, and the sum of the weights, after every such realization; may be NULL */
    pspec_status (*keep)(void *payload, const double *coefficients, double weight_sum,
                         ps_error *error);
    bool (*should_stop)(void *payload); /* asked every second or so; may be NULL, see ps_batch */
    void *payload;
    ps_log log; /* told of smaller batches and larger engines */
} ps_estimator_options;

/* The numerical side of a result. */
typedef struct ps_accuracy {
    double error; /* bound of the engine's formula with the powers that were measured */
    /* Largest | |u| - 1 | of the vectors on the sphere, which were divided by |u| */
    double length_error;
    double largest_share;      /* largest sum w^2 / (sum |w|)^2 of a realization */
    double largest_mean_power; /* largest effective power of a realization, mean over frequencies */
    uint64_t largest_points;   /* of a realization */
    bool was_checked;
    /* Largest deviation from the referee, of |S| in units of sqrt(sum w^2), of pair sums in (sum
     * |w|)^2 */
    double self_check;
} ps_accuracy;

/* device may be NULL for engines that need none. */
pspec_status ps_estimator_create(ps_estimator **out, const ps_estimator_options *options,
                                 ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_estimator_destroy(ps_estimator *estimator);

/* From now on patterns without points, of the sets' size, are realizations that the device makes:
 * the number of a realization is the number of those before it, and options.first. Before any is
 * added; sets outlive the estimator, whose engine takes them. */
pspec_status ps_estimator_use_sets(ps_estimator *estimator, ps_device_sets *sets,
                                   ps_error *error) PS_MUST_CHECK;

/* Adds realizations, in order; any number at a time gives the same bits. A pattern larger than
 * problem.num_points is taken all the same (the engine is made anew). Every coordinate and
 * weight is checked. A self-check that fails is PSPEC_ERROR_CHECK. */
pspec_status ps_estimator_add(ps_estimator *estimator, const pspec_pattern *patterns,
                              size_t num_patterns, ps_error *error) PS_MUST_CHECK;

/* Realizations that several estimators share, with options.makes_rows: those that are added next,
 * from number `first` on, do not change the averages; what each would have added becomes a row of
 * bytes, in their order, from rows on. ps_estimator_settle waits for them. */
void ps_estimator_begin_rows(ps_estimator *estimator, uint64_t first, void *rows);
size_t ps_estimator_row_bytes(const ps_estimator *estimator); /* a multiple of sizeof(double) */
/* Adds the next realization, a row of any estimator of the plan. Together they have the bits of one
 * estimator; what is measured besides is of ps_estimator_take_measured. */
pspec_status ps_estimator_take_row(ps_estimator *estimator, const void *row,
                                   ps_error *error) PS_MUST_CHECK;

/* Makes the engine that it would have after a pattern of so many points, which it does not get: of
 * another range. */
pspec_status ps_estimator_expect(ps_estimator *estimator, uint64_t num_points,
                                 ps_error *error) PS_MUST_CHECK;

/* The next pattern is realization `number` of a job whose others another estimator has: so it is
 * called in sentences. No range. */
void ps_estimator_go_to(ps_estimator *estimator, uint64_t number);

/* A pattern that is never in memory as a whole. What its scale needs is known before its points
 * come. */
typedef struct ps_pattern_stream {
    unsigned dimension;
    uint64_t num_points;
    ps_pattern_sums sums;
    /* The next block: a multiple of `unit` points, any number of them at the end of the pattern,
     * and none behind it. */
    pspec_status (*next)(void *payload, size_t unit, pspec_pattern *block, ps_error *error);
    void *payload;
} ps_pattern_stream;

/* May a pattern come in blocks? That depends on engine and problem, not on the pattern. */
bool ps_estimator_can_stream(const ps_estimator *estimator);
/* Adds one realization in blocks, to the bit as ps_estimator_add would. */
pspec_status ps_estimator_add_stream(ps_estimator *estimator, const ps_pattern_stream *stream,
                                     ps_error *error) PS_MUST_CHECK;

/* Coefficients of one pattern as ps_engine.coefficients has them, out[ps_num_coefficients_at]; the
 * averages do not change. Hemispherical harmonics are for points with z >= 0.
 * PSPEC_ERROR_INVALID_ARGUMENT where the engine has none, as on the torus. should_stop is asked as
 * while realizations are added. */
pspec_status ps_estimator_coefficients(ps_estimator *estimator, const pspec_pattern *pattern,
                                       ps_harmonics harmonics, double *out,
                                       ps_error *error) PS_MUST_CHECK;

/* Forgets all realizations, and any failure: what follows has the bits of a new estimator.
 * Allocates nothing. */
void ps_estimator_reset(ps_estimator *estimator);

/* All state of what was added, to a checkpoint or from one, into an estimator of the same options
 * that has no realizations. */
pspec_status ps_estimator_walk(ps_estimator *estimator, ps_snapshot *snapshot,
                               ps_error *error) PS_MUST_CHECK;

/* Realizations that one call of ps_estimator_add takes best. */
size_t ps_estimator_batch(const ps_estimator *estimator);
uint64_t ps_estimator_num_realizations(const ps_estimator *estimator);

pspec_status ps_estimator_spectrum(ps_estimator *estimator, ps_spectrum *out,
                                   ps_error *error) PS_MUST_CHECK;
/* The sums behind the averages, with the error bound; bins are ps_estimator_bins. Those of a range
 * have their nodes; how many realizations the job has is to be added. */
pspec_status ps_estimator_sums(ps_estimator *estimator, ps_spectrum_sums *out,
                               ps_error *error) PS_MUST_CHECK;
/* Mean and standard error of every bin so far, in the units of the result:
 * means[ps_estimator_bins()->num]. */
pspec_status ps_estimator_bin_means(ps_estimator *estimator, ps_mean *means,
                                    ps_error *error) PS_MUST_CHECK;
/* Mean and standard error, over realizations, of the weighted sums so far, in the units of the
 * result: means[options.num_weighted]. The mean is the weighted sum of the powers that
 * ps_estimator_spectrum has; under PSPEC_NORMALIZATION_INTEGRAL these are
 * mean(N) mean(|S|^2 / W^2), and with weights |f|^2 the variance of integrals is the sum divided by
 * mean(N). A frequency of the torus stands for itself, not for k and -k; on the sphere a power is
 * that of a degree, for all of its orders. */
pspec_status ps_estimator_weighted(ps_estimator *estimator, ps_mean *means,
                                   ps_error *error) PS_MUST_CHECK;
/* The same sums by blocks of realizations, in the unit of a row: [options.num_weighted]. */
const ps_block_sums *ps_estimator_weighted_blocks(const ps_estimator *estimator);
/* C_l^2 of pair sums, mean and standard error: means[number of degrees]; with want_c2 only. */
void ps_estimator_c2(const ps_estimator *estimator, ps_mean *means);
/* Waits until all that was added is in the averages; ps_estimator_accuracy, ps_estimator_c2 and
 * ps_estimator_weighted_blocks want that before, and whatever has a status does it. */
pspec_status ps_estimator_settle(ps_estimator *estimator, ps_error *error) PS_MUST_CHECK;
const ps_bins *ps_estimator_bins(const ps_estimator *estimator);
ps_accuracy ps_estimator_accuracy(const ps_estimator *estimator);
/* What was measured of the realizations: numbers of which all who share them have the largest. */
enum { PS_NUM_MEASURED = 5 };
pspec_status ps_estimator_measure(ps_estimator *estimator, double numbers[PS_NUM_MEASURED],
                                  ps_error *error) PS_MUST_CHECK;
void ps_estimator_take_measured(ps_estimator *estimator, const double numbers[PS_NUM_MEASURED]);
void ps_estimator_describe(const ps_estimator *estimator, ps_text *text);

#endif
