/* Places that may be free are kept as parts of cells of one size, at first all cells. Darts are
 * thrown into parts chosen uniformly, which is uniform over all free places; then parts are split,
 * and those inside one disk dropped. Covered parts are all that is ever left out, so no accepted
 * point is likelier than by plain dart throwing. */
#include "samplers/optimized/poisson_disk.h"

#include "base/memory.h"
#include "samplers/optimized/radius.h"
#include "samplers/optimized/torus_grid.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_DIMENSION = 3,
    /* Splits of a cell; what is left then is narrower than 1e-9 radii and counts as covered. */
    MOST_SPLITS = 30,
    DARTS_AT_ONCE = 512,  /* 16 KiB of random numbers stay in the first cache */
    DARTS_TOLD = 1 << 14, /* between two words to the watch, 5 ms */
    PARTS_TOLD = 1 << 14, /* the same for parts that are split */
    MOST_NEAR = 5 * 5 * 5 /* points around a cell, where g is large */
};

/* Darts for each cell at first, for each part later. */
static const double DARTS_PER_CELL = 1.0;
static const double DARTS_PER_PART = 0.4;

/* A part is the number of its cell and its place in it along each axis, in its own sides. */
typedef struct parts {
    uint32_t *words; /* [num][1 + dimension] */
    size_t num, capacity;
} parts;

typedef struct darts {
    const ps_blue_noise *asked;
    ps_random *random;
    double *points;
    size_t num_points;
    double expected; /* points, for the watch */
    ps_torus_grid grid;
    unsigned num_splits;
    double side; /* of a part, in sides of a cell */
    parts now, next;
    double *near; /* [..][dimension], points around a cell */
    size_t num_near;
    double uniforms[DARTS_AT_ONCE * (1 + MOST_DIMENSION)];
} darts;

static size_t num_parts(const darts *work) {
    return work->num_splits == 0 ? work->grid.num_cells : work->now.num;
}

/* ---- throwing ------------------------------------------------------------------------------ */

/* numbers: which part, and where in it. False where rounding leaves the torus. */
static inline bool place_dart(const darts *work, const double *numbers, uint32_t *indices,
                              double *place) {
    static const uint32_t whole[MOST_DIMENSION] = {0};
    const unsigned dimension = work->grid.dimension;
    /* A number below 1 has at most 53 digits, so its product with a whole number stays below. */
    const size_t chosen = (size_t)(numbers[0] * (double)num_parts(work));
    const uint32_t *const part = work->now.words + chosen * (1 + dimension);
    const bool is_cell = work->num_splits == 0;
    const uint32_t *const at = is_cell ? whole : part + 1;
    bool is_inside = true;
    ps_torus_grid_indices(&work->grid, is_cell ? chosen : *part, indices);
    for (unsigned a = 0; a < dimension; a++) {
        place[a] = (indices[a] + (at[a] + numbers[1 + a]) * work->side) / work->grid.num_side;
        is_inside = is_inside && place[a] < 1;
    }
    return is_inside;
}

static pspec_status throw_dart(darts *work, const double *numbers, ps_error *error) {
    uint32_t indices[MOST_DIMENSION];
    double place[MOST_DIMENSION];
    if (!place_dart(work, numbers, indices, place) ||
        !ps_torus_grid_is_free(&work->grid, indices, place)) {
        return PSPEC_OK;
    }
    if (work->num_points == work->asked->most_points) {
        return ps_blue_noise_fail_room(work->asked, error);
    }
    memcpy(work->points + work->num_points * work->grid.dimension, place,
           work->grid.dimension * sizeof *place);
    ps_torus_grid_put(&work->grid, ps_torus_grid_cell(&work->grid, indices), work->num_points);
    work->num_points++;
    return PSPEC_OK;
}

static pspec_status tell(const darts *work, ps_error *error) {
    return ps_blue_noise_tell(work->asked, work->num_points, work->expected, error);
}

static pspec_status throw_darts(darts *work, ps_error *error) {
    const unsigned per_dart = 1 + work->grid.dimension;
    const double per_part = work->num_splits == 0 ? DARTS_PER_CELL : DARTS_PER_PART;
    const size_t num = 1 + (size_t)((double)num_parts(work) * per_part);
    for (size_t done = 0; done < num;) {
        const size_t count = num - done < DARTS_AT_ONCE ? num - done : DARTS_AT_ONCE;
        if (done % DARTS_TOLD == 0) {
            PS_TRY(tell(work, error));
        }
        ps_random_fill_uniform(work->random, work->uniforms, count * per_dart);
        for (size_t i = 0; i < count; i++) {
            PS_TRY(throw_dart(work, work->uniforms + i * per_dart, error));
        }
        done += count;
    }
    return PSPEC_OK;
}

/* ---- splitting ----------------------------------------------------------------------------- */

/* The points that reach into a cell, relative to its corner and in its sides. */
static void gather_near(darts *work, size_t cell) {
    const ps_torus_grid *const grid = &work->grid;
    const unsigned dimension = grid->dimension;
    uint32_t indices[MOST_DIMENSION];
    ps_torus_grid_indices(grid, cell, indices);
    work->num_near = 0;
    for (size_t i = 1; i < grid->near.num; i++) {
        int shifts[MOST_DIMENSION];
        const uint32_t number =
            ps_torus_grid_neighbour(grid, indices, grid->near.items + i, shifts);
        if (number != 0) {
            const double *const point = work->points + (size_t)(number - 1) * dimension;
            double *const near = work->near + work->num_near++ * dimension;
            for (unsigned a = 0; a < dimension; a++) {
                near[a] = (point[a] + shifts[a]) * grid->num_side - indices[a];
            }
        }
    }
}

/* Does the disk of one point cover the part whose lowest corner this is? */
static inline bool is_covered(const darts *work, const unsigned dimension, const double *corner) {
    const double reach = work->grid.num_side * work->asked->radius;
    const double square_reach = reach * reach;
    for (size_t i = 0; i < work->num_near; i++) {
        const double *const near = work->near + i * dimension;
        double square = 0;
        for (unsigned a = 0; a < dimension; a++) {
            const double low = near[a] - corner[a];
            const double high = work->side - low;
            const double farthest = low > high ? low : high; /* from the point to a side */
            square += farthest * farthest;
        }
        if (square < square_reach) {
            return true;
        }
    }
    return false;
}

static inline void split_part(darts *work, const unsigned dimension, uint32_t cell,
                              const uint32_t *at) {
    for (unsigned child = 0; child < 1u << dimension; child++) {
        double corner[MOST_DIMENSION];
        uint32_t *const words = work->next.words + work->next.num * (1 + dimension);
        words[0] = cell;
        for (unsigned a = 0; a < dimension; a++) {
            words[1 + a] = 2 * at[a] + (child >> a & 1);
            corner[a] = words[1 + a] * work->side;
        }
        work->next.num += !is_covered(work, dimension, corner); /* or written over */
    }
}

/* Room for the children of num more parts, and one that is written over. */
static pspec_status reserve(darts *work, size_t num, ps_error *error) {
    const unsigned dimension = work->grid.dimension;
    return ps_grow((void **)&work->next.words, &work->next.capacity,
                   work->next.num + (num << dimension) + 1,
                   (1 + dimension) * sizeof *work->next.words, "free places", error);
}

static pspec_status split_parts(darts *work, ps_error *error) {
    static const uint32_t whole[MOST_DIMENSION] = {0};
    const bool is_cell = work->num_splits == 0;
    const unsigned dimension = work->grid.dimension;
    const size_t num = num_parts(work);
    size_t gathered = work->grid.num_cells; /* none */
    work->next.num = 0;
    work->side /= 2;
    for (size_t i = 0; i < num; i++) {
        if (i % PARTS_TOLD == 0) {
            PS_TRY(tell(work, error));
            PS_TRY(reserve(work, PARTS_TOLD, error));
        }
        const uint32_t *const part = work->now.words + i * (1 + dimension);
        const size_t cell = is_cell ? i : *part;
        if (work->grid.numbers[cell] != 0) {
            continue;
        }
        if (cell != gathered) {
            gather_near(work, cell);
            gathered = cell;
        }
        const uint32_t *const at = is_cell ? whole : part + 1;
        if (dimension == 2) {
            split_part(work, 2, (uint32_t)cell, at);
        } else {
            split_part(work, MOST_DIMENSION, (uint32_t)cell, at);
        }
    }
    work->num_splits++;
    const parts last = work->now;
    work->now = work->next;
    work->next = last;
    return PSPEC_OK;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static pspec_status fill(darts *work, ps_error *error) {
    PS_TRY(ps_torus_radius_check(work->asked->dimension, work->asked->radius, error));
    PS_TRY(ps_torus_grid_create(&work->grid, work->asked->dimension, work->asked->radius, 0,
                                work->points, error));
    PS_TRY(PS_NEW(&work->near, work->grid.near.num * work->grid.dimension, "near points", error));
    while (num_parts(work) > 0 && work->num_splits < MOST_SPLITS) {
        PS_TRY(throw_darts(work, error));
        PS_TRY(split_parts(work, error));
    }
    return PSPEC_OK;
}

pspec_status ps_poisson_disk_points(const ps_blue_noise *asked, ps_random *random, double *points,
                                    size_t *num_points, ps_error *error) {
    darts work = {.asked = asked, .random = random, .points = points, .side = 1};
    if (asked->radius > 0) {
        work.expected = ps_poisson_disk_expected(asked->dimension, asked->radius);
    }
    const pspec_status status = fill(&work, error);
    *num_points = status == PSPEC_OK ? work.num_points : 0;
    ps_torus_grid_free(&work.grid);
    free(work.now.words);
    free(work.next.words);
    free(work.near);
    return status;
}
