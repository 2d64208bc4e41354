#include "rules/truncation.h"

#include "base/memory.h"
#include "math/half_range.h"
#include "math/sobolev.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

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

/* ---- hemispherical harmonics --------------------------------------------------------------- */

/* Everything up to spherical degree X and hemispherical degree L. */
typedef struct conversion {
    size_t max_degree, sh_degree;
    double *a, *b; /* [X + 2], [X + 1] */
    double *hsh;   /* [num_hsh], num_hsh > L + 1 */
    size_t num_hsh;
    double *difference; /* [X + 1]: b_l - b'_l */
    double *matrix;     /* [L + 1][X + 1] */
    double energy;
    double smoothness;
} conversion;

static pspec_status prepare(conversion *of, const ps_brdf *brdf, ps_error *error) {
    enum {
        BEYOND = 400
    }; /* degrees after L whose energy is added up; of the rest, the closed sum */
    const size_t num_sh = of->sh_degree + 2;
    of->num_hsh = of->max_degree + BEYOND;
    PS_TRY(PS_NEW(&of->a, 3 * num_sh + of->num_hsh + (of->max_degree + 1) * num_sh,
                  "a conversion of harmonics", error));
    of->b = of->a + num_sh;
    of->difference = of->b + num_sh;
    of->hsh = of->difference + num_sh;
    of->matrix = of->hsh + of->num_hsh;
    of->energy = ps_brdf_energy(brdf);
    ps_sobolev_eigenvalues(of->smoothness, of->sh_degree + 1, of->a);
    PS_TRY(ps_brdf_spherical(brdf, of->sh_degree, of->b, error));
    PS_TRY(ps_brdf_hemispherical(brdf, of->num_hsh - 1, of->hsh, error));
    return ps_half_range_matrix(of->max_degree, of->sh_degree, of->matrix, error);
}

/* sum of b~_l^2 beyond L: exactly 0 where all of them are (the diffuse lobe). */
static double energy_beyond(const conversion *of, size_t degree) {
    double all = 0;
    double beyond = 0;
    for (size_t l = of->num_hsh; l-- > 0;) {
        all += of->hsh[l] * of->hsh[l];
        beyond = l > degree ? all : beyond;
    }
    const double missing = of->energy - all;
    return beyond + (beyond > 0 && missing > 8 * DBL_EPSILON * of->energy ? missing : 0);
}

/* What is left beyond X is a_{X+1} R at most, R the energy of the difference there. The truncated lobe jumps at the
 * horizon, its coefficients fall like 1/l, and then the rest is a_{X+1} R/(2s + 1). */
static void find_error(const conversion *of, size_t degree, double *root, double *bound) {
    double sum = 0;
    double energy = energy_beyond(of, degree);
    if (energy == 0) {
        *root = 0;
        *bound = 0;
        return;
    }
    for (size_t l = of->sh_degree + 1; l-- > 0;) {
        const double square = of->difference[l] * of->difference[l];
        sum += of->a[l] * square;
        energy -= square;
    }
    const double most = of->a[of->sh_degree + 1] * fmax(energy, DBL_EPSILON * of->energy);
    take_root(sum + most / (2 * of->smoothness + 1), most, root, bound);
}

static void find_errors(conversion *of, double *errors, double *bounds) {
    for (size_t l = 0; l <= of->sh_degree; l++) {
        of->difference[l] = of->b[l];
    }
    for (size_t degree = 0; degree <= of->max_degree; degree++) {
        const double *const row = of->matrix + degree * (of->sh_degree + 1);
        for (size_t l = degree; l <= of->sh_degree; l++) {
            of->difference[l] -= of->hsh[degree] * row[l];
        }
        find_error(of, degree, &errors[degree], &bounds[degree]);
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
        conversion of = {.max_degree = max_degree, .sh_degree = degree, .smoothness = smoothness};
        const pspec_status status = prepare(&of, brdf, error);
        if (status == PSPEC_OK) {
            find_errors(&of, errors, bounds);
        }
        free(of.a);
        PS_TRY(status);
        *sh_degree = degree;
        is_done = degree >= LAST || are_good(max_degree, tolerance, errors, bounds);
    }
    return PSPEC_OK;
}
