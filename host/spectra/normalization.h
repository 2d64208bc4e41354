/* Which power; the conventions at the beginning of pointspec.h have the formulas. */
#ifndef PS_SPECTRA_NORMALIZATION_H
#define PS_SPECTRA_NORMALIZATION_H

typedef enum pspec_normalization {
    /* P = N |S|^2 / W^2, N and W of each set; needs W != 0 */
    PSPEC_NORMALIZATION_POWER = 0,
    PSPEC_NORMALIZATION_EFFECTIVE = 1, /* P = |S|^2 / V */
    /* On the sphere Q(l) itself, weights 1/N where there are none; the tolerance then is of Q(l),
     * in units of (sum |w|)^2 */
    PSPEC_NORMALIZATION_PAIRS = 2,
    /* mean(N) mean(|S|^2 / W^2), what the variance of an integral is made of: where all sets have
     * one N the powers of PSPEC_NORMALIZATION_POWER */
    PSPEC_NORMALIZATION_INTEGRAL = 3
} pspec_normalization;

#endif
