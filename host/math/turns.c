#include "math/turns.h"

#include "shared/sphere_point.h"

#include <math.h>

enum { QUARTERS = 4 };
static const double QUARTER = 0.25;
static const double EIGHTH = 0.125;

ps_turns ps_turns_of(double turns) {
    /* 4 turns and the difference are exact: the rest has no digit below those of turns. */
    const double quarters = floor(QUARTERS * turns + EIGHTH * QUARTERS);
    return (ps_turns){(unsigned)quarters, turns - quarters * QUARTER};
}

ps_turns ps_turns_of_fraction(uint64_t fraction) {
    ps_turns turns = {0};
    ps_turn_of_fraction(fraction, &turns.quarters, &turns.rest);
    return turns;
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
    ps_turn_any_cosine_sine(angle.quarters, angle.rest, cosine, sine);
}
