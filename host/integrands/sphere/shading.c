/* The lobes of reflection (integrands/brdf.h) about z as integrands: divided by their integrals, as
 * they weigh shading integrals. docs/mathematics/integrands_sphere.md#shading-lobes. */
#define PRECISION 64
#include "integrands/diffuse.h"
#include "integrands/glossy.h"
#include "integrands/phong.h"
#include "integrands/zonal.h"

#include "base/memory.h"
#include "integrands/brdf_kind.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/integrand_kind.h"

#include <string.h>

/* self->own is the lobe. */
static pspec_status make(ps_integrand *self, const ps_brdf_kind *kind, const char *const *values,
                         ps_error *error) {
    ps_brdf *brdf = NULL;
    PS_TRY(ps_brdf_make(&brdf, kind, values, error));
    self->own = brdf;
    if (ps_integrand_is_on_hemisphere(self) && ps_brdf_is_below_horizon(brdf)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: the lobe goes below the horizon, and the points are on the "
                       "hemisphere",
                       self->kind->name);
    }
    return PSPEC_OK;
}

static void destroy(ps_integrand *self) {
    ps_brdf_destroy(self->own);
}

static double integral(const ps_integrand *self) {
    (void)self;
    return 1;
}

static double energy(const ps_integrand *self) {
    const double squares = ps_brdf_energy(self->own);
    return ps_integrand_is_on_hemisphere(self) ? 2 * squares - 1 / PS_PI : squares - 1 / PS_FOUR_PI;
}

static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    PS_TRY(ps_brdf_spherical(self->own, max_degree, out, error));
    ps_integrand_zonal_powers(self, max_degree, out);
    return PSPEC_OK;
}

static const char *note(const ps_integrand *self) {
    /* What it says of the other cut is no choice on the hemisphere. */
    return ps_integrand_is_on_hemisphere(self) ? NULL : ps_brdf_note(self->own);
}

/* 1/(2 pi r_s) */
static double scale_of(const ps_integrand *self) {
    return 1 / (PS_TWO_PI * ps_brdf_norm(self->own));
}

/* What all lobes do alike. */
#define LOBE                                                                                       \
    .domains = PS_INTEGRAND_ROUND, .destroy = destroy, .integral = integral, .energy = energy,     \
    .degrees = degrees, .note = note

/* ---- diffuse ------------------------------------------------------------------------------- */

static pspec_status create_diffuse(ps_integrand *self, const char *const *values, ps_error *error) {
    return make(self, &ps_brdf_diffuse, values, error);
}

/* C(g) = 2/(3 pi^2) (sin g + (pi - g) cos g) of max(0, z)/pi. */
static double common(double x) {
    const ps_half_angle half = ps_integrand_half_angle(x);
    const double rest = 2 * atan2(half.cosine, half.sine); /* pi - g */
    return 2 / (3 * PS_PI * PS_PI) * (2 * half.sine * half.cosine + rest * x);
}

static double correlate_diffuse(const ps_integrand *self, const double *x) {
    return ps_integrand_is_on_hemisphere(self) ? 2 * (common(x[0]) + common(-x[0])) : common(x[0]);
}

PS_INTEGRAND_VALUES_AS(give_diffuse, diffuse_value)

const ps_integrand_kind ps_integrand_diffuse = {
    .name = "diffuse",
    LOBE,
    .summary = PS_DIFFUSE_SUMMARY "; divided by its integral",
    .kernel = "diffuse",
    .create = create_diffuse,
    .values = give_diffuse,
    .correlation = correlate_diffuse,
};

/* ---- glossy -------------------------------------------------------------------------------- */

static pspec_status create_glossy(ps_integrand *self, const char *const *values, ps_error *error) {
    const double nowhere = -2; /* below every z */
    double *const numbers = self->numbers;
    PS_TRY(make(self, &ps_brdf_glossy, values, error));
    const ps_brdf *const brdf = self->own;
    numbers[LOBE_AXIS + 2] = 1;
    numbers[LOBE_RATE] = brdf->exponent / 2;
    numbers[GLOSSY_SCALE] = scale_of(self);
    numbers[GLOSSY_LEAST] = brdf->is_whole_sphere ? nowhere : 0;
    return PSPEC_OK;
}

static double correlate_glossy(const ps_integrand *self, const double *x) {
    const ps_brdf *const brdf = self->own;
    const double scale = scale_of(self);
    return brdf->is_whole_sphere
               ? scale * scale * ps_integrand_lobe_correlation(brdf->exponent, x[0])
               : NAN;
}

static double reach_of_glossy(const ps_integrand *self) {
    const ps_brdf *const brdf = self->own;
    const bool is_whole = brdf->is_whole_sphere || brdf->exponent >= PS_UNCUT_LOBE;
    return is_whole ? ps_integrand_lobe_reach(brdf->exponent) : INFINITY;
}

PS_INTEGRAND_VALUES_AS(give_glossy, glossy_value)

const ps_integrand_kind ps_integrand_glossy = {
    .name = "glossy",
    LOBE,
    .summary = PS_GLOSSY_SUMMARY "; divided by its integral",
    .kernel = "glossy",
    .parameters = {PS_EXPONENT_PARAMETER, PS_CUT_PARAMETER},
    .create = create_glossy,
    .values = give_glossy,
    .correlation = correlate_glossy,
    .reach = reach_of_glossy,
};

/* ---- Phong --------------------------------------------------------------------------------- */

static pspec_status create_phong(ps_integrand *self, const char *const *values, ps_error *error) {
    PS_TRY(make(self, &ps_brdf_phong, values, error));
    self->numbers[PHONG_EXPONENT] = ((const ps_brdf *)self->own)->exponent;
    self->numbers[PHONG_SCALE] = scale_of(self);
    return PSPEC_OK;
}

/* z^n with an even n is continued evenly as it is: a polynomial. Others have a kink at the horizon.
 */
static double reach_of_phong(const ps_integrand *self) {
    const double n = self->numbers[PHONG_EXPONENT];
    return ps_integrand_is_on_hemisphere(self) && fmod(n, 2) == 0 ? n : INFINITY;
}

PS_INTEGRAND_VALUES_AS(give_phong, phong_value)

const ps_integrand_kind ps_integrand_phong = {
    .name = "phong",
    LOBE,
    .summary = PS_PHONG_SUMMARY "; divided by its integral",
    .kernel = "phong",
    .parameters = {PS_EXPONENT_PARAMETER},
    .create = create_phong,
    .values = give_phong,
    .reach = reach_of_phong,
};

/* ---- tables -------------------------------------------------------------------------------- */

/* The densities, so that nothing is left to divide by. */
static pspec_status create_zonal(ps_integrand *self, const char *const *values, ps_error *error) {
    PS_TRY(make(self, &ps_brdf_zonal, values, error));
    ps_brdf *const brdf = self->own;
    const size_t num = brdf->num_nodes;
    PS_TRY(PS_NEW(&brdf->densities, 2 * num, "a lobe", error));
    for (size_t i = 0; i < num; i++) {
        brdf->densities[i] = brdf->nodes[i];
        brdf->densities[num + i] = ps_brdf_density(brdf, brdf->nodes[i]);
    }
    self->table = brdf->densities;
    self->num_table = 2 * num;
    self->numbers[ZONAL_NODES] = (double)num;
    self->needs_doubles = !ps_fit_single(brdf->densities, 2 * num);
    PS_TRY(PS_NEW(&brdf->path, strlen(values[0]) + 1, "a path", error));
    memcpy(brdf->path, values[0], strlen(values[0]));
    return PSPEC_OK;
}

static void give_zonal(const ps_integrand *self, const double *points, size_t num, double *out) {
    for (size_t i = 0; i < num; i++) {
        out[i] = ps_brdf_density(self->own, points[3 * i + 2]);
    }
}

static const char *file(const ps_integrand *self) {
    return ((const ps_brdf *)self->own)->path;
}

const ps_integrand_kind ps_integrand_zonal = {
    .name = "zonal",
    LOBE,
    .kernel = "zonal",
    .summary = PS_ZONAL_SUMMARY "; divided by its integral",
    .parameters = {PS_FILE_PARAMETER, PS_UNIT_PARAMETER},
    .create = create_zonal,
    .values = give_zonal,
    .file = file,
};
