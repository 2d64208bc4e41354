/* The referee goes from order to order at a fixed degree, where the device engines go from degree
 * to degree at a fixed order: two recurrences that share no step. With Lambda_m = N_lm P_l^m(cos
 * theta),
 *
 *     sqrt((l + m)(l - m + 1)) Lambda_{m-1} = -2 m cot(theta) Lambda_m - sqrt((l - m)(l + m + 1)) Lambda_{m+1}
 *
 * is stable downwards. It begins with 1 instead of sin^l(theta), which underflows, and is
 * normalised by the addition theorem, Lambda_0^2 + 2 sum_{m > 0} Lambda_m^2 = (2l + 1) / (4 pi)
 * (docs/mathematics/sphere.md#harmonics, docs/mathematics/numerics.md#high-order).
 */
#include "engines/host/host_direct.h"

#include "base/memory.h"
#include "math/pi.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Above 2^this, values are scaled down by as much: half of the exponents there are. */
enum { LARGEST_EXPONENT = LDBL_MAX_EXP / 2 };

pspec_status ps_host_degree_create(ps_host_degree *out, int32_t degree, ps_error *error) {
    const size_t num = (size_t)degree + 1;
    enum { NUM_ARRAYS = 5 };
    *out = (ps_host_degree){.degree = degree};
    PS_TRY(PS_NEW(&out->up, NUM_ARRAYS * num, "a degree", error));
    out->down = out->up + num;
    out->values = out->down + num;
    out->sums = (long double(*)[2])(out->values + num);
    for (int64_t m = 1; m <= degree; m++) {
        out->up[m] = sqrtl((long double)((degree - m) * (degree + m + 1)));
        out->down[m] = sqrtl((long double)((degree + m) * (degree - m + 1)));
    }
    return PSPEC_OK;
}

void ps_host_degree_free(ps_host_degree *self) {
    free(self->up);
    *self = (ps_host_degree){0};
}

static void scale_values(ps_host_degree *self, int32_t first, long double factor) {
    for (int32_t m = first; m <= self->degree; m++) {
        self->values[m] *= factor;
    }
}

/* Lambda_lm of the direction of u, up to a factor. */
static void recur(ps_host_degree *self, long double cotangent) {
    const long double largest = ldexpl(1, LARGEST_EXPONENT);
    const int32_t l = self->degree;
    long double above = 0;
    self->values[l] = l % 2 == 0 ? 1 : -1; /* the Condon-Shortley phase */
    for (int32_t m = l; m >= 1; m--) {
        const long double here = self->values[m];
        const long double next = -(2 * m * cotangent * here + self->up[m] * above) / self->down[m];
        self->values[m - 1] = next;
        above = here;
        if (fabsl(next) > largest) {
            scale_values(self, m - 1, 1 / largest);
            above /= largest;
        }
    }
}

static void normalize(ps_host_degree *self) {
    const int32_t l = self->degree;
    long double largest = 0;
    for (int32_t m = 0; m <= l; m++) {
        largest = fabsl(self->values[m]) > largest ? fabsl(self->values[m]) : largest;
    }
    scale_values(self, 0, 1 / largest); /* squares do not overflow then */
    long double sum = self->values[0] * self->values[0];
    for (int32_t m = 1; m <= l; m++) {
        sum += 2 * self->values[m] * self->values[m];
    }
    scale_values(self, 0, sqrtl((2 * l + 1) / PS_FOUR_PI_L / sum));
}

static void evaluate(ps_host_degree *self, long double z, long double rho) {
    if (rho == 0) { /* a pole */
        for (int32_t m = 1; m <= self->degree; m++) {
            self->values[m] = 0;
        }
        self->values[0] = sqrtl((2 * self->degree + 1) / PS_FOUR_PI_L) *
                          (z < 0 && self->degree % 2 != 0 ? -1 : 1);
        return;
    }
    recur(self, z / rho);
    normalize(self);
}

static void add_point(ps_host_degree *self, const double *u, long double weight) {
    const long double rho = hypotl(u[0], u[1]);
    const long double cosine = rho > 0 ? u[0] / rho : 1;
    const long double sine = rho > 0 ? u[1] / rho : 0;
    long double re = weight;
    long double im = 0;
    evaluate(self, u[2], rho);
    for (int32_t m = 0; m <= self->degree; m++) {
        self->sums[m][0] += self->values[m] * re;
        self->sums[m][1] += self->values[m] * im;
        const long double turned = re * cosine - im * sine;
        im = re * sine + im * cosine;
        re = turned;
    }
}

void ps_host_degree_sum(ps_host_degree *self, const pspec_pattern *pattern) {
    for (int32_t m = 0; m <= self->degree; m++) {
        self->sums[m][0] = self->sums[m][1] = 0;
    }
    for (size_t j = 0; j < pattern->num_points; j++) {
        add_point(self, pattern->points + j * PS_SPHERE_DIMENSION,
                  pattern->weights != NULL ? pattern->weights[j] : 1);
    }
}

long double ps_host_degree_power(const ps_host_degree *self) {
    long double sum = self->sums[0][0] * self->sums[0][0];
    for (int32_t m = 1; m <= self->degree; m++) {
        sum += 2 * (self->sums[m][0] * self->sums[m][0] + self->sums[m][1] * self->sums[m][1]);
    }
    return PS_FOUR_PI_L / (2 * self->degree + 1) * sum;
}
