#include "io/elements.h"

#include <string.h>

bool ps_host_is_big_endian(void) {
    const uint16_t probe = 1;
    unsigned char first = 0;
    memcpy(&first, &probe, 1);
    return first == 0;
}

static void swap_bytes(unsigned char *bytes, size_t count, size_t element_bytes) {
    for (size_t i = 0; i < count; i++) {
        unsigned char *const element = bytes + i * element_bytes;
        for (size_t j = 0; j < element_bytes / 2; j++) {
            const unsigned char kept = element[j];
            element[j] = element[element_bytes - 1 - j];
            element[element_bytes - 1 - j] = kept;
        }
    }
}

/* Widens elements of raw, which may be the upper half of out: the front never overtakes them. */
#define DEFINE_WIDEN(name, element)                                                                \
    static void name(const unsigned char *raw, double *out, size_t count) {                        \
        for (size_t i = 0; i < count; i++) {                                                       \
            element narrow = 0;                                                                    \
            memcpy(&narrow, raw + i * sizeof narrow, sizeof narrow);                               \
            const double value = (double)narrow;                                                   \
            memcpy(out + i, &value, sizeof value);                                                 \
        }                                                                                          \
    }

DEFINE_WIDEN(widen_float, float)
DEFINE_WIDEN(widen_int32, int32_t)
DEFINE_WIDEN(widen_int64, int64_t)
DEFINE_WIDEN(widen_uint32, uint32_t)
DEFINE_WIDEN(widen_uint64, uint64_t)

static void widen(ps_element_type type, const unsigned char *raw, double *out, size_t count) {
    const bool is_long = type.num_bytes == sizeof(double);
    switch (type.kind) {
    case PS_ELEMENT_FLOAT:
        if (!is_long) { /* doubles are where they belong */
            widen_float(raw, out, count);
        }
        break;
    case PS_ELEMENT_SIGNED:
        (is_long ? widen_int64 : widen_int32)(raw, out, count);
        break;
    case PS_ELEMENT_UNSIGNED:
        (is_long ? widen_uint64 : widen_uint32)(raw, out, count);
        break;
    }
}

pspec_status ps_elements_read(ps_input *input, ps_element_type type, double *out, size_t count,
                              size_t *num_read, ps_error *error) {
    size_t num_bytes = 0;
    unsigned char *const raw = (unsigned char *)out + count * (sizeof(double) - type.num_bytes);
    PS_TRY(ps_input_read(input, raw, count * type.num_bytes, &num_bytes, error));
    *num_read = num_bytes / type.num_bytes;
    if (type.is_big_endian != ps_host_is_big_endian()) {
        swap_bytes(raw, *num_read, type.num_bytes);
    }
    widen(type, raw, out, *num_read);
    return PSPEC_OK;
}

void ps_elements_write(ps_output_file *file, const double *values, size_t count) {
    enum { BLOCK = 4096 };
    double block[BLOCK];
    if (!ps_host_is_big_endian()) {
        ps_output_write(file, values, sizeof *values, count);
        return;
    }
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t num = count - first < BLOCK ? count - first : BLOCK;
        memcpy(block, values + first, num * sizeof *block);
        swap_bytes((unsigned char *)block, num, sizeof *block);
        ps_output_write(file, block, sizeof *block, num);
    }
}
