#include "engines/pairs/pairs_zonal.h"

#include <math.h>
#include <string.h>

/* Points side by side, which compilers make vectors of. */
enum { LANES = 8 };

size_t ps_zonal_scratch(int32_t max_degree) {
    return LANES * ((size_t)max_degree + 1);
}

typedef struct lanes {
    double t[LANES], side[LANES], p[LANES], e[LANES];
} lanes;

/* Points first .. first + LANES - 1; behind the last, poles of weight 0. t = 1 - |cos theta|
 * without cancellation. */
static void begin(lanes *at, const pspec_pattern *pattern, size_t first, int exponent) {
    *at = (lanes){0};
    for (size_t i = 0; i < LANES && first + i < pattern->num_points; i++) {
        const double *u = pattern->points + 3 * (first + i);
        const double flat = u[0] * u[0] + u[1] * u[1];
        const double length = sqrt(flat + u[2] * u[2]);
        at->t[i] = flat / (length * (length + fabs(u[2])));
        at->side[i] = u[2] < 0 ? -1 : 1;
        at->p[i] = ldexp(pattern->weights != NULL ? pattern->weights[first + i] : 1, -exponent);
    }
}

static void add_degrees(lanes *at, int32_t max_degree, double *sums) {
    for (int32_t l = 1; l <= max_degree; l++) {
        const double odd = 2 * l - 1;
        const double inverse = 1.0 / l;
        double *to = sums + (size_t)l * LANES;
        for (int i = 0; i < LANES; i++) {
            at->e[i] -= odd * at->t[i] * at->p[i];
            at->p[i] += inverse * at->e[i];
            to[i] += (l % 2 != 0 ? at->side[i] : 1) * at->p[i];
        }
    }
}

void ps_zonal_sums(const pspec_pattern *pattern, int exponent, int32_t max_degree, double *scratch,
                   double *out) {
    memset(scratch, 0, ps_zonal_scratch(max_degree) * sizeof *scratch);
    for (size_t first = 0; first < pattern->num_points; first += LANES) {
        lanes at;
        begin(&at, pattern, first, exponent);
        for (int i = 0; i < LANES; i++) {
            scratch[i] += at.p[i];
        }
        add_degrees(&at, max_degree, scratch);
    }
    for (size_t l = 0; l <= (size_t)max_degree; l++) {
        double sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += scratch[l * LANES + (size_t)i];
        }
        out[l] = sum;
    }
}
