#include "device/reals.h"

/* Rounded at a time, on the stack, 32 KiB. A write takes some ten microseconds whatever its length:
 * with pieces of 1024 they were most of the time of a table of Legendre functions. */
enum { PIECE = 8192 };

const char *ps_precision_name(ps_precision precision) {
    static const char *const names[] = {"single", "double", "extended"};
    return names[precision];
}

size_t ps_real_bytes(ps_precision precision) {
    return precision == PS_SINGLE ? sizeof(float) : sizeof(double);
}

pspec_status ps_reals_write(ps_device *device, const ps_buffer *buffer, ps_precision precision,
                            const double *numbers, size_t num, ps_error *error) {
    if (precision != PS_SINGLE) {
        return ps_buffer_write(device, buffer, 0, numbers, num * sizeof(double), error);
    }
    for (size_t first = 0; first < num; first += PIECE) {
        float piece[PIECE];
        const size_t length = num - first < PIECE ? num - first : PIECE;
        for (size_t i = 0; i < length; i++) {
            piece[i] = (float)numbers[first + i];
        }
        PS_TRY(ps_buffer_write(device, buffer, first * sizeof(float), piece, length * sizeof(float),
                               error));
    }
    return PSPEC_OK;
}

double ps_real_at(ps_precision precision, const void *reals, size_t i) {
    return precision == PS_SINGLE ? (double)((const float *)reals)[i] : ((const double *)reals)[i];
}

pspec_status ps_reals_read(ps_device *device, const ps_buffer *buffer, ps_precision precision,
                           double *numbers, size_t num, ps_error *error) {
    if (precision != PS_SINGLE) {
        return ps_buffer_read(device, buffer, 0, numbers, num * sizeof(double), error);
    }
    for (size_t first = 0; first < num; first += PIECE) {
        float piece[PIECE];
        const size_t length = num - first < PIECE ? num - first : PIECE;
        PS_TRY(ps_buffer_read(device, buffer, first * sizeof(float), piece, length * sizeof(float),
                              error));
        for (size_t i = 0; i < length; i++) {
            numbers[first + i] = piece[i];
        }
    }
    return PSPEC_OK;
}

pspec_status ps_reals_upload(ps_device *device, ps_buffer *out, ps_precision precision,
                             const double *numbers, size_t num, const char *what, ps_error *error) {
    PS_TRY(ps_buffer_create(device, out, num * ps_real_bytes(precision), what, error));
    return ps_reals_write(device, out, precision, numbers, num, error);
}
