/* Samplers without a formula: the powers and distances that their sets have, one law over a table.
 * A row has what others found or a prototype made, with three standard errors of a mean over the
 * ring, 1 / sqrt(frequencies * sets), and what digits of the number leave open. */
#include "test_samplers.h"

#include "math/pi.h"

#include <math.h>
#include <string.h>

enum { MOST_RINGS = 16, PLANE = 2, VECTOR = 3 };

/* Mean power over low <= |k| / sqrt(N) < high, on the sphere of degrees l, of the first sets;
 * most 0: no limit. */
typedef struct ring {
    double low, high, least, most;
    unsigned num_sets;
} ring;

typedef struct row {
    const char *text;
    size_t num_points;
    unsigned num_sets, num_measured; /* distances are those of so many */
    double least[2];                 /* distance of a set, hexagonal packing's being 1 */
    double nearest[2];               /* mean distance to the nearest neighbour */
    double exponent[2]; /* from one of the last two rings to the other; {0}: not known */
    unsigned peak_ring; /* the one of largest power; 0: not asked */
    ring rings[MOST_RINGS];
} row;

/* Mean power over frequencies of one sign each. */
static double plane_power(const double *points, size_t num, double low, double high) {
    double sum = 0;
    double count = 0;
    for (int kx = 0; kx < high; kx++) {
        for (int ky = kx == 0 ? 1 : (int)-high; ky < high; ky++) {
            if (hypot(kx, ky) >= low && hypot(kx, ky) < high) {
                double c = 0;
                double s = 0;
                for (size_t i = 0; i < num; i++) {
                    const double phase = kx * points[2 * i] + ky * points[2 * i + 1];
                    c += cos(PS_TWO_PI * phase);
                    s += sin(PS_TWO_PI * phase);
                }
                sum += (c * c + s * s) / (double)num;
                count++;
            }
        }
    }
    return sum / count;
}

/* Mean of (1/N) sum over pairs of P_l(u.v), each degree by its 2l + 1 numbers. */
static double sphere_power(const double *points, size_t num, double low, double high) {
    double sum = 0;
    double weights = 0;
    for (int l = (int)ceil(low); l < high; l++) {
        weights += 2 * l + 1;
    }
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j <= i; j++) {
            const double *const u = points + VECTOR * i;
            const double *const v = points + VECTOR * j;
            const double z = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
            double before = 0;
            double now = 1;
            for (int l = 0; l < high; l++) {
                sum += l >= low ? (i == j ? 1 : 2) * (2 * l + 1) * now : 0;
                const double next = ((2 * l + 1) * z * now - l * before) / (l + 1);
                before = now;
                now = next;
            }
        }
    }
    return sum / weights / (double)num;
}

static double plane_distance(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    return hypot(x - rint(x), y - rint(y));
}

static double sphere_distance(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    const double z = u[2] - v[2];
    return 2 * asin(fmin(1, sqrt(x * x + y * y + z * z) / 2));
}

static const struct space {
    unsigned dimension;
    double area;
    double (*power)(const double *points, size_t num, double low, double high);
    double (*distance)(const double *u, const double *v);
} plane = {PLANE, 1, plane_power, plane_distance},
  sphere = {VECTOR, 2 * PS_TWO_PI, sphere_power, sphere_distance};

static void assert_between(const row *self, const char *what, double low, double value,
                           const double limits[2]) {
    if (!(value >= limits[0] && value <= limits[1])) {
        fail_msg("%s: %s %g: %g is not between %g and %g", self->text, what, low, value, limits[0],
                 limits[1]);
    }
}

/* Returns the mean distance to the nearest neighbour; the unit is that of the number asked for. */
static double look_at_distances(const row *self, const struct space *space, const double *points,
                                size_t num) {
    const double hexagonal = sqrt(2 * space->area / (sqrt(3) * (double)self->num_points));
    double least = HUGE_VAL;
    double mean = 0;
    for (size_t i = 0; i < num; i++) {
        double nearest = HUGE_VAL;
        for (size_t j = 0; j < num; j++) {
            if (j != i) {
                const double d =
                    space->distance(points + i * space->dimension, points + j * space->dimension);
                nearest = fmin(nearest, d);
            }
        }
        least = fmin(least, nearest);
        mean += nearest / hexagonal / (double)num;
    }
    assert_between(self, "least distance", 0, least / hexagonal, self->least);
    return mean;
}

static void add_set(const row *self, const struct space *space, unsigned r, const double *points,
                    size_t num, double *powers) {
    const double unit = sqrt((double)self->num_points);
    for (unsigned k = 0; k < MOST_RINGS && self->rings[k].high > 0; k++) {
        const ring *const one = &self->rings[k];
        if (r < one->num_sets) {
            powers[k] +=
                space->power(points, num, one->low * unit, one->high * unit) / one->num_sets;
        }
    }
}

static void look_at_powers(const row *self, const double *powers) {
    unsigned num = 0;
    double peak = 0;
    for (; num < MOST_RINGS && self->rings[num].high > 0; num++) {
        const ring *const one = &self->rings[num];
        const double limits[] = {one->least, one->most > 0 ? one->most : HUGE_VAL};
        assert_between(self, "power from nu =", one->low, powers[num], limits);
        peak = fmax(peak, powers[num]);
    }
    if (self->exponent[1] > 0) {
        const ring *const a = &self->rings[num - 2];
        const ring *const b = &self->rings[num - 1];
        const double exponent =
            log(powers[num - 1] / powers[num - 2]) / log((b->low + b->high) / (a->low + a->high));
        assert_between(self, "exponent from nu =", a->low, exponent, self->exponent);
    }
    if (self->peak_ring > 0) {
        assert_true(powers[self->peak_ring] == peak);
    }
}

static void assert_row(const row *self, const struct space *space) {
    double powers[MOST_RINGS] = {0};
    double nearest = 0;
    const ps_sampler_request request = make_request(self->text, self->num_points, space->dimension);
    double *const points =
        malloc(ps_sampler_most_points(&request) * space->dimension * sizeof *points);
    assert_non_null(points);
    for (unsigned r = 0; r < self->num_sets; r++) {
        size_t num = 0;
        ps_error error = {0};
        if (ps_sampler_generate(&request, r, points, &num, NULL, &error) != PSPEC_OK) {
            fail_msg("%s", error.message);
        }
        if (r < self->num_measured) {
            nearest += look_at_distances(self, space, points, num) / self->num_measured;
        }
        add_set(self, space, r, points, num, powers);
    }
    assert_between(self, "mean distance", 0, nearest, self->nearest);
    look_at_powers(self, powers);
    free(points);
}

static const row planes[] = {
    /* of thirty tries */
    {"bridson",
     1024,
     300,
     16,
     {0.7285, 0.735},
     {0.785, 0.800},
     {0},
     0,
     {{0.06, 0.10, 0.065, 0.077, 300},
      {1.04, 1.08, 1, 1.50, 20},
      {1.08, 1.12, 1.42, 1.50, 20},
      {1.12, 1.16, 1, 1.50, 20},
      {1.16, 1.20, 1, 1.50, 20}}},
    /* of saturated disks */
    {"poisson-disk",
     1024,
     300,
     16,
     {0.7765, 0.783},
     {0.8167, 0.8207},
     {0},
     0,
     {{0.06, 0.10, 0.054, 0.064, 300},
      {1.08, 1.12, 1, 1.80, 20},
      {1.12, 1.16, 1.70, 1.80, 20},
      {1.16, 1.20, 1, 1.80, 20}}},
    {"bnot",
     1024,
     20,
     20,
     {0.68, 0.79},
     {0.868, 0.872},
     {4.2, 4.6},
     3,
     {{0.08, 0.12, 0.67e-5, 1.33e-5, 20},
      {0.96, 1.00, 0, 0, 20},
      {1.00, 1.04, 0, 0, 20},
      {1.04, 1.08, 2.74, 2.94, 20},
      {1.08, 1.12, 0, 0, 20},
      {1.12, 1.16, 0, 0, 20},
      {0.24, 0.28, 3.65e-4, 5.75e-4, 20},
      {0.48, 0.52, 6.9e-3, 9.9e-3, 20}}},
    {"fpo",
     1024,
     5,
     5,
     {0.925, 0.935},
     {0.929, 0.935},
     {0},
     8,
     {{0.08, 0.12, 0.006, 0.011, 5},
      {0.12, 0.16, 0.006, 0.011, 5},
      {0.16, 0.20, 0.006, 0.011, 5},
      {0.20, 0.24, 0.006, 0.011, 5},
      {0.24, 0.28, 0.006, 0.011, 5},
      {0.48, 0.52, 0.019, 0.025, 5},
      {1.00, 1.04, 0, 0, 5},
      {1.04, 1.08, 0, 0, 5},
      {1.08, 1.12, 3.5, 3.9, 5},
      {1.12, 1.16, 0, 0, 5},
      {1.16, 1.20, 0, 0, 5}}},
    {"ccvt:M=256",
     1024,
     6,
     0,
     {0},
     {0},
     {3.6, 5},
     0,
     {{0.48, 0.52, 0.0106, 0.0160, 6},
      {1.04, 1.08, 1.80, 2.30, 6},
      {0.09, 0.16, 1.2e-5, 5e-5, 6},
      {0.234, 0.266, 3.8e-4, 7.0e-4, 6}}},
    /* emptier at low frequencies than BNOT; docs/samplers/forces.md has 20 sets of 1024 points */
    {"gaussian-blue-noise",
     256,
     4,
     4,
     {0.1, 1},
     {0.79, 0.84},
     {0},
     0,
     {{0.08, 0.12, 0, 1e-7, 4},
      {0.24, 0.28, 0, 1e-6, 4},
      {0.48, 0.52, 0, 8e-4, 4},
      {1.12, 1.16, 1.5, 0, 4}}},
    {"step",
     256,
     4,
     0,
     {0},
     {0},
     {0},
     0,
     {{0.16, 0.32, 0, 0.01, 4},
      {0.32, 0.48, 0, 0.01, 4},
      {0.60, 0.64, 0.8, 0, 4},
      {0.64, 0.72, 0.7, 1.3, 4},
      {0.72, 0.80, 0.7, 1.3, 4},
      {0.80, 0.88, 0.7, 1.3, 4},
      {0.88, 0.96, 0.7, 1.3, 4},
      {0.96, 1.04, 0.7, 1.3, 4},
      {1.04, 1.12, 0.7, 1.3, 4}}},
};

/* Units are sqrt(256) = 16 degrees. */
static const row spheres[] = {
    /* of saturated disks */
    {"poisson-disk-sphere",
     256,
     60,
     0,
     {0},
     {0},
     {0},
     2,
     {{0.0625, 0.35, 0.047, 0.07, 60},
      {1.6, 1.7, 0, 0, 60},
      {1.95, 2.1, 1.65, 1.82, 60},
      {2.3, 2.4, 0, 0, 60}}},
    /* as l^4, without a floor: prototypes' few sets, with two digits */
    {"ccvt-sphere:M=64",
     256,
     60,
     60,
     {0.52, 0.78},
     {0.7, 0.9},
     {3.9, 4.4},
     0,
     {{0.06, 0.07, 0, 1e-6, 60},
      {0.12, 0.13, 0.55e-5, 1.25e-5, 60},
      {0.37, 0.38, 2.5e-4, 5.8e-4, 60},
      {0.25, 0.26, 0.6e-4, 1.4e-4, 60},
      {0.62, 0.63, 2.2e-3, 5.0e-3, 60}}},
};

static void planes_have_their_spectra(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++) {
        assert_row(&planes[i], &plane);
    }
}

static void spheres_have_their_spectra(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof spheres / sizeof spheres[0]; i++) {
        assert_row(&spheres[i], &sphere);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_have_their_spectra),
        cmocka_unit_test(spheres_have_their_spectra),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
