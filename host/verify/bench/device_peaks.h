/* The peaks of a device, measured by small kernels of ours (kernels/probe): fused operations,
 * copied and sent bytes, launches. Nothing but disturbance makes these slower, so the best of some
 * runs is taken. */
#ifndef PS_VERIFY_BENCH_DEVICE_PEAKS_H
#define PS_VERIFY_BENCH_DEVICE_PEAKS_H

#include "engines/engine.h"

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

typedef struct ps_device_peaks {
    double flops[2];     /* by precision; 0: the device has no double precision */
    double copied_bytes; /* per second, read and written by a copy much larger than any cache */
    double sent_bytes;   /* per second, from memory of the host */
    double launches;     /* per second, of kernels of one item, one after the other */
} ps_device_peaks;

/* A copy that differs is PSPEC_ERROR_DEVICE. */
pspec_status ps_device_peaks_measure(ps_device *device, ps_device_peaks *peaks,
                                     ps_error *error) PS_MUST_CHECK;

#endif
