/* What the files of the lobes share. Private to host/integrands. */
#ifndef PS_INTEGRANDS_BRDF_KIND_H
#define PS_INTEGRANDS_BRDF_KIND_H

#include "integrands/brdf.h"
#include "math/pi.h"

#include <stddef.h>

/* Exponents that the tests cover. */
#define PS_LEAST_LOBE 1e-3
#define PS_MOST_LOBE 1e6

/* From this exponent on the cut of a glossy lobe at the horizon is below the last place (e^-40 =
 * 4e-18), and the boundary value problem of the cut lobe would lose n eps/6. */
#define PS_UNCUT_LOBE 40

/* What the tables of lobes and of integrands both say of them. */
#define PS_DIFFUSE_SUMMARY "max(0, z), z the cosine to the axis"
#define PS_GLOSSY_SUMMARY "e^{n(z-1)}, a Gaussian lobe"
#define PS_PHONG_SUMMARY "max(0, z)^n"
#define PS_ZONAL_SUMMARY "a table from a file, linear in z between its rows, 0 outside"
#define PS_EXPONENT_PARAMETER                                                                      \
    { "n", "", "exponent, 0.001 to 1e6; must be given" }
#define PS_CUT_PARAMETER                                                                           \
    { "cut", "horizon", "horizon|none: 0 below the horizon, or the lobe on the whole sphere" }
#define PS_FILE_PARAMETER                                                                          \
    { "file", "", "rows of direction and value; must be given" }
#define PS_UNIT_PARAMETER                                                                          \
    { "of", "cosine", "cosine|degrees|radians: what the first column is, to the axis" }

struct ps_brdf {
    const ps_brdf_kind *kind;
    double exponent;      /* n of glossy and Phong lobes */
    bool is_whole_sphere; /* glossy: not cut at the horizon */
    size_t num_nodes;     /* of a table: p is linear in z between them, 0 outside */
    double *nodes, *values;
    char *path;        /* of the file, of an integrand alone, */
    double *densities; /* and heights and densities as kernels/integrands/zonal.h takes them */
};

extern const ps_brdf_kind ps_brdf_diffuse, ps_brdf_glossy, ps_brdf_phong, ps_brdf_zonal;

/* Makes a lobe of a kind: values[i] is the text of its parameters[i]. */
pspec_status ps_brdf_make(ps_brdf **out, const ps_brdf_kind *kind, const char *const *values,
                          ps_error *error) PS_MUST_CHECK;

/* Reads n of a lobe, PS_LEAST_LOBE .. PS_MOST_LOBE. */
pspec_status ps_brdf_read_exponent(ps_brdf *brdf, const char *text, ps_error *error) PS_MUST_CHECK;

/* sqrt((2l+1)/(4 pi)), the value of Y_l0 at the pole. */
double ps_zonal_at_pole(size_t l);

#endif
