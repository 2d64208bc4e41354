#include "samplers/darts/radius.h"

#include "samplers/darts/torus_grid.h"

#include <math.h>
#include <stdint.h>

/* N r^d of random balls at saturation: of disks whose radius is r/2 they cover 0.54707, of balls
 * 0.38413 (G. Zhang, S. Torquato, "Precise algorithm to generate random sequential addition of hard
 * hyperspheres at saturation", 2013). Measured over 1500 sets of 4096 points and 30 of 16384:
 * 0.6966 and 0.7338. */
static const double SATURATED[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 0.69656, 0.73364, 0};

/* N r^d of the densest packings, rounded up: hexagonal, face-centred cubic, and in four dimensions
 * the bound of H. Cohn and N. Elkies (2003). */
static const double PACKED[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 1.15471, 1.41422, 2.1003};

/* N r^d of Bridson's points after so many tries, means of 60 sets of 4096 points, with standard
 * errors of 0.0003 to 0.0007 (bench_blue_noise means); after 30 tries of sets of 16384. */
typedef struct filled {
    unsigned tries;
    double products[PS_GRID_MOST_DIMENSION + 1];
} filled;
static const filled FILLED[] = {
    {2, {0, 0, 0.4347, 0.3615, 0.3237}},    {3, {0, 0, 0.4941, 0.4113, 0.3760}},
    {5, {0, 0, 0.5350, 0.4616, 0.4307}},    {10, {0, 0, 0.5735, 0.5143, 0.4929}},
    {20, {0, 0, 0.6018, 0.5556, 0.5439}},   {30, {0, 0, 0.6151, 0.5758, 0.5700}},
    {50, {0, 0, 0.6298, 0.5980, 0.5977}},   {100, {0, 0, 0.6472, 0.6241, 0.6318}},
    {200, {0, 0, 0.6622, 0.6458, 0.6620}},  {400, {0, 0, 0.6734, 0.6628, 0.6879}},
    {1000, {0, 0, 0.6848, 0.6828, 0.7168}},
};
enum { NUM_FILLED = sizeof FILLED / sizeof FILLED[0] };

static double power(double x, unsigned exponent) {
    double product = 1;
    for (unsigned i = 0; i < exponent; i++) {
        product *= x;
    }
    return product;
}

static double largest(unsigned dimension) {
    return sqrt(dimension) / 2;
}

/* x^(1/d) for x in (0,1] by Newton's method from above: unlike pow(), the same bits on any machine.
 * At first a step takes the share 1/d away, so 200 reach any x that a number of points makes. */
static double root(double x, unsigned dimension) {
    enum { STEPS = 200 };
    double y = 1;
    for (unsigned i = 0; i < STEPS; i++) {
        y -= (y - x / power(y, dimension - 1)) / dimension;
    }
    return y;
}

pspec_status ps_torus_radius_check(unsigned dimension, double radius, ps_error *error) {
    if (radius > 0 && radius <= largest(dimension)) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "radius %g is not above 0 and at most %g, which is the farthest that points of "
                   "the torus in %u dimensions are apart",
                   radius, largest(dimension), dimension);
}

size_t ps_torus_radius_most_points(unsigned dimension, double radius) {
    const double most = PACKED[dimension] / power(radius, dimension);
    const double possible = 0x1p32; /* a grid has no more */
    return most < possible ? (size_t)most : SIZE_MAX;
}

/* The radius at which num_points make N r^d = product. */
static double radius_of(unsigned dimension, double product, size_t num_points) {
    const double radius = root(product / (double)num_points, dimension);
    return radius < largest(dimension) ? radius : largest(dimension);
}

double ps_poisson_disk_radius(unsigned dimension, size_t num_points) {
    return radius_of(dimension, SATURATED[dimension], num_points);
}

double ps_poisson_disk_expected(unsigned dimension, double radius) {
    return SATURATED[dimension] / power(radius, dimension);
}

/* ---- Bridson ------------------------------------------------------------------------------- */

pspec_status ps_bridson_tries_check(unsigned tries, ps_error *error) {
    if (tries >= PS_LEAST_TRIES && tries <= PS_MOST_TRIES) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%u tries are not between %d and %d", tries,
                   PS_LEAST_TRIES, PS_MOST_TRIES);
}

/* Between tries that were measured it is nearly straight in 1/sqrt(tries). */
static double filled_product(unsigned dimension, unsigned tries) {
    unsigned i = 0;
    while (i < NUM_FILLED - 2 && FILLED[i + 1].tries < tries) {
        i++;
    }
    const double from = 1 / sqrt(FILLED[i].tries);
    const double to = 1 / sqrt(FILLED[i + 1].tries);
    const double share = (1 / sqrt(tries) - from) / (to - from);
    return FILLED[i].products[dimension] +
           share * (FILLED[i + 1].products[dimension] - FILLED[i].products[dimension]);
}

double ps_bridson_radius(unsigned dimension, unsigned tries, size_t num_points) {
    return radius_of(dimension, filled_product(dimension, tries), num_points);
}

double ps_bridson_expected(unsigned dimension, double radius, unsigned tries) {
    return filled_product(dimension, tries) / power(radius, dimension);
}
