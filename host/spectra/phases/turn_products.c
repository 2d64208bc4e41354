#include "spectra/phases/turn_products.h"

#include "base/memory.h"
#include "math/gauss_legendre.h"
#include "math/gsl/fourier.h"
#include "math/gsl/special.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Legendre functions stand degree by degree (ps_legendre_place), and so do inner arrays here what
 * belongs to them. */
struct ps_turn_products {
    size_t max_degree;
    size_t num_nodes, num_azimuths;
    double *nodes, *weights;     /* [num_nodes], of z = 2 node - 1 */
    double *functions;           /* of one node, as GSL has them */
    size_t num;                  /* doubles of the coefficients of a set */
    double *coefficients, *sums; /* [PS_TURN_SETS][number][2], and of f^2 */
    double *circle;              /* [num_azimuths][2] */
};

/* f^2 Y_lm has a degree and orders up to 2L. */
static size_t count_nodes(size_t max_degree) {
    return max_degree + 1;
}

double ps_turn_products_steps(int32_t max_degree) {
    const double degrees = (double)max_degree + 1;
    return (double)count_nodes((size_t)max_degree) * degrees * (degrees + 1) / 2;
}

pspec_status ps_turn_products_create(ps_turn_products **out, int32_t max_degree, ps_error *error) {
    const size_t degree = (size_t)max_degree;
    PS_TRY(PS_NEW(out, 1, "products of coefficients", error));
    ps_turn_products *const self = *out;
    self->max_degree = degree;
    self->num_nodes = count_nodes(degree);
    self->num_azimuths = 1;
    while (self->num_azimuths < 2 * degree + 1) {
        self->num_azimuths *= 2;
    }
    PS_TRY(PS_NEW(&self->nodes, 2 * self->num_nodes, "nodes in z", error));
    PS_TRY(PS_NEW(&self->functions, ps_legendre_room(degree), "Legendre functions", error));
    self->num = (degree + 1) * (degree + 2); /* pairs of l and m, twice */
    PS_TRY(PS_NEW(&self->coefficients, PS_TURN_SETS * self->num, "coefficients by degrees", error));
    PS_TRY(PS_NEW(&self->sums, PS_TURN_SETS * self->num, "coefficients by degrees", error));
    PS_TRY(PS_NEW(&self->circle, 2 * self->num_azimuths, "a circle of azimuths", error));
    self->weights = self->nodes + self->num_nodes;
    ps_gauss_legendre(self->num_nodes, self->nodes, self->weights);
    return PSPEC_OK;
}

void ps_turn_products_destroy(ps_turn_products *products) {
    if (products != NULL) {
        free(products->nodes);
        free(products->functions);
        free(products->coefficients);
        free(products->sums);
        free(products->circle);
        free(products);
    }
}

/* ---- one node ---------------------------------------------------------------------------- */

/* f is real: its order -m is the conjugate of its order m. */
static void sum_orders(ps_turn_products *self, const double *coefficients) {
    double *const circle = self->circle;
    memset(circle, 0, 2 * self->num_azimuths * sizeof *circle);
    for (size_t l = 1; l <= self->max_degree / 2; l++) {
        const size_t first = ps_legendre_place(l, 0);
        const double *const functions = self->functions + first;
        const double *const c = coefficients + 2 * first;
        for (size_t m = 0; m <= l; m++) {
            circle[2 * m] += functions[m] * c[2 * m];
            circle[2 * m + 1] -= functions[m] * c[2 * m + 1];
        }
    }
    for (size_t m = 1; m <= self->max_degree / 2; m++) {
        double *const opposite = circle + 2 * (self->num_azimuths - m);
        opposite[0] = circle[2 * m];
        opposite[1] = -circle[2 * m + 1];
    }
}

/* The orders of f become those of f^2, times the number of azimuths. */
static void square(ps_turn_products *self) {
    double *const circle = self->circle;
    const size_t num = self->num_azimuths;
    ps_fourier(circle, num, 1);
    for (size_t j = 0; j < num; j++) {
        circle[2 * j] *= circle[2 * j];
        circle[2 * j + 1] = 0;
    }
    ps_fourier(circle, num, -1);
}

/* Integrating with exp(i m phi) picks the order -m, the conjugate of m. */
static void add_node(const ps_turn_products *self, double weight, double *all_sums) {
    const double *const circle = self->circle;
    for (size_t l = 0; l <= self->max_degree; l++) {
        const size_t first = ps_legendre_place(l, 0);
        const double *const functions = self->functions + first;
        double *const sums = all_sums + 2 * first;
        for (size_t m = 0; m <= l; m++) {
            sums[2 * m] += weight * functions[m] * circle[2 * m];
            sums[2 * m + 1] -= weight * functions[m] * circle[2 * m + 1];
        }
    }
}

/* ---- one set ----------------------------------------------------------------------------- */

/* Between the layout of engines and that by degrees. */
static void reorder(const ps_turn_products *self, bool to_degrees, double *by_orders,
                    double *by_degrees) {
    const size_t last = self->max_degree;
    for (size_t m = 0; m <= last; m++) {
        for (size_t l = m; l <= last; l++) {
            double *const a = by_orders + 2 * (m * (2 * last + 1 - m) / 2 + l);
            double *const b = by_degrees + 2 * ps_legendre_place(l, m);
            memcpy(to_degrees ? b : a, to_degrees ? a : b, 2 * sizeof *a);
        }
    }
}

void ps_turn_products_run(ps_turn_products *self, size_t num_sets, const double *coefficients,
                          double *out) {
    const double sphere = 12.566370614359172954; /* 4 pi */
    memcpy(out, coefficients, num_sets * self->num * sizeof *out);
    memset(self->sums, 0, num_sets * self->num * sizeof *self->sums);
    for (size_t r = 0; r < num_sets; r++) {
        reorder(self, true, out + r * self->num, self->coefficients + r * self->num);
    }
    for (size_t i = 0; i < self->num_nodes; i++) {
        ps_legendre_functions(self->max_degree, 2 * self->nodes[i] - 1, self->functions);
        for (size_t r = 0; r < num_sets; r++) {
            sum_orders(self, self->coefficients + r * self->num);
            square(self);
            add_node(self, sphere * self->weights[i] / (double)self->num_azimuths,
                     self->sums + r * self->num);
        }
    }
    for (size_t r = 0; r < num_sets; r++) {
        reorder(self, false, out + r * self->num, self->sums + r * self->num);
    }
}
