/* The window that spreads points over the cells of a fine grid: Kaiser-Bessel, phi(t) = I_0(beta
 * sqrt(1 - (2t/w)^2)) / I_0(beta) for |t| <= w/2 cells, whose Fourier transform is known in closed
 * form. Everything is per axis; windows are products over the axes.
 */
#ifndef PS_ENGINES_NUFFT_WINDOW_H
#define PS_ENGINES_NUFFT_WINDOW_H

#include "base/status.h"

#include <stdint.h>

typedef struct ps_nufft_window {
    unsigned width; /* w */
    double beta;
    long double peak; /* I_0(beta): of values and transforms; losses do without */
} ps_nufft_window;

enum { PS_NUFFT_MIN_WIDTH = 2, PS_NUFFT_MAX_WIDTH = 16, PS_NUFFT_MAX_DEGREE = 25 };

/* The window of a width for frequencies up to K on n cells; its beta alone. */
ps_nufft_window ps_nufft_window_make(unsigned width, int32_t max_frequency, uint32_t n);
double ps_nufft_window_beta(unsigned width, int32_t max_frequency, uint32_t n);
double ps_nufft_window_value(const ps_nufft_window *window, double t);
/* Fourier transform at f cycles per cell. */
double ps_nufft_window_transform(const ps_nufft_window *window, long double f);

/* What aliases f + m of frequency f, |m| <= num, make of it. */
typedef struct ps_nufft_aliases {
    double squares; /* of white sets: the sum of their squares; */
    double in_step; /* of sets as regular as the grid: the square of their sum */
} ps_nufft_aliases;
ps_nufft_aliases ps_nufft_window_aliases(const ps_nufft_window *window, double f, int num);

/* What the window does to a set with unit power at every frequency, by its transform. */
typedef struct ps_nufft_loss {
    double aliasing;      /* mean over |k| <= K of |error / S|^2 from frequencies k + m n, m != 0 */
    double worst;         /* the same at the frequency where it is largest */
    double amplification; /* of white errors of the grid: root mean square, grid and frequencies */
    double edge;          /* what K is amplified by when the window is undone, beside frequency 0 */
} ps_nufft_loss;
/* No more than `worst` can be, at a fiftieth of the cost. */
double ps_nufft_window_least_worst(const ps_nufft_window *window, int32_t max_frequency,
                                   uint32_t n);
/* `amplification` alone. */
double ps_nufft_window_amplification(const ps_nufft_window *window, int32_t max_frequency,
                                     uint32_t n);
ps_nufft_loss ps_nufft_window_loss(const ps_nufft_window *window, int32_t max_frequency,
                                   uint32_t n);

/* Bin i of the window at fraction f (kernels/nufft/cells.h) as a polynomial in u = 2 f - 1. The
 * degree at which Chebyshev series of all bins are cut with an error below `error`, at most the
 * largest; odd, since kernels/nufft/window.h takes even and odd powers in pairs. */
unsigned ps_nufft_window_degree(const ps_nufft_window *window, double error);
/* coefficients[degree + 1][bins], lowest degree first; zeros in bins from the width on. */
void ps_nufft_window_polynomials(const ps_nufft_window *window, unsigned degree, unsigned bins,
                                 double *coefficients);

#endif
