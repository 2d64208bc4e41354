/* A user's own integrand by its coefficients: docs/mathematics/integrands.md#coefficients. */
#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/files/torus_series.h"
#include "integrands/integrand_kind.h"

#include <stdlib.h>

/* What self->own points to. */
typedef struct coefficients {
    char *path;
    ps_torus_series *torus;
} coefficients;

static const coefficients *own_of(const ps_integrand *self) {
    return self->own;
}

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    coefficients *own = NULL;
    PS_TRY(PS_NEW(&own, 1, "coefficients", error));
    self->own = own;
    PS_TRY(ps_integrand_copy_path(self, values[0], &own->path, error));
    return ps_torus_series_read(&own->torus, own->path, self->place.dimension, error);
}

static void destroy(ps_integrand *self) {
    coefficients *const own = self->own;
    if (own != NULL) {
        ps_torus_series_destroy(own->torus);
        free(own->path);
    }
    free(own);
}

static double integral(const ps_integrand *self) {
    return own_of(self)->torus->mean;
}

static double energy(const ps_integrand *self) {
    return own_of(self)->torus->energy;
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    (void)error;
    for (size_t i = 0; i < num; i++) {
        out[i] = ps_torus_series_power(own_of(self)->torus, vectors + i * self->place.dimension);
    }
    return PSPEC_OK;
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    for (size_t i = 0; i < num; i++) {
        out[i] = ps_torus_series_value(own_of(self)->torus, points + i * self->place.dimension);
    }
}

static double correlation(const ps_integrand *self, const double *x) {
    return ps_torus_series_correlation(own_of(self)->torus, x);
}

static double reach(const ps_integrand *self) {
    return own_of(self)->torus->reach;
}

static double steps(const ps_integrand *self) {
    return own_of(self)->torus->steps;
}

static const char *file(const ps_integrand *self) {
    return own_of(self)->path;
}

const ps_integrand_kind ps_integrand_coefficients = {
    .name = "coefficients",
    .summary =
        "a function by its coefficients: NPY as --coefficients writes, or lines k1..kd,re,im",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"file", "", "the coefficients, of a real function"}},
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
    .reach = reach,
    .steps = steps,
    .file = file,
};
