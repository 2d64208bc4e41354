#include "jobs/shade/light.h"

#include "base/memory.h"
#include "integrands/files/series.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* Beyond, a diffuse lobe leaves 6e-5 of the root of the energy there (test_shade_job), and light
 * has little of it. */
enum { MOST_DEGREE = 256 };

static size_t choose_degree(const ps_integrand *integrand) {
    const double reach = ps_integrand_reach(integrand);
    return reach < MOST_DEGREE ? (size_t)reach : MOST_DEGREE;
}

/* Powers of the coefficients, which become those of the shading. */
static void convolve(ps_light *self, const double *b, double *f) {
    const size_t last = self->max_degree;
    for (size_t l = 0; l <= last; l++) {
        const double factor = b[l] * sqrt(PS_FOUR_PI / (2 * (double)l + 1));
        double power = 0;
        for (size_t m = 0; m <= l; m++) {
            double *const own = f + 2 * (m * (2 * last + 1 - m) / 2 + l);
            power += (m > 0 ? 2 : 1) * (own[0] * own[0] + own[1] * own[1]);
            own[0] *= factor;
            own[1] *= factor;
        }
        self->powers[l] = power / (2 * (double)l + 1);
    }
}

/* Cauchy's inequality, of what F and the lobe have beyond. */
static double bound_rest(const ps_light *self, const ps_brdf *brdf, const double *b) {
    double rest = ps_brdf_energy(brdf);
    for (size_t l = 0; l <= self->max_degree; l++) {
        rest -= b[l] * b[l];
    }
    return sqrt(fmax(rest, 0) * ps_light_beyond(self, self->max_degree));
}

static pspec_status fill(ps_light *self, const ps_brdf *brdf, double *b, double *f,
                         ps_error *error) {
    PS_TRY(ps_brdf_spherical(brdf, self->max_degree, b, error));
    PS_TRY(ps_integrand_harmonics(self->integrand, self->max_degree, f, error));
    convolve(self, b, f);
    self->shading_bound = bound_rest(self, brdf, b);
    return ps_sphere_series_make(&self->shading, self->max_degree, f, error);
}

pspec_status ps_light_make(ps_light *out, const char *integrand, ps_made_integrands *made,
                           const ps_brdf *brdf, ps_error *error) {
    const ps_given_integrands none = {0};
    double *b = NULL;
    double *f = NULL;
    pspec_status status = PSPEC_OK;
    *out = (ps_light){0};
    const ps_integrand_place sphere = {PS_SAMPLES_SPHERE, 3};
    PS_TRY(ps_integrand_take(&out->integrand, made != NULL ? made : &out->own, &none, integrand,
                             sphere, 0, error));
    out->max_degree = choose_degree(out->integrand);
    const size_t num = out->max_degree + 1;
    PS_TRY(PS_NEW(&out->powers, num, "powers of light", error));
    PS_TRY_OUT(status, PS_NEW(&b, num, "coefficients of a lobe", error));
    PS_TRY_OUT(status, PS_NEW(&f, num * (num + 1), "coefficients of light", error));
    status = fill(out, brdf, b, f, error);
out:
    free(b);
    free(f);
    return status;
}

void ps_light_free(ps_light *light) {
    ps_made_integrands_free(&light->own);
    ps_sphere_series_destroy(light->shading);
    free(light->powers);
    *light = (ps_light){0};
}

double ps_light_shading(const ps_light *light, const double *r) {
    return ps_sphere_series_value(light->shading, r);
}

double ps_light_beyond(const ps_light *light, size_t max_degree) {
    double rest = ps_integrand_energy(light->integrand);
    for (size_t l = 1; l <= max_degree; l++) {
        rest -= (2 * (double)l + 1) * light->powers[l];
    }
    return fmax(rest, 0);
}
