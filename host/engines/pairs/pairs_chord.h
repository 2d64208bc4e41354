/* A power of a chord that the bins of a histogram can sum up: the kernel r^(2 power) is not smooth
 * at 0, and has a polynomial in its place below a distance rho; pairs that are nearer are corrected
 * one by one (engines/pairs/pairs_isotropic.c). */
#ifndef PS_ENGINES_PAIRS_PAIRS_CHORD_H
#define PS_ENGINES_PAIRS_PAIRS_CHORD_H

#include "engines/pairs/pairs_bins.h"

/* Terms of the polynomial below rho: as many derivatives as the remainder of a bin asks for. */
enum { PS_CHORD_TERMS = PS_PAIRS_MOMENTS };

typedef struct ps_chord {
    double power, rho_square;
    double binomials[PS_CHORD_TERMS];
    double bound; /* of what bins lose */
} ps_chord;

/* With the smallest rho, in whole bins, for which they lose no more than the tolerance; all of them
 * where that is not to be had. */
ps_chord ps_chord_make(double power, size_t num_bins, double tolerance);
/* The kernel itself, and the polynomial, of the square of a chord. */
double ps_chord_power(const ps_chord *shape, double square);
double ps_chord_below_rho(const ps_chord *shape, double square);

#endif
