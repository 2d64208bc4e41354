/* Run time against error: every engine in every precision at tolerances from loose to tight, on
 * cases that stand for what people ask. The error is measured against the long double referee, in
 * the units of the tolerance contract (docs/user/conventions.md#tolerance), on the first
 * realization; where everything would take minutes on frequencies or degrees evenly spread over
 * all.
 *
 * The time is that of a realization, from points in host memory to powers on the device: the median
 * of nine runs of many realizations each, three at a time, in turn with the other rows of the case;
 * without what is done once per job.
 */
#ifndef PS_VERIFY_BENCH_BENCH_H
#define PS_VERIFY_BENCH_BENCH_H

#include "verify/stress.h"

/* The peaks of a device, measured by small kernels of ours (kernels/probe): fused operations,
 * copied and sent bytes, launches. Nothing but disturbance makes these slower, so the best of some
 * runs is taken. */

/* The peak of fused multiply-adds. On a shared machine it changes from second to second, so that
 * whoever compares may measure it again beside every run. */
typedef struct ps_peak {
    ps_device *device;
    ps_kernel *kernel;
    ps_buffer result;
    ps_range range;
} ps_peak;

/* Builds the kernel and touches the memory. Destroyed also after a failure. */
pspec_status ps_peak_create(ps_peak *peak, ps_device *device, ps_precision precision,
                            ps_error *error) PS_MUST_CHECK;
/* One run, of about ten milliseconds on a CPU. */
pspec_status ps_peak_run(const ps_peak *peak, double *flops_per_second,
                         ps_error *error) PS_MUST_CHECK;
void ps_peak_destroy(ps_peak *peak);

/* A copy that differs is PSPEC_ERROR_DEVICE. *peaks becomes figures without engines. */
pspec_status ps_device_peaks_measure(ps_device *device, ps_figures *peaks,
                                     ps_error *error) PS_MUST_CHECK;

/* num_checked of a case are the frequencies that its errors are of; on a GPU its realizations are
 * GPU_REALIZATIONS times as many. */
extern const ps_suite ps_bench_suite;

typedef struct ps_bench_row {
    const ps_stress_case *what;
    const ps_engine *engine;
    ps_precision precision;
    double tolerance; /* the tightest of those tried that leads to this computation */
    double seconds, predicted_seconds; /* of a realization */
    double error, predicted_error;     /* as the tolerance counts */
    /* measured beside it, of arithmetic that the launches count; nan: no device */
    double fraction_of_peak;
    /* of a copy, by points read and powers written once; nan: no device */
    double fraction_of_bandwidth;
    bool is_pareto; /* no other row of the case is as fast and as exact */
} ps_bench_row;

/* copied_bytes per second is what fractions of bandwidth are of. */
pspec_status ps_bench_run(const ps_suite_options *options, ps_device *device, double copied_bytes,
                          ps_error *error) PS_MUST_CHECK;

/* Marks the rows that no other one of the same case is at once no slower and no less exact than,
 * and better in one of both. */
void ps_bench_mark_pareto(ps_bench_row *rows, size_t num);

/* Peaks of the device, and how long every engine takes against the built-in cost model: the middle
 * of the runs of each case, and the geometric mean over the cases. figures->date is left to the
 * caller. */
pspec_status ps_bench_calibrate(const ps_suite_options *options, ps_device *device,
                                ps_figures *figures, ps_error *error) PS_MUST_CHECK;

/* The same of samplers against their rows; 1 where the fewest points take too long. */
pspec_status ps_bench_calibrate_host(const ps_suite_options *options, ps_figures *figures,
                                     ps_error *error) PS_MUST_CHECK;

#endif
