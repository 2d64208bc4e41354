/* Importance "morphing": heights with equal areas become heights with the density of a lobe
 * (docs/mathematics/quadrature.md#morphing). All in t = 1 - z, which keeps the digits near the
 * pole, where narrow lobes are. */
#ifndef PS_MATH_MORPH_H
#define PS_MATH_MORPH_H

#include <stddef.h>

typedef enum ps_morph_kind {
    PS_MORPH_NONE = 0,
    PS_MORPH_DIFFUSE,       /* density z */
    PS_MORPH_GLOSSY,        /* e^{n(z-1)}, 0 <= z <= 1 */
    PS_MORPH_GLOSSY_SPHERE, /* the same on -1 <= z <= 1, from heights of the hemisphere, too */
    PS_MORPH_PHONG          /* z^n */
} ps_morph_kind;

typedef struct ps_morph {
    ps_morph_kind kind;
    double exponent; /* n */
} ps_morph;

/* z' and 1 - z' in [0,1], each with all its digits -> t = 1 - z of the height with the same share
 * of points above it; relative error of t at most 4e-16 for n = 1 .. 1e5. */
double ps_morph_polar(const ps_morph *morph, double height, double polar);

/* Morphs unit vectors [num][3] of the hemisphere z >= 0 in place; azimuths stay. Devices move
 * points to the diffuse lobe, too, with the same bits; other kinds take powers. */
void ps_morph_points(const ps_morph *morph, size_t num, double *points);

#endif
