#include "verify/bench/bench.h"

#include "base/clock.h"
#include "base/memory.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

enum { REPEATS = 5 };

/* ---- arithmetic ---------------------------------------------------------------------------- */

/* CPUs: about ten milliseconds of a core with AVX-512. GPUs: enough work-items to fill any. STEPS
 * and CHAINS are those of probe/peak.cl. */
enum { CPU_ITEMS = 1024, GPU_ITEMS = 1 << 17, STEPS = 4096, CHAINS = 16 };

static pspec_status prepare(ps_peak *peak, ps_precision precision, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(peak->device);
    const unsigned lanes = ps_engine_lanes(limits, precision);
    const size_t items = limits->has_dedicated_local_memory ? GPU_ITEMS : CPU_ITEMS;
    double ignored = 0;
    ps_defines defines = ps_defines_of(ps_real_bytes(precision), lanes);
    ps_defines_add(&defines, "-DSTEPS=%d", STEPS);
    PS_TRY(ps_kernel_get(peak->device, &peak->kernel, "probe/peak.cl", "probe_peak", defines.text,
                         error));
    PS_TRY(ps_buffer_create(peak->device, &peak->result, items * lanes * sizeof(double), "results",
                            error));
    peak->range =
        ps_range_light(peak->device, items, 1, 1, 2.0 * (double)items * STEPS * CHAINS * lanes, 0);
    return ps_peak_run(peak, &ignored, error);
}

pspec_status ps_peak_create(ps_peak *peak, ps_device *device, ps_precision precision,
                            ps_error *error) {
    *peak = (ps_peak){.device = device};
    return prepare(peak, precision, error);
}

pspec_status ps_peak_run(const ps_peak *peak, double *flops_per_second, ps_error *error) {
    const double begin = ps_clock_seconds();
    PS_TRY(PS_LAUNCH(peak->device, peak->kernel, &peak->range, error, PS_BUFFER(peak->result),
                     PS_U32(1)));
    PS_TRY(ps_device_finish(peak->device, error));
    *flops_per_second = peak->range.flops / (ps_clock_seconds() - begin);
    return PSPEC_OK;
}

void ps_peak_destroy(ps_peak *peak) {
    ps_buffer_release(&peak->result);
    peak->kernel = NULL;
}

/* ---- memory -------------------------------------------------------------------------------- */

/* Two buffers, a kernel, and a number that must arrive at the end. */
typedef struct copy {
    ps_device *device;
    ps_kernel *kernel;
    ps_buffer from, to;
    size_t bytes;
    ps_range range;
    void *block; /* memory as the host has it, of the size of a batch */
    size_t block_bytes;
} copy;

static const float mark = 0.75F;

/* Much more than any cache, and little of the memory. */
static size_t copied_bytes(const ps_device_limits *limits) {
    const size_t most = limits->has_dedicated_local_memory ? (size_t)1 << 30 : (size_t)1 << 27;
    const size_t unit = 1 << 20;
    return most < limits->max_allocation_bytes / 2
               ? most
               : (size_t)limits->max_allocation_bytes / 2 / unit * unit;
}

static pspec_status prepare_copy(copy *self, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    const unsigned lanes = ps_engine_lanes(limits, PS_SINGLE);
    const ps_defines defines = ps_defines_of(sizeof(float), lanes);
    PS_TRY(ps_kernel_get(self->device, &self->kernel, "probe/copy.cl", "probe_copy", defines.text,
                         error));
    self->bytes = copied_bytes(limits);
    self->range = ps_range_light(self->device, self->bytes / (lanes * sizeof(float)), 1, 1, 0, 0);
    PS_TRY(ps_buffer_create(self->device, &self->from, self->bytes, "a copy", error));
    PS_TRY(ps_buffer_create(self->device, &self->to, self->bytes, "a copy", error));
    PS_TRY(ps_buffer_clear(self->device, &self->from, error));
    return ps_buffer_write(self->device, &self->from, self->bytes - sizeof mark, &mark, sizeof mark,
                           error);
}

static pspec_status check_copy(const copy *self, ps_error *error) {
    float found = 0;
    PS_TRY(ps_buffer_read(self->device, &self->to, self->bytes - sizeof found, &found, sizeof found,
                          error));
    return found == mark ? PSPEC_OK
                         : ps_fail(error, PSPEC_ERROR_DEVICE,
                                   "a copy of %zu bytes on the device differs from what was copied",
                                   self->bytes);
}

/* What is timed, once. */
typedef pspec_status task(const copy *self, ps_error *error);

/* The least seconds of so many runs; the first touches memory. */
static pspec_status find_best(const copy *self, task *run, int repeats, double *best,
                              ps_error *error) {
    *best = HUGE_VAL;
    for (int i = 0; i <= repeats; i++) {
        const double begin = ps_clock_seconds();
        PS_TRY(run(self, error));
        PS_TRY(ps_device_finish(self->device, error));
        *best = fmin(*best, ps_clock_seconds() - begin);
    }
    return PSPEC_OK;
}

static pspec_status run_copy(const copy *self, ps_error *error) {
    return PS_LAUNCH(self->device, self->kernel, &self->range, error, PS_BUFFER(self->from),
                     PS_BUFFER(self->to));
}

enum { IN_A_ROW = 256 };

/* One after the other, with something to do for one work-group of each. */
static pspec_status launch_small(const copy *self, ps_error *error) {
    const ps_range one = ps_range_light(self->device, 1, 1, 1, 0, 0);
    for (int i = 0; i < IN_A_ROW; i++) {
        PS_TRY(PS_LAUNCH(self->device, self->kernel, &one, error, PS_BUFFER(self->from),
                         PS_BUFFER(self->to)));
    }
    return PSPEC_OK;
}

static pspec_status send(const copy *self, ps_error *error) {
    return ps_buffer_write(self->device, &self->from, 0, self->block, self->block_bytes, error);
}

static pspec_status measure_memory(ps_device *device, ps_figures *peaks, ps_error *error) {
    const size_t most = 32 << 20;
    copy self = {.device = device};
    double best = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, prepare_copy(&self, error));
    self.block_bytes = self.bytes < most ? self.bytes : most;
    PS_TRY_OUT(status, ps_allocate(&self.block, self.block_bytes, 1, "a block to send", error));
    PS_TRY_OUT(status, find_best(&self, run_copy, 2 * REPEATS, &best, error));
    PS_TRY_OUT(status, check_copy(&self, error));
    peaks->copied_bytes = 2 * (double)self.bytes / best;
    PS_TRY_OUT(status, find_best(&self, launch_small, REPEATS, &best, error));
    peaks->launches = IN_A_ROW / best;
    PS_TRY_OUT(status, find_best(&self, send, REPEATS, &best, error));
    peaks->sent_bytes = (double)self.block_bytes / best;
out:
    free(self.block);
    ps_buffer_release(&self.from);
    ps_buffer_release(&self.to);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

static pspec_status measure_flops(ps_device *device, ps_precision precision, double *best,
                                  ps_error *error) {
    ps_peak peak;
    *best = 0;
    pspec_status status = ps_peak_create(&peak, device, precision, error);
    for (int i = 0; i < REPEATS && status == PSPEC_OK; i++) {
        double rate = 0;
        status = ps_peak_run(&peak, &rate, error);
        *best = fmax(*best, rate);
    }
    ps_peak_destroy(&peak);
    return status;
}

pspec_status ps_device_peaks_measure(ps_device *device, ps_figures *peaks, ps_error *error) {
    *peaks = (ps_figures){.is_measured = true};
    PS_TRY(measure_flops(device, PS_SINGLE, &peaks->flops[PS_SINGLE], error));
    if (ps_device_get_limits(device)->has_fp64) {
        PS_TRY(measure_flops(device, PS_DOUBLE, &peaks->flops[PS_DOUBLE], error));
    }
    return measure_memory(device, peaks, error);
}
