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

#include <stdlib.h>
#include <string.h>

/* What self->own points to. */
typedef struct shading {
    ps_brdf *brdf;
    char *path;    /* of a table; NULL: none */
    double *table; /* as kernels/integrands/zonal.h takes it */
} shading;

static const ps_brdf *lobe_of(const ps_integrand *self) {
    return ((const shading *)self->own)->brdf;
}

static pspec_status make(ps_integrand *self, const ps_brdf_kind *kind, const char *const *values,
                         ps_error *error) {
    shading *own = NULL;
    PS_TRY(PS_NEW(&own, 1, "a lobe", error));
    self->own = own;
    PS_TRY(ps_brdf_make(&own->brdf, kind, values, error));
    if (ps_integrand_is_on_hemisphere(self) && ps_brdf_is_below_horizon(own->brdf)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: the lobe goes below the horizon, and the points are on the "
                       "hemisphere",
                       self->kind->name);
    }
    return PSPEC_OK;
}

static void destroy(ps_integrand *self) {
    shading *const own = self->own;
    if (own != NULL) {
        ps_brdf_destroy(own->brdf);
        free(own->path);
        free(own->table);
    }
    free(own);
}

static double integral(const ps_integrand *self) {
    (void)self;
    return 1;
}

static double energy(const ps_integrand *self) {
    const double squares = ps_brdf_energy(lobe_of(self));
    return ps_integrand_is_on_hemisphere(self) ? 2 * squares - 1 / PS_PI : squares - 1 / PS_FOUR_PI;
}

static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    PS_TRY(ps_brdf_spherical(lobe_of(self), max_degree, out, error));
    ps_integrand_zonal_powers(self, max_degree, out);
    return PSPEC_OK;
}

static const char *note(const ps_integrand *self) {
    /* What it says of the other cut is no choice on the hemisphere. */
    return ps_integrand_is_on_hemisphere(self) ? NULL : ps_brdf_note(lobe_of(self));
}

/* 1/(2 pi r_s) */
static double scale_of(const ps_integrand *self) {
    return 1 / (PS_TWO_PI * ps_brdf_norm(lobe_of(self)));
}

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
    .summary = PS_DIFFUSE_SUMMARY "; divided by its integral",
    .kernel = "diffuse",
    .domains = PS_INTEGRAND_ROUND,
    .create = create_diffuse,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .degrees = degrees,
    .values = give_diffuse,
    .correlation = correlate_diffuse,
    .note = note,
};

/* ---- glossy -------------------------------------------------------------------------------- */

static pspec_status create_glossy(ps_integrand *self, const char *const *values, ps_error *error) {
    const double nowhere = -2; /* below every z */
    double *const numbers = self->numbers;
    PS_TRY(make(self, &ps_brdf_glossy, values, error));
    const ps_brdf *const brdf = lobe_of(self);
    numbers[LOBE_AXIS + 2] = 1;
    numbers[LOBE_RATE] = brdf->exponent / 2;
    numbers[GLOSSY_SCALE] = scale_of(self);
    numbers[GLOSSY_LEAST] = brdf->is_whole_sphere ? nowhere : 0;
    return PSPEC_OK;
}

static double correlate_glossy(const ps_integrand *self, const double *x) {
    const ps_brdf *const brdf = lobe_of(self);
    const double scale = scale_of(self);
    return brdf->is_whole_sphere
               ? scale * scale * ps_integrand_lobe_correlation(brdf->exponent, x[0])
               : NAN;
}

static double reach_of_glossy(const ps_integrand *self) {
    const ps_brdf *const brdf = lobe_of(self);
    const bool is_whole = brdf->is_whole_sphere || brdf->exponent >= PS_UNCUT_LOBE;
    return is_whole ? ps_integrand_lobe_reach(brdf->exponent) : INFINITY;
}

PS_INTEGRAND_VALUES_AS(give_glossy, glossy_value)

const ps_integrand_kind ps_integrand_glossy = {
    .name = "glossy",
    .summary = PS_GLOSSY_SUMMARY "; divided by its integral",
    .kernel = "glossy",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {PS_EXPONENT_PARAMETER, PS_CUT_PARAMETER},
    .create = create_glossy,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .degrees = degrees,
    .values = give_glossy,
    .correlation = correlate_glossy,
    .reach = reach_of_glossy,
    .note = note,
};

/* ---- Phong --------------------------------------------------------------------------------- */

static pspec_status create_phong(ps_integrand *self, const char *const *values, ps_error *error) {
    PS_TRY(make(self, &ps_brdf_phong, values, error));
    self->numbers[PHONG_EXPONENT] = lobe_of(self)->exponent;
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
    .summary = PS_PHONG_SUMMARY "; divided by its integral",
    .kernel = "phong",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {PS_EXPONENT_PARAMETER},
    .create = create_phong,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .degrees = degrees,
    .values = give_phong,
    .reach = reach_of_phong,
    .note = note,
};

/* ---- tables -------------------------------------------------------------------------------- */

/* The densities, so that nothing is left to divide by. */
static pspec_status give_table(ps_integrand *self, shading *own, ps_error *error) {
    const size_t num = own->brdf->num_nodes;
    PS_TRY(PS_NEW(&own->table, 2 * num, "a lobe", error));
    for (size_t i = 0; i < num; i++) {
        own->table[i] = own->brdf->nodes[i];
        own->table[num + i] = ps_brdf_density(own->brdf, own->brdf->nodes[i]);
    }
    self->table = own->table;
    self->num_table = 2 * num;
    self->numbers[ZONAL_NODES] = (double)num;
    self->needs_doubles = !ps_fit_single(own->table, 2 * num);
    return PSPEC_OK;
}

static pspec_status create_zonal(ps_integrand *self, const char *const *values, ps_error *error) {
    const size_t num_bytes = strlen(values[0]) + 1;
    PS_TRY(make(self, &ps_brdf_zonal, values, error));
    shading *const own = self->own;
    PS_TRY(PS_NEW(&own->path, num_bytes, "a path", error));
    memcpy(own->path, values[0], num_bytes);
    return give_table(self, own, error);
}

static void give_zonal(const ps_integrand *self, const double *points, size_t num, double *out) {
    for (size_t i = 0; i < num; i++) {
        out[i] = ps_brdf_density(lobe_of(self), points[3 * i + 2]);
    }
}

static const char *file(const ps_integrand *self) {
    return ((const shading *)self->own)->path;
}

const ps_integrand_kind ps_integrand_zonal = {
    .name = "zonal",
    .kernel = "zonal",
    .summary = PS_ZONAL_SUMMARY "; divided by its integral",
    .domains = PS_INTEGRAND_ROUND,
    .parameters = {PS_FILE_PARAMETER, PS_UNIT_PARAMETER},
    .create = create_zonal,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .degrees = degrees,
    .values = give_zonal,
    .note = note,
    .file = file,
};
