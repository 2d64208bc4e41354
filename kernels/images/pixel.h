/* Pixels of light: floats that are not negative, in four bytes each, or in three without the sign
 * and the last seven binary digits. */
#ifndef PS_IMAGES_PIXEL_H
#define PS_IMAGES_PIXEL_H

#ifdef __OPENCL_C_VERSION__
#define PIXELS __global const uchar
#else
#include <string.h>
#define PIXELS const unsigned char
static inline float as_float(const unsigned bits) {
    float number = 0;
    memcpy(&number, &bits, sizeof number);
    return number;
}
#endif

enum { PIXEL_FLOAT_BYTES = 4, PIXEL_SHORT_BYTES = 3, PIXEL_LOST_DIGITS = 7 };

static inline float pixel_at(PIXELS *pixels, const size_t place, const unsigned bytes) {
    PIXELS *const own = pixels + place * bytes;
    const unsigned low = own[0] | (unsigned)own[1] << 8 | (unsigned)own[2] << 16;
    return as_float(bytes == PIXEL_SHORT_BYTES ? low << PIXEL_LOST_DIGITS
                                               : low | (unsigned)own[3] << 24);
}

#endif
