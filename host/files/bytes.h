/* Whole numbers in binary files, the lowest byte first. For host/files and host/points. */
#ifndef PS_FILES_BYTES_H
#define PS_FILES_BYTES_H

#include <stdint.h>

/* The number that the first num_bytes of bytes are, at most eight. */
static inline uint64_t ps_bytes_number(const void *bytes, unsigned num_bytes) {
    const unsigned char *const byte = bytes;
    uint64_t value = 0;
    while (num_bytes > 0) {
        value = value << 8 | byte[--num_bytes];
    }
    return value;
}

static inline void ps_bytes_put(void *bytes, uint64_t value, unsigned num_bytes) {
    unsigned char *const byte = bytes;
    for (unsigned i = 0; i < num_bytes; i++, value >>= 8) {
        byte[i] = (unsigned char)(value & 0xff);
    }
}

#endif
