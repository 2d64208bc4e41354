#include "engines/sphere/sphere_layout.h"

#include "base/round.h"

#include <math.h>
#include <string.h>

/* Places in a block, as in kernels/sphere/layout.h. */
enum { KAPPA = 0, EPSILON = 8, RATIO = 16, FACTORS = 24 };

size_t ps_sphere_blocks(int32_t max_degree, int32_t m) {
    return m > max_degree ? 0
                          : (size_t)ps_divide_up((uint64_t)(max_degree - m) + 1, PS_SPHERE_DEGREES);
}

size_t ps_sphere_all_blocks(int32_t max_degree, int32_t first, size_t num, uint32_t *offsets) {
    size_t sum = 0;
    for (size_t i = 0; i < num; i++) {
        if (offsets != NULL) {
            offsets[i] = (uint32_t)sum;
        }
        sum += ps_sphere_blocks(max_degree, first + (int32_t)i);
    }
    return sum;
}

long double ps_sphere_next_constant(long double constant, int32_t m) {
    return -constant * sqrtl((2 * m + 1) / (2 * (long double)m));
}

/* A block from degree l_0 on: -kappa / epsilon, epsilon and constant G_l / G_{l_0}. */
static void fill_block(double *block, double l_0, double m, double constant) {
    double epsilon = 1;
    double growth = 1;
    memset(block, 0, PS_SPHERE_BLOCK_REALS * sizeof *block);
    for (int i = 1; i <= PS_SPHERE_DEGREES; i++) {
        const double l = l_0 + i;
        /* D_m = 0, so its factor at l = m + 1, which is 0, may be 1. */
        epsilon *= l == m + 1 ? 1 : (l - m - 1) / (l + m);
        block[KAPPA + i - 1] = -(2 * l - 1) / (l + m) / epsilon;
        block[EPSILON + i - 1] = epsilon;
        block[RATIO + i - 1] = constant * growth;
        growth *= sqrt((2 * l + 1) * (l + m) / ((2 * l - 1) * (l - m)));
    }
    block[FACTORS] = growth;
    block[FACTORS + 1] = growth * epsilon;
}

void ps_sphere_fill_order(double *blocks, int32_t max_degree, int32_t m, long double constant) {
    const size_t num = ps_sphere_blocks(max_degree, m);
    for (size_t b = 0; b < num; b++) {
        fill_block(blocks + b * PS_SPHERE_BLOCK_REALS, m + (double)b * PS_SPHERE_DEGREES, m,
                   (double)constant);
    }
}
