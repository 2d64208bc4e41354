#include "files/elements.h"

#include "base/wide.h"

#include <math.h>
#include <string.h>

bool ps_host_is_big_endian(void) {
    const uint16_t probe = 1;
    unsigned char first = 0;
    memcpy(&first, &probe, 1);
    return first == 0;
}

/* From the order of a file to that of this machine, or back. */
static void order_bytes(ps_element_type type, unsigned char *bytes, size_t count) {
    const size_t last = type.num_bytes - 1;
    for (size_t i = 0; type.is_big_endian != ps_host_is_big_endian() && i < count; i++) {
        unsigned char *const element = bytes + i * type.num_bytes;
        for (size_t j = 0; j < type.num_bytes / 2; j++) {
            const unsigned char kept = element[j];
            element[j] = element[last - j];
            element[last - j] = kept;
        }
    }
}

/* Widens elements; raw and out do not overlap, so that compilers make vectors of this. */
#define DEFINE_WIDEN(name, element)                                                                \
    PS_WIDE_BODY(size_t, name,                                                                     \
                 (const unsigned char *restrict raw, double *restrict out, size_t count)) {        \
        for (size_t i = 0; i < count; i++) {                                                       \
            element narrow = 0;                                                                    \
            memcpy(&narrow, raw + i * sizeof narrow, sizeof narrow);                               \
            out[i] = (double)narrow;                                                               \
        }                                                                                          \
        return count;                                                                              \
    }                                                                                              \
    PS_WIDE(size_t, name, (const unsigned char *restrict raw, double *restrict out, size_t count), \
            (raw, out, count))

DEFINE_WIDEN(widen_double, double)
DEFINE_WIDEN(widen_float, float)
DEFINE_WIDEN(widen_int8, int8_t)
DEFINE_WIDEN(widen_int16, int16_t)
DEFINE_WIDEN(widen_uint8, uint8_t)
DEFINE_WIDEN(widen_uint16, uint16_t)
DEFINE_WIDEN(widen_int32, int32_t)
DEFINE_WIDEN(widen_int64, int64_t)
DEFINE_WIDEN(widen_uint32, uint32_t)
DEFINE_WIDEN(widen_uint64, uint64_t)

/* IEEE 754 binary16: a sign, 5 bits of exponent and 10 of fraction. */
static double half_to_double(uint16_t half) {
    enum { FRACTION_BITS = 10, BIAS = 15, SPECIAL = 31 };
    const int exponent = half >> FRACTION_BITS & SPECIAL;
    const int fraction = half & ((1 << FRACTION_BITS) - 1);
    const double sign = half >> 15 != 0 ? -1 : 1;
    if (exponent == SPECIAL) {
        return fraction != 0 ? (double)NAN : sign * (double)INFINITY;
    }
    const int hidden = exponent > 0 ? 1 << FRACTION_BITS : 0;
    return sign * ldexp(hidden + fraction, (exponent > 0 ? exponent : 1) - BIAS - FRACTION_BITS);
}

static size_t widen_half(const unsigned char *raw, double *out, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint16_t half = 0;
        memcpy(&half, raw + i * sizeof half, sizeof half);
        out[i] = half_to_double(half);
    }
    return count;
}

/* By kind and the logarithm of the bytes. */
typedef size_t widener(const unsigned char *raw, double *out, size_t count);
static widener *const wideners[][4] = {
    [PS_ELEMENT_FLOAT] = {NULL, widen_half, widen_float, widen_double},
    [PS_ELEMENT_SIGNED] = {widen_int8, widen_int16, widen_int32, widen_int64},
    [PS_ELEMENT_UNSIGNED] = {widen_uint8, widen_uint16, widen_uint32, widen_uint64}};

static void widen(ps_element_type type, const unsigned char *raw, double *out, size_t count) {
    unsigned place = 0;
    while ((1U << place) < type.num_bytes) {
        place++;
    }
    wideners[type.kind][place](raw, out, count);
}

/* One read: *count elements at most, and at the end fewer. */
static pspec_status read_step(ps_input *input, ps_element_type type, double *out, size_t *count,
                              ps_error *error) {
    enum { STEP_BYTES = 1 << 16 }; /* not less than ps_input reads without its buffer */
    unsigned char raw[STEP_BYTES];
    const bool is_double = type.kind == PS_ELEMENT_FLOAT && type.num_bytes == sizeof(double);
    const size_t most = is_double ? *count : STEP_BYTES / type.num_bytes;
    const size_t wanted = *count < most ? *count : most;
    unsigned char *const target = is_double ? (unsigned char *)out : raw;
    size_t num_bytes = 0;
    PS_TRY(ps_input_read(input, target, wanted * type.num_bytes, &num_bytes, error));
    if (num_bytes % type.num_bytes != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: it ends inside a number",
                       input->name);
    }
    *count = num_bytes / type.num_bytes;
    order_bytes(type, target, *count);
    if (!is_double) {
        widen(type, raw, out, *count);
    }
    return PSPEC_OK;
}

pspec_status ps_elements_read(ps_input *input, ps_element_type type, double *out, size_t count,
                              size_t *num_read, ps_error *error) {
    size_t step = 1;
    for (*num_read = 0; *num_read < count && step > 0; *num_read += step) {
        step = count - *num_read;
        PS_TRY(read_step(input, type, out + *num_read, &step, error));
    }
    return PSPEC_OK;
}

double ps_element_number(ps_element_type type, const unsigned char *bytes) {
    unsigned char own[sizeof(double)];
    double value = 0;
    memcpy(own, bytes, type.num_bytes);
    order_bytes(type, own, 1);
    widen(type, own, &value, 1);
    return value;
}

void ps_elements_write(ps_output_file *file, const double *values, size_t count) {
    enum { BLOCK = 4096 };
    static const ps_element_type float64 = {PS_ELEMENT_FLOAT, sizeof(double), false};
    double block[BLOCK];
    if (!ps_host_is_big_endian()) {
        ps_output_write(file, values, sizeof *values, count);
        return;
    }
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t num = count - first < BLOCK ? count - first : BLOCK;
        memcpy(block, values + first, num * sizeof *block);
        order_bytes(float64, (unsigned char *)block, num);
        ps_output_write(file, block, sizeof *block, num);
    }
}
