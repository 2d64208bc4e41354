#include "samplers/torus/radical_inverse.h"

static inline double mirror(uint64_t base, uint64_t index) {
    uint64_t numerator = 0;
    uint64_t denominator = 1;
    for (; index > 0; index /= base) {
        numerator = numerator * base + index % base;
        denominator *= base;
    }
    return (double)numerator / (double)denominator;
}

double ps_radical_inverse(unsigned i_prime, uint64_t index) {
    /* Not a table of bases: a base known to the compiler turns divisions into multiplications. */
    switch (i_prime) {
    case 0:
        return mirror(2, index);
    case 1:
        return mirror(3, index);
    case 2:
        return mirror(5, index);
    case 3:
        return mirror(7, index);
    case 4:
        return mirror(11, index);
    default:
        return mirror(13, index);
    }
}
