#include "math/turns.h"

#include "shared/sphere_point.h"

#include <math.h>

enum { QUARTERS = 4, QUARTER_BITS = 62 /* 2^62 is a quarter of 2^64 */ };
static const double FRACTION_STEP = 0x1p-64;
static const double QUARTER = 0.25;
static const double EIGHTH = 0.125;

ps_turns ps_turns_of(double turns) {
    /* 4 turns and the difference are exact: the rest has no digit below those of turns. */
    const double quarters = floor(QUARTERS * turns + EIGHTH * QUARTERS);
    return (ps_turns){(unsigned)quarters, turns - quarters * QUARTER};
}

ps_turns ps_turns_of_fraction(uint64_t fraction) {
    const uint64_t eighth = (uint64_t)1 << (QUARTER_BITS - 1);
    const uint64_t quarters = (fraction + eighth) >> QUARTER_BITS; /* 0 again for the last eighth */
    const uint64_t above = fraction - (quarters << QUARTER_BITS) + eighth; /* 0 .. 2 eighths */
    const double rest = (double)((int64_t)above - (int64_t)eighth);
    return (ps_turns){(unsigned)quarters, rest * FRACTION_STEP};
}

void ps_turns_add_quarters(unsigned quarters, double c, double s, double *cosine, double *sine) {
    switch (quarters % QUARTERS) {
    case 0:
        *cosine = c, *sine = s;
        break;
    case 1:
        *cosine = -s, *sine = c;
        break;
    case 2:
        *cosine = -c, *sine = -s;
        break;
    default:
        *cosine = s, *sine = -c;
        break;
    }
}

void ps_turns_cosine_sine(ps_turns angle, double *cosine, double *sine) {
    unsigned quarters = angle.quarters;
    double rest = angle.rest;
    if (fabs(rest) > EIGHTH) { /* between 1/8 and 1/4 the difference is exact */
        quarters += rest > 0 ? 1 : QUARTERS - 1;
        rest -= rest > 0 ? QUARTER : -QUARTER;
    }
    ps_turn_cosine_sine((double)(quarters % QUARTERS), rest, cosine, sine);
}
