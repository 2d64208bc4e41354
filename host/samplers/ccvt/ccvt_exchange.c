/* Two sites and their points. Of all exchanges of one point for one, the best take the point with
 * the largest gain of either site, then those with the next, until a pair gains nothing: what is
 * left is the best way to divide the points between the two. */
#include "samplers/ccvt/ccvt.h"

#include <math.h>

/* The largest gain of a point of site i that goes to the other; the distances are kept. */
static double try_points(ps_ccvt *c, uint32_t i, uint32_t to, unsigned pile) {
    const size_t first = (size_t)i * c->capacity;
    const double *const own = c->own + first;
    double *const other = c->other[pile];
    double place[PS_CCVT_AXES] = {0};
    ps_ccvt_place(c->site, to, c->space->room.axes, place);
    c->space->costs(c->at, first, c->capacity, place, other);
    double most = own[0] - other[0];
    for (size_t k = 1; k < c->capacity; k++) {
        const double gain = own[k] - other[k];
        most = gain > most ? gain : most;
    }
    return most;
}

/* ---- heaps --------------------------------------------------------------------------------- */

static void sink(ps_ccvt_offer *pile, size_t num, size_t at) {
    const ps_ccvt_offer moved = pile[at];
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= num) {
            break;
        }
        child += child + 1 < num && pile[child + 1].gain > pile[child].gain;
        if (!(pile[child].gain > moved.gain)) {
            break;
        }
        pile[at] = pile[child];
        at = child;
    }
    pile[at] = moved;
}

/* Offers with more than this gain, the best on top. */
static size_t pile_up(ps_ccvt *c, uint32_t i, unsigned pile, double least) {
    const size_t first = (size_t)i * c->capacity;
    ps_ccvt_offer *const offers = c->pile[pile];
    size_t num = 0;
    for (size_t k = 0; k < c->capacity; k++) {
        const double gain = c->own[first + k] - c->other[pile][k];
        offers[num] = (ps_ccvt_offer){gain, (uint32_t)k};
        num += gain > least;
    }
    for (size_t k = num / 2; k-- > 0;) {
        sink(offers, num, k);
    }
    return num;
}

static size_t take_top(ps_ccvt_offer *pile, size_t num) {
    pile[0] = pile[num - 1];
    sink(pile, num - 1, 0);
    return num - 1;
}

/* ---- exchanges ----------------------------------------------------------------------------- */

static void swap_points(ps_ccvt *c, size_t p, size_t q) {
    for (unsigned a = 0; a < c->space->room.axes; a++) {
        const double kept = c->at[a][p];
        c->at[a][p] = c->at[a][q];
        c->at[a][q] = kept;
    }
}

static double far_of(double reach, double square) {
    return square > reach * reach ? sqrt(square) : reach;
}

static void exchange_tops(ps_ccvt *c, uint32_t i, uint32_t j) {
    const uint32_t a = c->pile[0][0].slot;
    const uint32_t b = c->pile[1][0].slot;
    const size_t p = (size_t)i * c->capacity + a;
    const size_t q = (size_t)j * c->capacity + b;
    swap_points(c, p, q);
    c->own[p] = c->other[1][b];
    c->own[q] = c->other[0][a];
    c->reach[i] = far_of(c->reach[i], c->own[p]); /* till the site moves, a bound */
    c->reach[j] = far_of(c->reach[j], c->own[q]);
    c->num_swaps++;
}

void ps_ccvt_exchange(ps_ccvt *c, uint32_t i, uint32_t j) {
    const double most[2] = {try_points(c, i, j, 0), try_points(c, j, i, 1)};
    if (!(most[0] + most[1] > c->least_gain)) {
        return;
    }
    size_t num[2] = {pile_up(c, i, 0, c->least_gain - most[1]),
                     pile_up(c, j, 1, c->least_gain - most[0])};
    while (num[0] > 0 && num[1] > 0 && c->pile[0][0].gain + c->pile[1][0].gain > c->least_gain) {
        exchange_tops(c, i, j);
        num[0] = take_top(c->pile[0], num[0]);
        num[1] = take_top(c->pile[1], num[1]);
    }
    c->changed[i] = c->num_passes;
    c->changed[j] = c->num_passes;
}
