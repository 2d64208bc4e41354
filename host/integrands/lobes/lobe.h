/* A lobe of reflection is an integrand whose row has a ps_lobe, and a BRDF by the same row: one
 * file has its name, parameters and formulas. Private to host/integrands. */
#ifndef PS_INTEGRANDS_LOBES_LOBE_H
#define PS_INTEGRANDS_LOBES_LOBE_H

#include "integrands/integrand_kind.h"
#include "integrands/lobes/brdf.h"

/* Exponents that the tests cover. */
#define PS_LEAST_LOBE 1e-3
#define PS_MOST_LOBE 1e6

/* From this exponent on the cut of a glossy lobe at the horizon is below the last place (e^-40 =
 * 4e-18), and the boundary value problem of the cut lobe would lose n eps/6. */
#define PS_UNCUT_LOBE 40

/* What lobes are asked for. Members may be NULL where it says so. */
typedef struct ps_lobe {
    /* Reads values[i] of parameters[i] of the row and checks them. NULL: nothing to read. */
    pspec_status (*create)(ps_brdf *, const char *const *values, ps_error *);
    double (*norm)(const ps_brdf *);              /* r_s */
    double (*energy)(const ps_brdf *);            /* sum b_l^2 = int phat^2 dS */
    double (*density)(const ps_brdf *, double z); /* p(z) */
    /* b_0 .. b_L; and b~_0 .. b~_L, NULL where the lobe goes below the horizon. */
    pspec_status (*spherical)(const ps_brdf *, size_t max_degree, double *b, ps_error *);
    pspec_status (*hemispherical)(const ps_brdf *, size_t max_degree, double *b, ps_error *);
    bool (*is_below)(const ps_brdf *); /* has it a part below the horizon? NULL: never */
    /* D_0 = int int |u-v|^(2s-2) phat phat in closed form. NULL: not known. */
    double (*mean_distance)(const ps_brdf *, double smoothness);
    ps_morph (*morph)(const ps_brdf *);   /* that gives points its density; NULL: none known */
    const char *(*note)(const ps_brdf *); /* what a result should say of it, or NULL; may be NULL */
    /* Fills what kernels/integrands/NAME.h takes from the lobe that is self->own. NULL: nothing. */
    void (*fill)(ps_integrand *self);
} ps_lobe;

struct ps_brdf {
    const ps_integrand_kind *kind;
    double exponent;      /* n of glossy and Phong lobes */
    bool is_whole_sphere; /* glossy: not cut at the horizon */
    size_t num_nodes;     /* of a table: p is linear in z between them, 0 outside */
    double *nodes, *values;
    double *densities; /* heights and phat there, as kernels/integrands/zonal.h takes them */
};

/* Makes a lobe of a kind: values[i] is the text of its parameters[i]. */
pspec_status ps_brdf_make(ps_brdf **out, const ps_integrand_kind *kind, const char *const *values,
                          ps_error *error) PS_MUST_CHECK;

/* Reads n of a lobe, PS_LEAST_LOBE .. PS_MOST_LOBE. */
pspec_status ps_brdf_read_exponent(ps_brdf *brdf, const char *text, ps_error *error) PS_MUST_CHECK;

/* sqrt((2l+1)/(4 pi)), the value of Y_l0 at the pole. */
double ps_zonal_at_pole(size_t l);

/* What the rows of all lobes have: as integrands they are divided by their integrals, as they weigh
 * shading integrals (docs/mathematics/integrands_sphere.md#shading-lobes). */
#define PS_LOBE_ROW                                                                                \
    .domains = PS_INTEGRAND_ROUND, .create = ps_lobe_create, .destroy = ps_lobe_destroy,           \
    .integral = ps_lobe_integral, .energy = ps_lobe_energy, .zonal = ps_lobe_zonal,                \
    .note = ps_lobe_note
pspec_status ps_lobe_create(ps_integrand *self, const char *const *values,
                            ps_error *error) PS_MUST_CHECK;
void ps_lobe_destroy(ps_integrand *self);
double ps_lobe_integral(const ps_integrand *self);
double ps_lobe_energy(const ps_integrand *self);
pspec_status ps_lobe_zonal(const ps_integrand *self, size_t max_degree, double *out,
                           ps_error *error) PS_MUST_CHECK;
const char *ps_lobe_note(const ps_integrand *self);

#endif
