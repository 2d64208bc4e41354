#include "plan/cost_model.h"

#include "device/kind.h"

/* Measured rates. Machine: 2 cores of a Zen 5 EPYC (AVX-512) at a nominal 2.6 GHz, PoCL 3.1,
 * Debian 12, 2026-11. Regenerate with `./dev bench calibrate`, which prints this table. The numbers
 * are work per second as a share of the nominal peak of ps_cost_nominal_flops, so that they carry
 * over to other devices of the same class; 20 % either way changes no choice between engines that
 * differ by a factor of ten. The machine is shared: the best of several runs was taken. */
typedef struct device_rates {
    double phases_per_flop; /* cosine-sine pairs per nominal flop: torus/list.cl with its table */
    double product_share;   /* share of the nominal peak that torus/product.cl reaches */
    double transform_share; /* share of its cycles that nufft/ takes */
    double harmonics_per_flop; /* (point, degree, order) triples per nominal flop: sphere/sums.cl,
                                  on 2 cores of an EPYC with AVX2 */
    /* pairs/sums.cl, on GPUs sums_shared.cl, and histogram.cl, per nominal flop: on 2 cores of an
     * EPYC with AVX2, bench_pairs, 2026-11 */
    double pair_degrees_per_flop; /* (pair, degree) */
    double node_degrees_per_flop; /* (node, degree) */
    double pairs_per_flop;        /* pairs into a histogram */
    double seconds_per_launch;
} device_rates;

/* Enqueueing one kernel: 10 microseconds cover PoCL's threads. */
static const device_rates cpu_rates[2] = {
    [PS_SINGLE] = {0.010, 1.15, 1.0, 0.056, 0.114, 0.114, 0.005, 10e-6},
    [PS_DOUBLE] = {0.0133, 1.14, 1.0, 0.053, 0.113, 0.113, 0.005, 10e-6},
};

/* The same of GPUs, where transforms have cycles of their own (engines/nufft/cycles.c). Measured on
 * an H200 or H100 (docs/developer/performance.md, "On a GPU"): lists ran at 11.2 TFLOP/s with 37 of
 * them a phase; a prototype of the product, slowed down by what the kernel does more than it, has
 * 4.9 us for (1024, 128). Sums of sphere_direct and over pairs were not measured since work-groups
 * do them: counted, they reach 0.06 and 0.1 (docs/engines/sphere_direct.md,
 * docs/engines/pairs_direct.md), of which plans take less than half. Histograms and their nodes
 * are done by groups of one item, as sphere_direct was: both have 0.8 % of their CPU's rate, as it
 * had. A launch is
 * what NVIDIA's driver takes, an estimate until --calibrate has run on one. A kernel for GPUs with
 * work of its own has a column here. */
static const device_rates gpu_rates[2] = {
    [PS_SINGLE] = {0.0045, 0.56, 1.0, 0.02, 0.04, 9.6e-4, 4.2e-5, 5e-6},
    [PS_DOUBLE] = {0.0045, 0.50, 1.0, 0.02, 0.04, 9.6e-4, 4.2e-5, 5e-6},
};

/* Long double cosine and sine of one (point, frequency) pair on one core, same machine. */
static const double host_seconds_per_phase = 190e-9;

/* rules/worst_case_error.c and representer.c on one core, same machine: perf record pointspec
 * quadrature --brdf diffuse --sampler white-hemisphere -n 1024 -m 3000. For the shares of skips
 * only. */
static const double host_seconds_per_rule_pair = 1.1e-9;
static const double host_seconds_per_kappa_term = 0.4e-9;

/* Typical clock where a device does not tell. */
enum { DEFAULT_CLOCK_MHZ = 1000, PIPES = 2, FLOPS_PER_FMA = 2 };

/* A GPU compute unit (streaming multiprocessor) runs this many float lanes per clock and pipe. */
enum { GPU_UNIT_LANES = 64 };

static double peak_of(const ps_device_limits *limits, ps_precision precision, double units,
                      double clock_mhz) {
    const double hertz = 1e6;
    double lanes =
        precision == PS_SINGLE ? limits->native_float_lanes : limits->native_double_lanes;
    if (limits->has_dedicated_local_memory) {
        lanes = precision == PS_SINGLE ? GPU_UNIT_LANES
                                       : GPU_UNIT_LANES / ps_device_double_cost(limits);
    }
    return units * hertz * clock_mhz * (lanes > 1 ? lanes : 1) * PIPES * FLOPS_PER_FMA;
}

double ps_cost_nominal_flops(const ps_device_limits *limits, ps_precision precision) {
    return peak_of(limits, precision, limits->compute_units,
                   limits->clock_mhz > 0 ? limits->clock_mhz : DEFAULT_CLOCK_MHZ);
}

static const device_rates *rates_of(const ps_device_limits *limits, ps_precision precision) {
    return limits->has_dedicated_local_memory ? &gpu_rates[precision] : &cpu_rates[precision];
}

static double seconds_at(const ps_work *work, double peak, const device_rates *rates) {
    return work->phases / (peak * rates->phases_per_flop) +
           work->product_flops / (peak * rates->product_share) +
           work->transform_flops / (peak * rates->transform_share) +
           work->harmonics / (peak * rates->harmonics_per_flop) +
           work->pair_degrees / (peak * rates->pair_degrees_per_flop) +
           work->node_degrees / (peak * rates->node_degrees_per_flop) +
           work->binned_pairs / (peak * rates->pairs_per_flop) +
           work->launches * rates->seconds_per_launch;
}

double ps_cost_seconds(const ps_work *work, const ps_device_limits *limits,
                       ps_precision precision) {
    if (limits == NULL || precision == PS_EXTENDED) {
        return work->phases * host_seconds_per_phase;
    }
    device_rates rates = *rates_of(limits, precision);
    rates.seconds_per_launch = ps_figures_launch_seconds(limits->figures, rates.seconds_per_launch);
    return seconds_at(work, ps_cost_nominal_flops(limits, precision), &rates);
}

double ps_cost_typical(const ps_work *work, const ps_device_limits *limits,
                       ps_precision precision) {
    if (limits == NULL || precision == PS_EXTENDED) {
        return ps_cost_seconds(work, NULL, precision);
    }
    const ps_typical_device typical = ps_device_typical(limits);
    return seconds_at(work, peak_of(limits, precision, typical.compute_units, typical.clock_mhz),
                      rates_of(limits, precision));
}

double ps_cost_rule_seconds(double pairs, double terms) {
    return pairs * host_seconds_per_rule_pair + terms * host_seconds_per_kappa_term;
}

/* ---- batches ----------------------------------------------------------------------------- */

/* CPU: the share of the typical last-level cache that a batch may fill. GPU: bytes of a batch;
 * enough work for a hundred compute units, far below any card's memory. Memory: share of the
 * device's memory that a job may take. */
static const double cache_share = 0.5;
static const double gpu_batch_bytes = 1024.0 * 1024 * 1024;
static const double memory_share = 0.5;

/* Results come back once per batch: more realizations than this gain nothing. */
enum { LARGEST_BATCH = 4096 };

size_t ps_cost_batch(const ps_work *work, const ps_device_limits *limits,
                     uint64_t num_realizations) {
    double batch = num_realizations > 0 && num_realizations < LARGEST_BATCH
                       ? (double)num_realizations
                       : LARGEST_BATCH;
    if (limits == NULL) {
        return 1; /* the referee takes long enough on one realization */
    }
    const double cache_bytes = (double)ps_device_typical(limits).cache_bytes;
    double budget =
        limits->has_dedicated_local_memory ? gpu_batch_bytes : cache_share * cache_bytes;
    const double memory = memory_share * (double)limits->global_bytes - work->fixed_bytes;
    const double wanted = work->wanted_batch * work->bytes_per_realization;
    budget = budget > wanted ? budget : wanted;
    budget = budget < memory ? budget : memory;
    const double by_budget = budget / work->bytes_per_realization;
    const double by_allocation =
        (double)limits->max_allocation_bytes / work->largest_buffer_per_realization;
    batch = batch < by_budget ? batch : by_budget;
    batch = batch < by_allocation ? batch : by_allocation;
    return batch > 1 ? (size_t)batch : 1;
}
