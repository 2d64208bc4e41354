#include "job/self_check.h"

#include "engines/host_direct.h"
#include "math/random.h"

#include <math.h>

/* Entries to look at, and the most long double terms to spend on them (about 190 ns each). */
enum { MOST_ENTRIES = 8, MOST_TERMS = 1 << 20 };

/* How far one entry may lie outside the engine's root-mean-square error before something is wrong:
 * rounding errors are sums of many small ones, and 8 standard deviations do not happen. */
static const double allowed_factor = 8;

/* Results must not depend on when the check is made: its choices have a seed of their own. */
static const uint64_t check_seed = 0x5e1fc4ec;

static pspec_status read_entry(const ps_rows *rows, uint32_t slot, ps_device *device, double *out,
                               ps_error *error) {
    if (rows->host != NULL) {
        *out = rows->host[slot];
        return PSPEC_OK;
    }
    if (rows->precision == PS_DOUBLE) {
        return ps_buffer_read(device, &rows->device, slot * sizeof(double), out, sizeof(double),
                              error);
    }
    float value = 0;
    PS_TRY(
        ps_buffer_read(device, &rows->device, slot * sizeof(float), &value, sizeof value, error));
    *out = value;
    return PSPEC_OK;
}

pspec_status ps_self_check(const ps_rows *rows, const uint32_t *slots,
                           const ps_frequencies *frequencies, const pspec_pattern *pattern,
                           double scale, double weight_square_sum, double engine_error,
                           ps_device *device, double *deviation, ps_error *error) {
    ps_random random = ps_random_init(check_seed, PS_STREAM_COORDINATES, 0);
    const size_t affordable = MOST_TERMS / pattern->num_points;
    size_t num_entries = affordable < MOST_ENTRIES ? affordable : MOST_ENTRIES;
    num_entries = num_entries > 0 ? num_entries : 1;
    *deviation = 0;
    for (size_t i = 0; i < num_entries; i++) {
        const size_t entry = (size_t)ps_random_below(&random, frequencies->num);
        const int32_t *k = frequencies->vectors + entry * frequencies->dimension;
        long double re = 0;
        long double im = 0;
        double power = 0;
        PS_TRY(read_entry(rows, slots[entry], device, &power, error));
        ps_host_sum(pattern, k, &re, &im);
        const double unit = sqrt(weight_square_sum);
        const double expected = (double)hypotl(re, im) / unit;
        const double off = fabs(sqrt(power / scale) / unit - expected);
        if (!(off <= allowed_factor * engine_error * (1 + expected))) {
            return ps_fail(error, PSPEC_ERROR_CHECK,
                           "self-check failed: |S| of frequency %zu is off by %.3g sqrt(sum w^2), "
                           "expected below %.3g; the device or its driver computes wrongly",
                           entry, off, allowed_factor * engine_error * (1 + expected));
        }
        *deviation = off > *deviation ? off : *deviation;
    }
    return PSPEC_OK;
}
