/* A lobe from a file: values at heights, linear in z between them, 0 outside. Everything is
 * integrated exactly. */
#define PRECISION 64
#include "integrands/zonal.h"

#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/lobes/lobe.h"
#include "points/lists/number_rows.h"

#include <stdlib.h>
#include <string.h>

static double norm(const ps_brdf *brdf) {
    double sum = 0;
    for (size_t i = 1; i < brdf->num_nodes; i++) {
        sum += (brdf->nodes[i] - brdf->nodes[i - 1]) * (brdf->values[i] + brdf->values[i - 1]) / 2;
    }
    return sum;
}

static double energy(const ps_brdf *brdf) {
    double sum = 0;
    const double integral = norm(brdf);
    for (size_t i = 1; i < brdf->num_nodes; i++) {
        const double a = brdf->values[i - 1];
        const double b = brdf->values[i];
        sum += (brdf->nodes[i] - brdf->nodes[i - 1]) * (a * a + a * b + b * b) / 3;
    }
    return sum / (PS_TWO_PI * integral * integral);
}

static double density(const ps_brdf *brdf, double z) {
    const size_t last = brdf->num_nodes - 1;
    if (!(z >= brdf->nodes[0] && z <= brdf->nodes[last])) {
        return 0;
    }
    size_t low = 0;
    size_t high = last;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(brdf->nodes[middle] <= z ? &low : &high) = middle;
    }
    const double share = (z - brdf->nodes[low]) / (brdf->nodes[high] - brdf->nodes[low]);
    return brdf->values[low] + share * (brdf->values[high] - brdf->values[low]);
}

static double slope(const ps_brdf *brdf, size_t i) { /* of the interval that begins at node i */
    return (brdf->values[i + 1] - brdf->values[i]) / (brdf->nodes[i + 1] - brdf->nodes[i]);
}

/* The jumps of p and of its slope at node i. */
static void find_jumps(const ps_brdf *brdf, size_t i, double *value, double *slopes) {
    const size_t last = brdf->num_nodes - 1;
    *value = i == 0 ? brdf->values[0] : i == last ? -brdf->values[last] : 0;
    *slopes = (i < last ? slope(brdf, i) : 0) - (i > 0 ? slope(brdf, i - 1) : 0);
}

/* Adds what node i gives to int p P_l, l = 1 .. max_degree: with S' = P_l and T' = S, int p P_l =
 * -sum jump(p) S + sum jump(p') T, S = (P_{l+1} - P_{l-1})/(2l+1) and T the same of S. x: the
 * height as the argument of P_l; scale: d height/dx. */
static void add_node(double x, double scale, double value, double slopes, size_t max_degree,
                     double *sums) {
    double p[5] = {0, 0, 1, x, (3 * x * x - 1) / 2}; /* P_{l-3} .. P_{l+1} for l = 1 */
    for (size_t l = 1; l <= max_degree; l++) {
        const double d = (double)l;
        const double next = ((2 * d + 3) * x * p[4] - (d + 1) * p[3]) / (d + 2);
        const double above = (next - p[3]) / (2 * d + 3);
        const double below = (p[3] - p[1]) / (2 * d - 1);
        const double first = (p[4] - p[2]) / (2 * d + 1);
        sums[l] += scale * (-value * first + scale * slopes * (above - below) / (2 * d + 1));
        memmove(p, p + 1, 4 * sizeof *p);
        p[4] = next;
    }
}

/* int p P_l(x) dz over int p dz, times pole * sqrt(2l+1). */
static void integrate(const ps_brdf *brdf, bool is_stretched, size_t max_degree, double *b) {
    memset(b, 0, (max_degree + 1) * sizeof *b);
    const double scale = is_stretched ? 0.5 : 1;
    for (size_t i = 0; i < brdf->num_nodes; i++) {
        double value = 0;
        double slopes = 0;
        find_jumps(brdf, i, &value, &slopes);
        add_node(is_stretched ? 2 * brdf->nodes[i] - 1 : brdf->nodes[i], scale, value, slopes,
                 max_degree, b);
    }
    b[0] = norm(brdf);
    for (size_t l = max_degree + 1; l-- > 0;) {
        b[l] *= (is_stretched ? sqrt(2.0) : 1) * ps_zonal_at_pole(l) / b[0];
    }
}

static pspec_status spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    (void)error;
    integrate(brdf, false, max_degree, b);
    return PSPEC_OK;
}

static pspec_status hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                  ps_error *error) {
    (void)error;
    integrate(brdf, true, max_degree, b);
    return PSPEC_OK;
}

static bool is_below(const ps_brdf *brdf) {
    return brdf->nodes[0] < 0;
}

/* ---- files --------------------------------------------------------------------------------- */

enum { DEGREES_OF_HALF_TURN = 180, LINE = 2 /* behind the numbers of a row: where it stood */ };

/* The height that a number of the first column stands for; nan where it stands for none. */
static double height_of(const char *unit, double number) {
    if (strcmp(unit, "cosine") == 0) {
        return fabs(number) <= 1 ? number : NAN;
    }
    const double angle =
        strcmp(unit, "degrees") == 0 ? number * PS_PI / DEGREES_OF_HALF_TURN : number;
    return angle >= 0 && angle <= PS_PI * (1 + 1e-15) ? cos(angle) : NAN;
}

static pspec_status check_row(const ps_brdf *brdf, const char *path, const char *unit,
                              const double *row, size_t i, ps_error *error) {
    if (isnan(brdf->nodes[i])) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s, line %zu: %.17g is no %s of a direction",
                       path, (size_t)row[LINE], row[0], unit);
    }
    if (!(row[1] >= 0)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: the lobe is %.17g, below 0, which no reflection is", path,
                       (size_t)row[LINE], row[1]);
    }
    const double order = i > 0 ? brdf->nodes[1] - brdf->nodes[0] : 1;
    if (i > 0 && !((brdf->nodes[i] - brdf->nodes[i - 1]) * order > 0)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: %.17g is out of order; directions rise or fall all the way",
                       path, (size_t)row[LINE], row[0]);
    }
    return PSPEC_OK;
}

static void reverse(double *values, size_t num) {
    for (size_t i = 0; i < num / 2; i++) {
        const double kept = values[i];
        values[i] = values[num - 1 - i];
        values[num - 1 - i] = kept;
    }
}

static pspec_status fill_nodes(ps_brdf *brdf, const char *path, const char *unit,
                               const double *rows, size_t num, ps_error *error) {
    PS_TRY(PS_NEW(&brdf->nodes, num, "a lobe", error));
    PS_TRY(PS_NEW(&brdf->values, num, "a lobe", error));
    brdf->num_nodes = num;
    for (size_t i = 0; i < num; i++) {
        const double *const row = rows + i * (LINE + 1);
        brdf->nodes[i] = height_of(unit, row[0]);
        brdf->values[i] = row[1];
        PS_TRY(check_row(brdf, path, unit, row, i, error));
    }
    if (num < 2) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: one row; a lobe has two at least", path);
    }
    if (brdf->nodes[0] > brdf->nodes[1]) {
        reverse(brdf->nodes, num);
        reverse(brdf->values, num);
    }
    if (!(norm(brdf) > 0) || !isfinite(energy(brdf))) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: the integral of the lobe is %g and cannot be divided by", path,
                       norm(brdf));
    }
    return PSPEC_OK;
}

static pspec_status fill_densities(ps_brdf *brdf, ps_error *error) {
    const size_t num = brdf->num_nodes;
    const double whole = PS_TWO_PI * norm(brdf);
    PS_TRY(PS_NEW(&brdf->densities, 2 * num, "a lobe", error));
    for (size_t i = 0; i < num; i++) {
        brdf->densities[i] = brdf->nodes[i];
        brdf->densities[num + i] = density(brdf, brdf->nodes[i]) / whole;
    }
    return PSPEC_OK;
}

static pspec_status create(ps_brdf *brdf, const char *const *values, ps_error *error) {
    const char *const path = values[0];
    const char *const unit = values[1];
    double *rows = NULL;
    size_t num = 0;
    if (path[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "BRDF zonal needs its table, as in zonal:file=lobe.txt");
    }
    if (strcmp(unit, "cosine") != 0 && strcmp(unit, "degrees") != 0 &&
        strcmp(unit, "radians") != 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "BRDF zonal: of=%s is not one of cosine, degrees, radians", unit);
    }
    PS_TRY(ps_read_rows(path, LINE, &rows, &num, error));
    const pspec_status status = fill_nodes(brdf, path, unit, rows, num, error);
    free(rows);
    return status == PSPEC_OK ? fill_densities(brdf, error) : status;
}

/* ---- as an integrand ----------------------------------------------------------------------- */

/* The densities, so that nothing is left to divide by. */
static void fill(ps_integrand *self) {
    const ps_brdf *const brdf = self->own;
    self->table = brdf->densities;
    self->num_table = 2 * brdf->num_nodes;
    self->numbers[ZONAL_NODES] = (double)brdf->num_nodes;
    self->needs_doubles = !ps_fit_single(self->table, self->num_table);
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    const ps_brdf *const brdf = self->own;
    const double whole = PS_TWO_PI * norm(brdf);
    for (size_t i = 0; i < num; i++) {
        out[i] = density(brdf, points[3 * i + 2]) / whole;
    }
}

static const ps_lobe lobe = {
    .create = create,
    .norm = norm,
    .energy = energy,
    .density = density,
    .spherical = spherical,
    .hemispherical = hemispherical,
    .is_below = is_below,
    .fill = fill,
};

const ps_integrand_kind ps_integrand_zonal = {
    .name = "zonal",
    .summary = "a table from a file, linear in z between its rows, 0 outside",
    .parameters = {{"file", "", "rows of direction and value; must be given"},
                   {"of", "cosine",
                    "cosine|degrees|radians: what the first column is, to the axis"}},
    PS_LOBE_ROW,
    .lobe = &lobe,
    .kernel = "zonal",
    .values = values,
};
