/* Integrals of a map over the sphere: along a circle of latitude F is piecewise linear, of which
 * everything is known; from circle to circle they are Gauss-Legendre sums
 * (docs/mathematics/maps.md). */
#include "images/sphere_map.h"

#include "base/memory.h"
#include "base/workers.h"
#include "math/gauss_legendre.h"
#include "math/gsl/fourier.h"
#include "math/neumaier.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- circles of latitude ----------------------------------------------------------------- */

/* A circle of z > 0 between two rows of the map, which F is (1 - share) and share of, and the one
 * of -z, which is between their mirror images. */
typedef struct circle {
    size_t row; /* the other one is the next */
    double share;
    long double z, sine;
    double weight; /* of an integral over theta, sin theta included */
} circle;

typedef struct circle_list {
    circle *all; /* [num] */
    size_t num;
} circle_list;

/* Where row `row` of the map, 0 and height + 1 the poles, is. */
static long double angle_of(const ps_sphere_map *map, size_t row) {
    return row == 0 ? 0
           : row == map->height + 1
               ? PS_PI_L
               : PS_PI_L * ((long double)row - 0.5L) / (long double)map->height;
}

/* Harmonics of degree L are like cosines of L theta: Gauss sums of num nodes are right to rounding
 * for up to some num radians between two rows (test_maps). */
static size_t nodes_between(const ps_sphere_map *map, size_t max_degree) {
    const double radians = PS_PI / (double)map->height * ((double)max_degree + 2) / 2;
    return 8 + (size_t)ceil(radians);
}

static pspec_status make_circles(circle_list *out, const ps_sphere_map *map, size_t max_degree,
                                 ps_error *error) {
    const size_t num = nodes_between(map, max_degree);
    const size_t num_rows = map->height / 2 + 1; /* begin above the horizon */
    double *nodes = NULL;
    size_t room = 0;
    PS_TRY(PS_NEW(&nodes, 2 * num, "nodes", error));
    ps_gauss_legendre(num, nodes, nodes + num);
    room = ps_size_multiply(num, num_rows, &room) ? room : SIZE_MAX;
    const pspec_status status = PS_NEW(&out->all, room, "circles of a map", error);
    for (size_t row = 0; status == PSPEC_OK && row < num_rows; row++) {
        const long double begin = angle_of(map, row);
        const long double whole = angle_of(map, row + 1) - begin;
        const long double length = fminl(whole, PS_PI_L / 2 - begin);
        for (size_t i = 0; i < num; i++) {
            const long double theta = begin + length * nodes[i];
            circle *const one = &out->all[out->num++];
            *one = (circle){row, (double)(length * nodes[i] / whole), cosl(theta), sinl(theta), 0};
            one->weight = (double)(nodes[num + i] * length * one->sine);
        }
    }
    free(nodes);
    return status;
}

/* Where the first and the second row of a circle are, or those of its mirror image. */
static void rows_of(const ps_sphere_map *map, const circle *at, bool is_lower, size_t rows[2]) {
    for (size_t i = 0; i < 2; i++) {
        rows[i] = is_lower ? map->height + 1 - (at->row + i) : at->row + i;
    }
}

/* ---- moments ----------------------------------------------------------------------------- */

static double mean_of(const double *row, size_t width) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < width; j++) {
        ps_neumaier_add(&sum, row[j]);
    }
    return ps_neumaier_value(&sum) / (double)width;
}

/* The mean over a circle of the product of two rows less a number, each linear between pixels. */
static double mean_product(const double *a, const double *b, size_t width, double less) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < width; j++) {
        const size_t next = j + 1 < width ? j + 1 : 0;
        const double own = (a[j] - less) * (b[j] - less);
        const double crossed = (a[j] - less) * (b[next] - less) + (a[next] - less) * (b[j] - less);
        ps_neumaier_add(&sum, (4 * own + crossed) / 6);
    }
    return ps_neumaier_value(&sum) / (double)width;
}

/* What a mean over circles needs of two rows: means, or means of products. */
typedef struct row_pair {
    double mean[2], square[2], product;
} row_pair;

static row_pair make_pair(const ps_sphere_map *map, const size_t rows[2], const double *less) {
    const double *const a = map->rows + rows[0] * map->width;
    const double *const b = map->rows + rows[1] * map->width;
    if (less == NULL) {
        return (row_pair){.mean = {mean_of(a, map->width), mean_of(b, map->width)}};
    }
    return (row_pair){
        .square = {mean_product(a, a, map->width, *less), mean_product(b, b, map->width, *less)},
        .product = mean_product(a, b, map->width, *less)};
}

/* int F, or int (F - *less)^2, of one half of the sphere. */
static double integrate(const ps_sphere_map *map, const circle_list *circles, bool is_lower,
                        const double *less) {
    ps_neumaier sum = {0, 0};
    row_pair pair = {.product = 0};
    for (size_t i = 0; i < circles->num; i++) {
        const circle *const own = &circles->all[i];
        const double t = own->share;
        size_t rows[2];
        rows_of(map, own, is_lower, rows);
        if (i == 0 || own->row != own[-1].row) {
            pair = make_pair(map, rows, less);
        }
        const double mean = (1 - t) * pair.mean[0] + t * pair.mean[1];
        const double square =
            (1 - t) * ((1 - t) * pair.square[0] + 2 * t * pair.product) + t * t * pair.square[1];
        ps_neumaier_add(&sum, own->weight * (less == NULL ? mean : square));
    }
    return PS_TWO_PI * ps_neumaier_value(&sum);
}

pspec_status ps_sphere_map_moments(ps_map_moments *out, const ps_sphere_map *map, bool only_upper,
                                   ps_error *error) {
    circle_list circles = {NULL, 0};
    const double area = only_upper ? PS_TWO_PI : PS_FOUR_PI;
    const pspec_status status = make_circles(&circles, map, 0, error);
    *out = (ps_map_moments){0, 0};
    for (int half = 0; half < (only_upper ? 1 : 2) && status == PSPEC_OK; half++) {
        out->integral += integrate(map, &circles, half == 1, NULL);
    }
    const double mean = out->integral / area;
    for (int half = 0; half < (only_upper ? 1 : 2) && status == PSPEC_OK; half++) {
        out->deviation += integrate(map, &circles, half == 1, &mean);
    }
    free(circles.all);
    return status;
}

/* ---- coefficients ------------------------------------------------------------------------ */

/* Circles that are worked on side by side: none waits for what another one's product takes. */
enum { LANES = 8 };

enum { EVEN, ODD, RE = 0, IM };

typedef struct transform {
    const ps_sphere_map *map;
    const circle_list *circles;
    bool only_upper;
    size_t max_degree;
    double *spectra; /* [height + 2][max_degree + 1][re, im]: int F e^{-i m phi} of the rows */
    double *scratch; /* [PS_WORKERS_MOST][room_of_worker] */
    double *out;
} transform;

/* Factors of the recurrence, and sums of every degree and lane. */
static size_t room_of_worker(size_t max_degree) {
    return (2 + 2 * LANES) * (max_degree + 1);
}

/* Of a function that is linear between its values at phi_j = 2 pi (j + 1/2)/W. */
static pspec_status find_spectra(transform *self, ps_error *error) {
    const size_t width = self->map->width;
    double *line = NULL;
    PS_TRY(PS_NEW(&line, 2 * width, "a row of a map", error));
    pspec_status status = PSPEC_OK;
    for (size_t row = 0; row < self->map->height + 2 && status == PSPEC_OK; row++) {
        double *const out = self->spectra + 2 * row * (self->max_degree + 1);
        for (size_t j = 0; j < width; j++) {
            line[2 * j] = self->map->rows[row * width + j];
            line[2 * j + 1] = 0;
        }
        status = ps_fourier_lines(line, width, 1, error);
        for (size_t m = 0; m <= self->max_degree; m++) {
            const double half = PS_PI * (double)m / (double)width;
            const double rest = PS_PI * (double)(m % (2 * width)) / (double)width;
            const double sinc = m == 0 ? 1 : m % width == 0 ? 0 : sin(rest) / half;
            const double scale = PS_TWO_PI / (double)width * sinc * sinc;
            const double *const own = line + 2 * (m % width);
            out[2 * m] = scale * (own[0] * cos(rest) + own[1] * sin(rest));
            out[2 * m + 1] = scale * (own[1] * cos(rest) - own[0] * sin(rest));
        }
    }
    free(line);
    return status;
}

/* q_lm = a (z q_(l-1)m - b q_(l-2)m), and q_mm = top sin^m: docs/mathematics/sphere.md. */
static long double fill_factors(double *a, double *b, size_t m, size_t max_degree) {
    const long double order = (long double)m;
    long double top = 1 / sqrtl(PS_FOUR_PI_L);
    for (size_t l = m + 1; l <= max_degree; l++) {
        const long double d = (long double)l;
        const long double below = (d - 1) * (d - 1);
        a[l] = (double)sqrtl((4 * d * d - 1) / ((d - order) * (d + order)));
        b[l] = (double)sqrtl((below - order * order) / (4 * below - 1));
    }
    for (size_t i = 1; i <= m; i++) {
        top *= -sqrtl((2 * (long double)i + 1) / (2 * (long double)i));
    }
    return top;
}

/* Circles of one order. sin^m may be far below the smallest double: values are 2^(512 scale) times
 * what stands here, and count when scale is 0. */
typedef struct lanes {
    double z[LANES], value[LANES], before[LANES];
    int scale[LANES];
    double parts[2][2][LANES]; /* [EVEN, ODD of l - m][RE, IM]: what F has of it */
} lanes;

static const double scale_up = 0x1p512;
/* A value is brought down where it is above that; until the next look it grows by less than 2^100.
 */
static const double scale_border = 0x1p256;
enum { DEGREES_BETWEEN_LOOKS = 16 };

static void begin_lane(const transform *self, lanes *out, size_t lane, const circle *at, size_t m,
                       long double top) {
    const size_t num = self->max_degree + 1;
    long double value = top * powl(at->sine, (long double)m);
    out->z[lane] = (double)at->z;
    out->scale[lane] = 0;
    while (value != 0 && fabsl(value) < 1 / (long double)scale_up) {
        value *= scale_up;
        out->scale[lane]--;
    }
    out->value[lane] = (double)value;
    for (int half = 0; half < (self->only_upper ? 1 : 2); half++) {
        size_t rows[2];
        rows_of(self->map, at, half == 1, rows);
        const double *const first = self->spectra + 2 * (rows[0] * num + m);
        const double *const second = self->spectra + 2 * (rows[1] * num + m);
        for (int i = RE; i <= IM; i++) {
            const double own = at->weight * ((1 - at->share) * first[i] + at->share * second[i]);
            out->parts[EVEN][i][lane] += own;
            out->parts[ODD][i][lane] += half == 1 ? -own : own; /* P_lm(-z) = (-1)^(l-m) P_lm(z) */
        }
    }
}

static bool rescale(lanes *self) {
    bool counts = false;
    for (size_t i = 0; i < LANES; i++) {
        if (self->scale[i] < 0 && fabs(self->value[i]) > scale_border) {
            self->value[i] /= scale_up;
            self->before[i] /= scale_up;
            self->scale[i]++;
        }
        counts = counts || self->scale[i] == 0;
    }
    return counts;
}

static void add_degree(double *sums, const lanes *self, size_t parity) {
    for (size_t i = 0; i < LANES; i++) {
        const double value = self->scale[i] == 0 ? self->value[i] : 0;
        sums[i] += self->parts[parity][RE][i] * value;
        sums[LANES + i] += self->parts[parity][IM][i] * value;
    }
}

/* Adds what the circles have of order m to the sums of every degree. */
static void add_lanes(lanes *self, const double *a, const double *b, size_t m, size_t num,
                      double *sums) {
    bool counts = rescale(self);
    for (size_t l = m; l < num; l++) {
        for (size_t i = 0; l > m && i < LANES; i++) {
            const double above = a[l] * (self->z[i] * self->value[i] - b[l] * self->before[i]);
            self->before[i] = self->value[i];
            self->value[i] = above;
        }
        if (l % DEGREES_BETWEEN_LOOKS == 0) {
            counts = rescale(self);
        }
        if (counts) {
            add_degree(sums + 2 * LANES * l, self, (l - m) % 2);
        }
    }
}

static void find_order(const transform *self, size_t m, double *scratch) {
    const size_t num = self->max_degree + 1;
    double *const a = scratch;
    double *const b = a + num;
    double *const sums = b + num;
    const long double top = fill_factors(a, b, m, self->max_degree);
    memset(sums, 0, 2 * LANES * num * sizeof *sums);
    for (size_t first = 0; first < self->circles->num; first += LANES) {
        lanes block = {.z = {0}};
        for (size_t i = 0; i < LANES && first + i < self->circles->num; i++) {
            begin_lane(self, &block, i, &self->circles->all[first + i], m, top);
        }
        add_lanes(&block, a, b, m, num, sums);
    }
    for (size_t l = m; l < num; l++) {
        double *const out = self->out + 2 * (m * (2 * num - 1 - m) / 2 + l);
        for (int part = RE; part <= IM; part++) {
            out[part] = 0;
            for (size_t i = 0; i < LANES; i++) {
                out[part] += sums[2 * LANES * l + LANES * (size_t)part + i];
            }
        }
    }
}

static void find_orders(void *payload, unsigned index, unsigned count) {
    const transform *const self = payload;
    for (size_t m = index; m <= self->max_degree; m += count) {
        find_order(self, m, self->scratch + index * room_of_worker(self->max_degree));
    }
}

pspec_status ps_sphere_map_coefficients(const ps_sphere_map *map, bool only_upper,
                                        size_t max_degree, double *out, ps_error *error) {
    const size_t num = max_degree + 1;
    circle_list circles = {NULL, 0};
    transform self = {.map = map,
                      .circles = &circles,
                      .only_upper = only_upper,
                      .max_degree = max_degree,
                      .out = out};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, make_circles(&circles, map, max_degree, error));
    PS_TRY_OUT(status,
               PS_NEW(&self.spectra, 2 * num * (map->height + 2), "spectra of rows", error));
    PS_TRY_OUT(status, PS_NEW(&self.scratch, PS_WORKERS_MOST * room_of_worker(max_degree),
                              "degrees of a map", error));
    PS_TRY_OUT(status, find_spectra(&self, error));
    ps_workers_share(circles.num * num * num, find_orders, &self);
out:
    free(circles.all);
    free(self.spectra);
    free(self.scratch);
    return status;
}
