#include "math/turns.h"

#include "math/pi.h"

#include <math.h>

/* 2 pi as the sum of two doubles. */
static const double TWO_PI_LOW = 2.4492935982947064e-16;
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

/* Of rest of a turn, |rest| <= 1/8. */
typedef void rest_function(double rest, double *cosine, double *sine);

/* What 2 pi rest lacks of the angle turns cosine and sine a little further. */
static void cosine_sine_of_rest(double rest, double *cosine, double *sine) {
    const double angle = PS_TWO_PI * rest;
    const double low = fma(PS_TWO_PI, rest, -angle) + TWO_PI_LOW * rest;
    const double c = cos(angle);
    const double s = sin(angle);
    *cosine = c - low * s;
    *sine = s + low * c;
}

static void portable_of_rest(double rest, double *cosine, double *sine) {
    ps_cosine_sine(PS_TWO_PI * rest, cosine, sine);
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

static void of_turns(ps_turns angle, rest_function *of_rest, double *cosine, double *sine) {
    unsigned quarters = angle.quarters;
    double rest = angle.rest;
    if (fabs(rest) > EIGHTH) { /* between 1/8 and 1/4 the difference is exact */
        quarters += rest > 0 ? 1 : QUARTERS - 1;
        rest -= rest > 0 ? QUARTER : -QUARTER;
    }
    double c = 0;
    double s = 0;
    of_rest(rest, &c, &s);
    ps_turns_add_quarters(quarters, c, s, cosine, sine);
}

void ps_turns_cosine_sine(ps_turns angle, double *cosine, double *sine) {
    of_turns(angle, cosine_sine_of_rest, cosine, sine);
}

void ps_turns_portable(ps_turns angle, double *cosine, double *sine) {
    of_turns(angle, portable_of_rest, cosine, sine);
}
