/* Angles as fractions of a turn, so that quadrants are exact and only an eighth of a turn is left
 * to cosine and sine, whose results are then right to about one unit in the last place of each.
 */
#ifndef PS_MATH_TURNS_H
#define PS_MATH_TURNS_H

#include <stdint.h>

/* quarters/4 + rest of a turn, |rest| <= 1/4. Only quarters mod 4 counts. */
typedef struct ps_turns {
    unsigned quarters;
    double rest;
} ps_turns;

/* turns in [0,1]; nothing is rounded. */
ps_turns ps_turns_of(double turns);
/* fraction/2^64 of a turn, rest to the last place. */
ps_turns ps_turns_of_fraction(uint64_t fraction);

/* Cosine and sine of an angle, c and s, become those of so many quarters of a turn more. */
void ps_turns_add_quarters(unsigned quarters, double c, double s, double *cosine, double *sine);
/* By + - * alone, the same bits on every machine. */
void ps_turns_cosine_sine(ps_turns angle, double *cosine, double *sine);

/* By + - * / alone, for what has to have the same bits on every machine: those of C libraries
 * differ in last places. Taylor's series up to an eighth of a turn, angle in radians: what is left
 * out is below 3e-18 of either. */
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
