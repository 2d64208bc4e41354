#include "rules/truncation.h"

#include "base/memory.h"
#include "math/sobolev.h"
#include "math/gauss_legendre.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From E^2 +- half a bracket to E +- its bound. */
static void take_root(double square, double half_width, double *root, double *bound) {
    *root = sqrt(square);
    *bound = sqrt(square + half_width) - sqrt(fmax(square - half_width, 0));
}

pspec_status ps_truncation_spherical(const ps_representer *representer, size_t max_degree,
                                     double *errors, double *bounds, ps_error *error) {
    double half_width = 0;
    PS_TRY(ps_representer_check(representer, max_degree, error));
    double square = ps_representer_rest(representer, max_degree, &half_width);
    for (size_t l = max_degree + 1; l-- > 0;) { /* small ones first */
        take_root(square, half_width, &errors[l], &bounds[l]);
        square += representer->a[l] * representer->b[l] * representer->b[l];
    }
    return PSPEC_OK;
}

/* ---- hemispherical harmonics in spherical ones ----------------------------------------------- */

/* sqrt(2l+1) P_l(x), l = 0 .. max_degree. */
static void fill_legendre(size_t max_degree, double x, double *values) {
    double before = 0;
    double value = 1;
    for (size_t l = 0; l <= max_degree; l++) {
        const double degree = (double)l;
        values[l] = sqrt(2 * degree + 1) * value;
        const double next = ((2 * degree + 1) * x * value - degree * before) / (degree + 1);
        before = value;
        value = next;
    }
}

static void add_node(size_t max_from, size_t max_to, double factor, const double *from_values,
                     const double *to_values, double *matrix) {
    for (size_t i = 0; i <= max_from; i++) {
        double *const row = matrix + i * (max_to + 1);
        const double left = factor * from_values[i];
        for (size_t l = i; l <= max_to; l++) { /* 0 before */
            row[l] += left * to_values[l];
        }
    }
}

pspec_status ps_half_range_matrix(size_t max_from, size_t max_to, double *matrix, ps_error *error) {
    const size_t num_nodes = (max_from + max_to) / 2 + 1;
    double *nodes = NULL;
    PS_TRY(PS_NEW(&nodes, 2 * num_nodes + max_from + max_to + 2, "hemispherical harmonics", error));
    double *const weights = nodes + num_nodes;
    double *const from_values = weights + num_nodes;
    double *const to_values = from_values + max_from + 1;
    ps_gauss_legendre(num_nodes, nodes, weights);
    memset(matrix, 0, (max_from + 1) * (max_to + 1) * sizeof *matrix);
    for (size_t i = 0; i < num_nodes; i++) {
        fill_legendre(max_from, 2 * nodes[i] - 1, from_values);
        fill_legendre(max_to, nodes[i], to_values);
        add_node(max_from, max_to, weights[i] * sqrt(0.5), from_values, to_values, matrix);
    }
    free(nodes);
    return PSPEC_OK;
}

/* ---- hemispherical harmonics --------------------------------------------------------------- */

/* Everything up to spherical degree X and hemispherical degree L. */
typedef struct harmonic_conversion {
    size_t max_degree, sh_degree;
    double *a, *b; /* [X + 2], [X + 1] */
    double *hsh;   /* [num_hsh], num_hsh > L + 1 */
    size_t num_hsh;
    double *difference; /* [X + 1]: b_l - b'_l */
    double *matrix;     /* [L + 1][X + 1] */
    double energy;
    double smoothness;
} harmonic_conversion;

static pspec_status prepare(harmonic_conversion *conversion, const ps_brdf *brdf, ps_error *error) {
    enum {
        BEYOND = 400
    }; /* degrees after L whose energy is added up; of the rest, the closed sum */
    const size_t num_sh = conversion->sh_degree + 2;
    conversion->num_hsh = conversion->max_degree + BEYOND;
    PS_TRY(PS_NEW(&conversion->a,
                  3 * num_sh + conversion->num_hsh + (conversion->max_degree + 1) * num_sh,
                  "a conversion of harmonics", error));
    conversion->b = conversion->a + num_sh;
    conversion->difference = conversion->b + num_sh;
    conversion->hsh = conversion->difference + num_sh;
    conversion->matrix = conversion->hsh + conversion->num_hsh;
    conversion->energy = ps_brdf_energy(brdf);
    ps_sobolev_eigenvalues(conversion->smoothness, conversion->sh_degree + 1, conversion->a);
    PS_TRY(ps_brdf_spherical(brdf, conversion->sh_degree, conversion->b, error));
    PS_TRY(ps_brdf_hemispherical(brdf, conversion->num_hsh - 1, conversion->hsh, error));
    return ps_half_range_matrix(conversion->max_degree, conversion->sh_degree, conversion->matrix,
                                error);
}

/* sum of b~_l^2 beyond L: exactly 0 where all of them are (the diffuse lobe). */
static double energy_beyond(const harmonic_conversion *conversion, size_t degree) {
    double energy = 0;
    double beyond = 0;
    for (size_t l = conversion->num_hsh; l-- > 0;) {
        energy += conversion->hsh[l] * conversion->hsh[l];
        beyond = l > degree ? energy : beyond;
    }
    const double missing = conversion->energy - energy;
    return beyond + (beyond > 0 && missing > 8 * DBL_EPSILON * conversion->energy ? missing : 0);
}

/* What is left beyond X is a_{X+1} R at most, R the energy of the difference there. The truncated
 * lobe jumps at the horizon, its coefficients fall like 1/l, and then the rest is a_{X+1} R/(2s +
 * 1). */
static void find_error(const harmonic_conversion *conversion, size_t degree, double *root,
                       double *bound) {
    double sum = 0;
    double energy = energy_beyond(conversion, degree);
    if (energy == 0) {
        *root = 0;
        *bound = 0;
        return;
    }
    for (size_t l = conversion->sh_degree + 1; l-- > 0;) {
        const double square = conversion->difference[l] * conversion->difference[l];
        sum += conversion->a[l] * square;
        energy -= square;
    }
    const double most =
        conversion->a[conversion->sh_degree + 1] * fmax(energy, DBL_EPSILON * conversion->energy);
    take_root(sum + most / (2 * conversion->smoothness + 1), most, root, bound);
}

/* b_l - b'_l becomes that of one hemispherical degree more. */
static void take_degree(harmonic_conversion *conversion, size_t degree) {
    const double *const row = conversion->matrix + degree * (conversion->sh_degree + 1);
    for (size_t l = degree; l <= conversion->sh_degree; l++) {
        conversion->difference[l] -= conversion->hsh[degree] * row[l];
    }
}

static void find_errors(harmonic_conversion *conversion, double *errors, double *bounds) {
    memcpy(conversion->difference, conversion->b,
           (conversion->sh_degree + 1) * sizeof *conversion->b);
    for (size_t degree = 0; degree <= conversion->max_degree; degree++) {
        take_degree(conversion, degree);
        find_error(conversion, degree, &errors[degree], &bounds[degree]);
    }
}

static bool are_good(size_t max_degree, double tolerance, const double *errors,
                     const double *bounds) {
    for (size_t l = 0; l <= max_degree; l++) {
        if (bounds[l] > tolerance * errors[l]) {
            return false;
        }
    }
    return true;
}

pspec_status ps_truncation_hemispherical(const ps_brdf *brdf, double smoothness, size_t max_degree,
                                         double tolerance, double *errors, double *bounds,
                                         size_t *sh_degree, ps_error *error) {
    enum { FIRST = 300, LAST = 3000 };
    PS_TRY(ps_sobolev_check(smoothness, error));
    if (max_degree > PS_MOST_HEMISPHERICAL_DEGREE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "degree %zu of hemispherical harmonics is more than %d, beyond which their "
                       "conversion to spherical ones takes too long",
                       max_degree, PS_MOST_HEMISPHERICAL_DEGREE);
    }
    size_t degree = FIRST > 4 * max_degree ? FIRST : 4 * max_degree;
    for (bool is_done = false; !is_done; degree = 2 * degree < LAST ? 2 * degree : LAST) {
        harmonic_conversion conversion = {
            .max_degree = max_degree, .sh_degree = degree, .smoothness = smoothness};
        const pspec_status status = prepare(&conversion, brdf, error);
        if (status == PSPEC_OK) {
            find_errors(&conversion, errors, bounds);
        }
        free(conversion.a);
        PS_TRY(status);
        *sh_degree = degree;
        is_done = degree >= LAST || are_good(max_degree, tolerance, errors, bounds);
    }
    return PSPEC_OK;
}

/* ---- light ---------------------------------------------------------------------------------- */

static double sum_squares(const double *difference, const double *powers, size_t first,
                          size_t num) {
    double sum = 0;
    for (size_t l = num; l-- > first;) { /* small ones first */
        sum += powers[l] * difference[l] * difference[l];
    }
    return sum;
}

static pspec_status shade_spherical(const ps_brdf *brdf, size_t max_degree, const double *powers,
                                    size_t num_powers, double *squares, ps_error *error) {
    double *b = NULL;
    PS_TRY(PS_NEW(&b, num_powers, "coefficients of a lobe", error));
    const pspec_status status = ps_brdf_spherical(brdf, num_powers - 1, b, error);
    for (size_t degree = 0; degree <= max_degree && status == PSPEC_OK; degree++) {
        squares[degree] = sum_squares(b, powers, degree + 1, num_powers);
    }
    free(b);
    return status;
}

pspec_status ps_truncation_of_light(const ps_brdf *brdf, bool is_hemispherical, size_t max_degree,
                                    const double *powers, size_t num_powers, double *squares,
                                    ps_error *error) {
    const double any_smoothness = 1.5;
    harmonic_conversion conversion = {
        .max_degree = max_degree, .sh_degree = num_powers - 1, .smoothness = any_smoothness};
    if (!is_hemispherical) {
        return shade_spherical(brdf, max_degree, powers, num_powers, squares, error);
    }
    const pspec_status status = prepare(&conversion, brdf, error);
    for (size_t degree = 0; degree <= max_degree && status == PSPEC_OK; degree++) {
        if (degree == 0) {
            memcpy(conversion.difference, conversion.b, num_powers * sizeof *conversion.b);
        }
        if (degree < num_powers) {
            take_degree(&conversion, degree);
        }
        squares[degree] = sum_squares(conversion.difference, powers, 0, num_powers);
    }
    free(conversion.a);
    return status;
}
