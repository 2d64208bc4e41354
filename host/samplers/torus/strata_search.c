/* Products f_1 <= f_2 <= .. <= f_d <= 2 f_1: enumerated in ascending order of the factors. */
#include "samplers/torus/strata.h"

enum { MAXIMUM_ASPECT = 2 };

/* f * f * .. (num_factors times), or limit + 1 as soon as it exceeds limit. */
static uint64_t bounded_power(uint64_t f, unsigned num_factors, uint64_t limit) {
    uint64_t product = 1;
    for (unsigned i = 0; i < num_factors; i++) {
        if (product > limit / f) {
            return limit + 1;
        }
        product *= f;
    }
    return product;
}

/* The smallest first factor worth trying: with it, f (2f)^(d-1) just reaches num_points. */
static uint64_t smallest_first(uint64_t num_points, unsigned dimension) {
    const uint64_t others = (uint64_t)1 << (dimension - 1); /* MAXIMUM_ASPECT^(d-1) */
    uint64_t low = 1;
    uint64_t high = num_points;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (bounded_power(middle, dimension, num_points) >= (num_points + others - 1) / others) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

typedef struct search {
    uint64_t num_points;
    unsigned dimension;
    uint64_t factors[PS_MAX_DIMENSION]; /* being tried */
    uint64_t best[PS_MAX_DIMENSION];    /* best[0] == 0: none yet */
    uint64_t below, above;
} search;

static void keep_if_squarer(search *s) {
    const unsigned last = s->dimension - 1;
    if (s->best[0] != 0 && s->factors[last] * s->best[0] >= s->best[last] * s->factors[0]) {
        return;
    }
    for (unsigned i = 0; i < s->dimension; i++) {
        s->best[i] = s->factors[i];
    }
}

/* Factors from number i on, whose product must be rest. */
static void factorise_rest(search *s, unsigned i, uint64_t rest) {
    const uint64_t smallest = s->factors[i - 1];
    const uint64_t largest = MAXIMUM_ASPECT * s->factors[0];
    if (i + 1 == s->dimension) {
        s->factors[i] = rest;
        if (rest >= smallest && rest <= largest) {
            keep_if_squarer(s);
        }
        return;
    }
    for (uint64_t f = smallest; f <= largest; f++) {
        if (bounded_power(f, s->dimension - i, rest) > rest) {
            return;
        }
        if (rest % f == 0) {
            s->factors[i] = f;
            factorise_rest(s, i + 1, rest / f);
        }
    }
}

bool ps_strata_factorise(uint64_t num_points, unsigned dimension,
                         uint64_t counts[PS_MAX_DIMENSION]) {
    search s = {.num_points = num_points, .dimension = dimension};
    if (dimension == 1) {
        counts[0] = num_points;
        return true;
    }
    for (uint64_t f = smallest_first(num_points, dimension);
         bounded_power(f, dimension, num_points) <= num_points; f++) {
        if (num_points % f == 0) {
            s.factors[0] = f;
            factorise_rest(&s, 1, num_points / f);
        }
    }
    for (unsigned i = 0; i < dimension; i++) {
        counts[i] = s.best[i];
    }
    return s.best[0] != 0;
}

static void keep_if_nearer(search *s, uint64_t product) {
    if (product <= s->num_points && product > s->below) {
        s->below = product;
    }
    if (product >= s->num_points && product < s->above) {
        s->above = product;
    }
}

/* The last factor takes the product to either side of num_points, within its own limits. */
static void try_last(search *s, uint64_t product) {
    const uint64_t smallest = s->factors[s->dimension - 2];
    const uint64_t largest = MAXIMUM_ASPECT * s->factors[0];
    const uint64_t quotient = s->num_points / product;
    for (uint64_t f = quotient; f <= quotient + 1; f++) {
        const uint64_t clamped = f < smallest ? smallest : f > largest ? largest : f;
        keep_if_nearer(s, product * clamped);
    }
}

/* Tries factors from number i on; the first ones have the given product. */
static void approach(search *s, unsigned i, uint64_t product) {
    const unsigned last = s->dimension - 1;
    if (i >= last || i >= PS_MAX_DIMENSION) { /* the second, for compilers that inline this */
        try_last(s, product);
        return;
    }
    const uint64_t largest = MAXIMUM_ASPECT * s->factors[0];
    const uint64_t room = s->num_points / product;
    for (uint64_t f = s->factors[i - 1]; f <= largest; f++) {
        s->factors[i] = f;
        approach(s, i + 1, product * f);
        if (bounded_power(f, s->dimension - i, room) > room) {
            return; /* from here on every product is above num_points, and growing */
        }
    }
}

void ps_strata_nearest(uint64_t num_points, unsigned dimension, uint64_t *below, uint64_t *above) {
    search s = {.num_points = num_points, .dimension = dimension, .above = UINT64_MAX};
    const uint64_t first = smallest_first(num_points, dimension);
    for (uint64_t f = first > 1 ? first - 1 : 1;; f++) {
        s.factors[0] = f;
        approach(&s, 1, f);
        if (bounded_power(f, dimension, num_points) > num_points) {
            break;
        }
    }
    *below = s.below;
    *above = s.above;
}
