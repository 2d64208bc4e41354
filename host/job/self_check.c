#include "job/self_check.h"

#include "engines/host_direct.h"
#include "math/random.h"

#include <math.h>
#include <stdio.h>

/* Entries to look at, and the most long double terms to spend on them. */
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

/* "(3, -4)" */
static void print_frequency(char *text, size_t text_bytes, const int32_t *k, unsigned dimension) {
    size_t length = 0;
    for (unsigned axis = 0; axis < dimension && length < text_bytes; axis++) {
        length += (size_t)snprintf(text + length, text_bytes - length, "%s%d",
                                   axis == 0 ? "(" : ", ", (int)k[axis]);
    }
    if (length < text_bytes) {
        snprintf(text + length, text_bytes - length, ")");
    }
}

/* How far |S| of one entry is from the referee's, in units of sqrt(V). */
static pspec_status check_entry(const ps_self_check_input *input, size_t entry, ps_device *device,
                                double *off, ps_error *error) {
    const ps_frequencies *set = input->frequencies;
    const int32_t *k = set->vectors + entry * set->dimension;
    const double unit = sqrt(input->weight_square_sum);
    long double re = 0;
    long double im = 0;
    double power = 0;
    char text[96];
    PS_TRY(read_entry(input->rows, input->slots[entry], device, &power, error));
    ps_host_sum(input->pattern, k, &re, &im);
    const double expected = (double)ldexpl(hypotl(re, im), -input->exponent) / unit;
    const double allowed = allowed_factor * input->engine_error * (1 + expected);
    *off = fabs(sqrt(power / input->scale) / unit - expected);
    if (!(*off <= allowed)) {
        print_frequency(text, sizeof text, k, set->dimension);
        return ps_fail(error, PSPEC_ERROR_CHECK,
                       "self-check failed: |S| of frequency %s is off by %.3g sqrt(sum w^2), "
                       "expected below %.3g; the device or its driver computes wrongly",
                       text, *off, allowed);
    }
    return PSPEC_OK;
}

pspec_status ps_self_check(const ps_self_check_input *input, ps_device *device, double *deviation,
                           ps_error *error) {
    ps_random random = ps_random_init(check_seed, PS_STREAM_COORDINATES, 0);
    const size_t affordable = MOST_TERMS / input->pattern->num_points;
    const size_t num_entries = affordable < MOST_ENTRIES ? affordable : MOST_ENTRIES;
    *deviation = 0;
    for (size_t i = 0; i < num_entries; i++) {
        double off = 0;
        const size_t entry = (size_t)ps_random_below(&random, input->frequencies->num);
        PS_TRY(check_entry(input, entry, device, &off, error));
        *deviation = off > *deviation ? off : *deviation;
    }
    return PSPEC_OK;
}
