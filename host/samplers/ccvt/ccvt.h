/* Capacity-constrained Voronoi tessellation (M. Balzer, T. Schloemer, O. Deussen 2009) of the torus
 * of the plane and of the sphere: every site owns M of N M background points, never more or fewer.
 * Two sites whose regions meet exchange points where that lowers the sum of squared distances from
 * points to their sites, then sites move to where this sum is least for their points. It ends with
 * a pass over all pairs in which no exchange lowers it (docs/samplers/optimized.md#ccvt).
 *
 * Coordinates are in arrays of their own, those of the points of site i from i M on, so that an
 * exchange is one of numbers and every loop over a region runs straight through memory.
 */
#ifndef PS_SAMPLERS_CCVT_CCVT_H
#define PS_SAMPLERS_CCVT_CCVT_H

#include "base/watch.h"
#include "math/random/random.h"
#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_CCVT_AXES = 3 /* at most */ };

/* The square or cube that holds all coordinates. */
typedef struct ps_ccvt_room {
    unsigned axes;
    bool is_periodic;
    double low, width;
} ps_ccvt_room;

typedef struct ps_ccvt_grid {
    ps_ccvt_room room;
    size_t num;
    unsigned most_side, side; /* cells along an axis: room for, used now */
    uint32_t *first;          /* of a cell; [cells + 1] */
    uint32_t *sorted;         /* sites by cells */
    uint32_t *cell;           /* of a site */
} ps_ccvt_grid;

/* For num sites. ps_ccvt_grid_destroy also after an error. */
pspec_status ps_ccvt_grid_create(ps_ccvt_grid *grid, ps_ccvt_room room, size_t num,
                                 ps_error *error) PS_MUST_CHECK;
void ps_ccvt_grid_destroy(ps_ccvt_grid *grid);

/* Takes the sites as they are now, for distances up to reach. */
void ps_ccvt_grid_fill(ps_ccvt_grid *grid, double *const *site, double reach);

/* Numbers above i of all sites that may be within reach of site i, and of others. */
size_t ps_ccvt_grid_later(const ps_ccvt_grid *grid, uint32_t i, uint32_t *near);

/* Points of a region: with fewer than the first they say nothing of areas, and a region of more
 * than the second is finer than anybody needs. Of all background points so many take a gigabyte. */
enum { PS_CCVT_LEAST_CAPACITY = 4, PS_CCVT_MOST_CAPACITY = 1 << 14 };
#define PS_CCVT_MOST_BACKGROUND (UINT64_C(1) << 24)

typedef struct ps_ccvt ps_ccvt;

/* What torus and sphere have of their own. */
typedef struct ps_ccvt_space {
    ps_ccvt_room room; /* where coordinates are */
    const char *phase; /* that the watch hears */
    /* Draws the sites, then the background. */
    pspec_status (*draw)(ps_ccvt *ccvt, ps_random *random, ps_error *error);
    /* Squared distances from points first .. first + num - 1 to the place. */
    void (*costs)(double *const *at, size_t first, size_t num, const double *place, double *out);
    /* Moves the place to where the sum of squared distances of these points is least; on the sphere
     * nearer to it. */
    void (*move)(double *const *at, size_t first, size_t num, double *place);
    /* Sorts points into bands (of heights), and along a band. */
    double (*height)(const double *place);
    double (*along)(const double *place);
    double aspect; /* number of bands^2 / number of sites for which a site's part is square */
} ps_ccvt_space;

/* One of the points that two sites may exchange. */
typedef struct ps_ccvt_offer {
    double gain; /* of squared distance, were it the other's */
    uint32_t slot;
} ps_ccvt_offer;

struct ps_ccvt {
    const ps_ccvt_space *space;
    size_t num, capacity;
    double *site[PS_CCVT_AXES]; /* coordinates of sites, and of background points by sites */
    double *at[PS_CCVT_AXES];
    double *own;       /* squared distance of a point to its site */
    double *reach;     /* distance from a site to its farthest point */
    uint32_t *changed; /* the pass in which a site last changed */
    ps_ccvt_grid grid;
    uint32_t *near;         /* sites about one */
    double *other[2];       /* squared distances of the points of two sites to the other */
    ps_ccvt_offer *pile[2]; /* heaps of offers */
    double least_gain;      /* below it an exchange is a matter of rounding */
    const ps_watch *watch;
    size_t untold; /* distances that were taken since the watch was told */
    uint32_t num_passes;
    uint64_t num_swaps;
};

typedef struct ps_ccvt_outcome {
    uint32_t passes; /* over pairs of sites */
    double energy;   /* sum of squared distances from points to their sites */
} ps_ccvt_outcome;

/* Refuses numbers outside the limits with a sentence. */
pspec_status ps_ccvt_check(size_t num, uint64_t capacity, ps_error *error) PS_MUST_CHECK;

/* Sites at random and the background, before anything is optimised. ps_ccvt_destroy also after an
 * error. */
pspec_status ps_ccvt_create(ps_ccvt *ccvt, const ps_ccvt_space *space, size_t num, size_t capacity,
                            ps_random *random, const ps_watch *watch,
                            ps_error *error) PS_MUST_CHECK;
void ps_ccvt_destroy(ps_ccvt *ccvt);

/* Sorts sites and points along bands and gives each site the points that have its place there. */
pspec_status ps_ccvt_start(ps_ccvt *ccvt, ps_error *error) PS_MUST_CHECK;
/* That, and all distances. */
pspec_status ps_ccvt_begin(ps_ccvt *ccvt, ps_error *error) PS_MUST_CHECK;
/* One pass over all pairs of which a site changed since they last met. */
pspec_status ps_ccvt_pass(ps_ccvt *ccvt, ps_error *error) PS_MUST_CHECK;
/* The moves after it, of sites that changed; none after the first pass. */
pspec_status ps_ccvt_move(ps_ccvt *ccvt, ps_error *error) PS_MUST_CHECK;
/* Passes and moves until a pass changes nothing. */
pspec_status ps_ccvt_run(ps_ccvt *ccvt, ps_error *error) PS_MUST_CHECK;

/* Sites as points [num][axes]. outcome may be NULL. */
void ps_ccvt_give(const ps_ccvt *ccvt, double *points, ps_ccvt_outcome *outcome);

/* All of it. outcome may be NULL. */
pspec_status ps_ccvt_make(const ps_ccvt_space *space, size_t num, size_t capacity,
                          ps_random *random, const ps_watch *watch, double *points,
                          ps_ccvt_outcome *outcome, ps_error *error) PS_MUST_CHECK;

double ps_ccvt_energy(const ps_ccvt *ccvt);

/* Exchanges what sites i and j both gain by. */
void ps_ccvt_exchange(ps_ccvt *ccvt, uint32_t i, uint32_t j);

/* Squared distances between two words to the watch: about 10 ms. */
enum { PS_CCVT_WORK_AT_A_TIME = 1 << 20 };

/* After so much work, in distances. PSPEC_ERROR_CANCELLED when the watch asks to stop. */
static inline pspec_status ps_ccvt_go_on(ps_ccvt *ccvt, size_t work, ps_error *error) {
    ccvt->untold += work;
    if (ccvt->untold < PS_CCVT_WORK_AT_A_TIME) {
        return PSPEC_OK;
    }
    ccvt->untold = 0;
    return ps_watch_tell(ccvt->watch, ccvt->space->phase, ccvt->num_passes, 0, NULL, error);
}

/* Coordinates of number i of such arrays as one place. */
static inline void ps_ccvt_place(double *const *at, size_t i, unsigned axes, double *place) {
    for (unsigned a = 0; a < axes; a++) {
        place[a] = at[a][i];
    }
}

/* Capacity-constrained tessellation of the torus of the plane. The background is a lattice of one
 * generator, moved at random: its power is 0 at all low frequencies but 0
 * (docs/samplers/optimized.md#ccvt).
 */
enum { PS_TORUS_CCVT_LEAST_POINTS = 16 };

extern const ps_ccvt_space ps_torus_ccvt_space;

/* The generator g of the lattice (j, g j mod num) / num, j = 0 .. num - 1: of 128 random ones that
 * whose continued fraction of g / num has the smallest largest number, so that no vector of the
 * lattice is much shorter than it must be. Each realization has another lattice: of one for all,
 * mean spectra would have its directions. num > 1. */
uint64_t ps_torus_ccvt_generator(uint64_t num, ps_random *random);

/* Capacity-constrained tessellation of the sphere: angles as distances, and as background the
 * spherical Fibonacci points, rotated at random, whose power is near 0 at low degrees. Of random
 * ones the power of sites ends at 1/M (docs/samplers/optimized.md#ccvt).
 */
enum { PS_SPHERE_CCVT_LEAST_POINTS = 2 };

extern const ps_ccvt_space ps_sphere_ccvt_space;

#endif
