/* Functions of the sphere at the centres of the pixels of an equirectangular image, whose top row
 * is nearest to +z: pixel (i, j) of H x W has its centre at theta = pi (i + 1/2)/H, phi = 2 pi (j +
 * 1/2)/W.
 */
#ifndef PS_JOBS_INTERPOLATION_PANORAMA_H
#define PS_JOBS_INTERPOLATION_PANORAMA_H

#include "integrands/integrand.h"

typedef struct ps_panorama {
    size_t width, height;
    size_t num;                /* functions */
    ps_integrand **integrands; /* [num], of made ones */
    ps_made_integrands own;    /* where no others are shared */
    double *values;            /* [num][height][width] of ps_panorama_fill; NULL before */
} ps_panorama;

/* With the pixels of the maps among the functions, which all have the same; without any map 512 x
 * 256. made: shared with others, and outlives it; NULL: none. *out is {0} before, and freed by
 * ps_panorama_free, also after an error. */
pspec_status ps_panorama_make(ps_panorama *out, ps_made_integrands *made,
                              const ps_given_integrands *given, const char *const *texts,
                              size_t num, ps_error *error) PS_MUST_CHECK;
/* Its values, which plans and checks do without. */
pspec_status ps_panorama_fill(ps_panorama *panorama, ps_error *error) PS_MUST_CHECK;
void ps_panorama_free(ps_panorama *panorama);

/* Unit vectors [num_rows][width][3] of the centres of some rows. */
void ps_panorama_directions(const ps_panorama *panorama, size_t first_row, size_t num_rows,
                            double *out);
/* What a pixel of the row has of the solid angle of the sphere: exact, also beside a pole. */
double ps_panorama_share(const ps_panorama *panorama, size_t row);
/* Values of a function at any unit vectors [num][3]; an integrand of a caller may fail. */
pspec_status ps_panorama_values(const ps_panorama *panorama, size_t function, const double *points,
                                size_t num, double *values, ps_error *error) PS_MUST_CHECK;

#endif
