/* Whole multiples. */
#ifndef PS_BASE_ROUND_H
#define PS_BASE_ROUND_H

#include <stdint.h>

/* Groups of b that hold a. a + b must not overflow. */
static inline uint64_t ps_divide_up(uint64_t a, uint64_t b) {
    return (a + b - 1) / b;
}

/* The smallest multiple of unit from a on. */
static inline uint64_t ps_round_up(uint64_t a, uint64_t unit) {
    return ps_divide_up(a, unit) * unit;
}

#endif
