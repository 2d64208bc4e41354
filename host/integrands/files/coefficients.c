/* A user's own integrand by its coefficients: docs/mathematics/integrands.md#coefficients, and
 * docs/mathematics/integrands_sphere.md#coefficients. */
#define PRECISION 64
#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/files/series.h"
#include "integrands/integrand_kind.h"
#include "integrands/sphere_series.h"
#include "integrands/torus_series.h"

#include <stdlib.h>

/* What self->own points to; one of both series is there. */
typedef struct coefficients {
    char *path;
    ps_torus_series *torus;
    ps_sphere_series *sphere;
} coefficients;

static const coefficients *own_of(const ps_integrand *self) {
    return self->own;
}

static bool is_on_torus(const ps_integrand *self) {
    return self->place.where == PS_SAMPLES_TORUS;
}

static void give_torus(ps_integrand *self, const ps_torus_series *series) {
    self->kernel = "torus_series";
    self->table = series->table;
    self->num_table = series->num_table;
    self->numbers[TORUS_SERIES_MEAN] = series->mean;
    self->needs_doubles = !ps_fit_single(series->table, series->num_table);
}

/* Its header says why in doubles alone. */
static void give_sphere(ps_integrand *self, const ps_sphere_series *series) {
    self->kernel = "sphere_series";
    self->table = series->table;
    self->num_table = series->num_table;
    self->numbers[SPHERE_SERIES_DEGREE] = (double)series->max_degree;
    self->needs_doubles = true;
}

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    coefficients *own = NULL;
    PS_TRY(PS_NEW(&own, 1, "coefficients", error));
    self->own = own;
    PS_TRY(ps_integrand_copy_path(self, values[0], &own->path, error));
    if (is_on_torus(self)) {
        PS_TRY(ps_torus_series_read(&own->torus, own->path, self->place.dimension, error));
        give_torus(self, own->torus);
    } else {
        PS_TRY(ps_sphere_series_read(&own->sphere, own->path, ps_integrand_is_on_hemisphere(self),
                                     error));
        give_sphere(self, own->sphere);
    }
    return PSPEC_OK;
}

static void destroy(ps_integrand *self) {
    coefficients *const own = self->own;
    if (own != NULL) {
        ps_torus_series_destroy(own->torus);
        ps_sphere_series_destroy(own->sphere);
        free(own->path);
    }
    free(own);
}

/* sqrt(4 pi) F_00 on the sphere, half of it on the hemisphere. */
static double integral(const ps_integrand *self) {
    if (is_on_torus(self)) {
        return own_of(self)->torus->mean;
    }
    const double whole = sqrt(PS_FOUR_PI) * own_of(self)->sphere->table[2]; /* of l = m = 0 */
    return ps_integrand_is_on_hemisphere(self) ? whole / 2 : whole;
}

/* The same on the hemisphere, whose even extension F is. */
static double energy(const ps_integrand *self) {
    double sum = 0;
    if (is_on_torus(self)) {
        return own_of(self)->torus->energy;
    }
    const ps_sphere_series *const series = own_of(self)->sphere;
    for (size_t l = 1; l <= series->max_degree; l++) {
        sum += series->powers[l];
    }
    return sum;
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    (void)error;
    for (size_t i = 0; i < num; i++) {
        out[i] = ps_torus_series_power(own_of(self)->torus, vectors + i * self->place.dimension);
    }
    return PSPEC_OK;
}

static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    const ps_sphere_series *const series = own_of(self)->sphere;
    (void)error;
    for (size_t l = 0; l <= max_degree; l++) {
        out[l] = l <= series->max_degree ? series->powers[l] : 0;
    }
    return PSPEC_OK;
}

static pspec_status all_coefficients(const ps_integrand *self, size_t max_degree, double *out,
                                     ps_error *error) {
    (void)error;
    ps_sphere_series_coefficients(own_of(self)->sphere, max_degree, out);
    return PSPEC_OK;
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    const coefficients *const own = own_of(self);
    for (size_t i = 0; i < num; i++) {
        const double *const at = points + i * self->place.dimension;
        out[i] = is_on_torus(self) ? ps_torus_series_value(own->torus, at)
                                   : ps_sphere_series_value(own->sphere, at);
    }
}

static double correlation(const ps_integrand *self, const double *x) {
    return is_on_torus(self) ? ps_torus_series_correlation(own_of(self)->torus, x)
                             : ps_sphere_series_correlation(own_of(self)->sphere, x[0]);
}

/* All of it is up to there. */
static double reach(const ps_integrand *self) {
    return is_on_torus(self) ? own_of(self)->torus->reach
                             : (double)own_of(self)->sphere->max_degree;
}

static double steps(const ps_integrand *self) {
    return is_on_torus(self) ? own_of(self)->torus->steps
                             : ps_sphere_series_steps(own_of(self)->sphere);
}

const ps_integrand_kind ps_integrand_coefficients = {
    .name = "coefficients",
    .summary =
        "a function by its coefficients: NPY as --coefficients writes, or lines k1..kd,re,im "
        "or l,m,re,im",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS) | PS_INTEGRAND_ROUND,
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"file", "", "the coefficients, of a real function"}},
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .degrees = degrees,
    .coefficients = all_coefficients,
    .values = values,
    .correlation = correlation,
    .reach = reach,
    .steps = steps,
};
