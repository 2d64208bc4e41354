/* Cosine and sine by + - * / alone, for what has to have the same bits on every machine: those of C
 * libraries differ in last places.
 */
#ifndef PS_MATH_COSINE_SINE_H
#define PS_MATH_COSINE_SINE_H

/* Taylor's series up to an eighth of a turn, angle in radians: what is left out is below 3e-18 of
 * either. */
static inline void ps_cosine_sine(double angle, double *cosine, double *sine) {
    enum { LAST = 8 };
    const double square = angle * angle;
    double c = 1;
    double s = 1;
    for (int i = LAST; i >= 1; i--) {
        c = 1 - square * c / ((2 * i - 1) * (2 * i));
        s = 1 - square * s / ((2 * i) * (2 * i + 1));
    }
    *cosine = c;
    *sine = angle * s;
}

#endif
