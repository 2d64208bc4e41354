#include "integrands/lobes/lobe.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>

/* ---- making -------------------------------------------------------------------------------- */

pspec_status ps_brdf_make(ps_brdf **out, const ps_integrand_kind *kind, const char *const *values,
                          ps_error *error) {
    ps_brdf *brdf = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&brdf, 1, "a BRDF", error));
    brdf->kind = kind;
    const pspec_status status =
        kind->lobe->create != NULL ? kind->lobe->create(brdf, values, error) : PSPEC_OK;
    if (status != PSPEC_OK) {
        ps_brdf_destroy(brdf);
        return status;
    }
    *out = brdf;
    return PSPEC_OK;
}

void ps_brdf_destroy(ps_brdf *brdf) {
    if (brdf != NULL) {
        free(brdf->nodes);
        free(brdf->values);
        free(brdf->densities);
        free(brdf);
    }
}

pspec_status ps_brdf_read_exponent(ps_brdf *brdf, const char *text, ps_error *error) {
    if (text[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "BRDF %s needs its exponent, as in %s:n=30", brdf->kind->name,
                       brdf->kind->name);
    }
    return ps_parse_number(text, "exponent n of the lobe", PS_LEAST_LOBE, PS_MOST_LOBE,
                           &brdf->exponent, error);
}

double ps_zonal_at_pole(size_t l) {
    return sqrt((2 * (double)l + 1) / PS_FOUR_PI);
}

/* ---- what lobes tell ----------------------------------------------------------------------- */

double ps_brdf_norm(const ps_brdf *brdf) {
    return brdf->kind->lobe->norm(brdf);
}

double ps_brdf_energy(const ps_brdf *brdf) {
    return brdf->kind->lobe->energy(brdf);
}

double ps_brdf_density(const ps_brdf *brdf, double z) {
    return brdf->kind->lobe->density(brdf, z) / (PS_TWO_PI * ps_brdf_norm(brdf));
}

pspec_status ps_brdf_spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    return brdf->kind->lobe->spherical(brdf, max_degree, b, error);
}

pspec_status ps_brdf_hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                   ps_error *error) {
    if (ps_brdf_is_below_horizon(brdf)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "this BRDF %s goes below the horizon, where hemispherical harmonics are not "
                       "defined; use spherical ones",
                       brdf->kind->name);
    }
    return brdf->kind->lobe->hemispherical(brdf, max_degree, b, error);
}

bool ps_brdf_is_below_horizon(const ps_brdf *brdf) {
    return brdf->kind->lobe->is_below != NULL && brdf->kind->lobe->is_below(brdf);
}

bool ps_brdf_mean_distance(const ps_brdf *brdf, double smoothness, double *d_0) {
    if (brdf->kind->lobe->mean_distance == NULL) {
        return false;
    }
    *d_0 = brdf->kind->lobe->mean_distance(brdf, smoothness);
    return true;
}

ps_morph ps_brdf_morph(const ps_brdf *brdf) {
    return brdf->kind->lobe->morph != NULL ? brdf->kind->lobe->morph(brdf)
                                           : (ps_morph){PS_MORPH_NONE, 0};
}

const char *ps_brdf_note(const ps_brdf *brdf) {
    return brdf->kind->lobe->note != NULL ? brdf->kind->lobe->note(brdf) : NULL;
}

/* ---- as integrands about z, whose own is the lobe ------------------------------------------ */

pspec_status ps_lobe_create(ps_integrand *self, const char *const *values, ps_error *error) {
    ps_brdf *brdf = NULL;
    PS_TRY(ps_brdf_make(&brdf, self->kind, values, error));
    self->own = brdf;
    if (ps_integrand_is_on_hemisphere(self) && ps_brdf_is_below_horizon(brdf)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: the lobe goes below the horizon, and the points are on the "
                       "hemisphere",
                       self->kind->name);
    }
    if (self->kind->lobe->fill != NULL) {
        self->kind->lobe->fill(self);
    }
    return PSPEC_OK;
}

void ps_lobe_destroy(ps_integrand *self) {
    ps_brdf_destroy(self->own);
}

double ps_lobe_integral(const ps_integrand *self) {
    (void)self;
    return 1;
}

double ps_lobe_energy(const ps_integrand *self) {
    const double squares = ps_brdf_energy(self->own);
    return ps_integrand_is_on_hemisphere(self) ? 2 * squares - 1 / PS_PI : squares - 1 / PS_FOUR_PI;
}

pspec_status ps_lobe_zonal(const ps_integrand *self, size_t max_degree, double *out,
                           ps_error *error) {
    PS_TRY(ps_brdf_spherical(self->own, max_degree, out, error));
    ps_integrand_extend(self, max_degree, out);
    return PSPEC_OK;
}

const char *ps_lobe_note(const ps_integrand *self) {
    /* What it says of the other cut is no choice on the hemisphere. */
    return ps_integrand_is_on_hemisphere(self) ? NULL : ps_brdf_note(self->own);
}
