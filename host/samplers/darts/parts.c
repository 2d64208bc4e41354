#include "samplers/darts/parts.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_DIMENSION = PS_PARTS_MOST_DIMENSION,
    /* Splits of a cell; what is left then is narrower than 1e-9 radii and counts as covered. */
    MOST_SPLITS = 30,
    DARTS_AT_ONCE = 512,  /* 16 KiB of random numbers stay in the first cache */
    DARTS_TOLD = 1 << 14, /* between two words to the watch, 5 ms */
    PARTS_TOLD = 1 << 14  /* the same for parts that are split */
};

/* Darts for each cell at first, for each part later. */
static const double DARTS_PER_CELL = 1.0;
static const double DARTS_PER_PART = 0.4;

/* The number of a part's cell and its place in it. */
typedef struct parts {
    uint32_t *words; /* [num][1 + dimension] */
    size_t num, capacity;
} parts;

typedef struct darts {
    const ps_parts_space *space;
    const ps_blue_noise *asked;
    double expected;
    ps_random *random;
    double *points;
    size_t num_points;
    unsigned num_splits;
    double side; /* of a part, in sides of a cell */
    parts now, next;
    double uniforms[DARTS_AT_ONCE * (1 + MOST_DIMENSION)];
} darts;

static size_t num_parts(const darts *work) {
    return work->num_splits == 0 ? work->space->num_cells : work->now.num;
}

/* The cell and the place of part number i: at first parts are cells, and nothing is stored. */
static inline uint32_t find_part(const darts *work, size_t i, const uint32_t **at) {
    static const uint32_t whole[MOST_DIMENSION] = {0};
    if (work->num_splits == 0) {
        *at = whole;
        return (uint32_t)i;
    }
    const uint32_t *const part = work->now.words + i * (1 + work->space->dimension);
    *at = part + 1;
    return *part;
}

static pspec_status tell(const darts *work, ps_error *error) {
    return ps_blue_noise_tell(work->asked, work->num_points, work->expected, error);
}

/* numbers: which part, and where in it. */
static pspec_status throw_dart(darts *work, const double *numbers, ps_error *error) {
    const ps_parts_space *const space = work->space;
    double place[PS_PARTS_MOST_WIDTH];
    const uint32_t *at = NULL;
    /* A number below 1 has at most 53 digits, so its product with a whole number stays below. */
    const size_t chosen = (size_t)(numbers[0] * (double)num_parts(work));
    const uint32_t cell = find_part(work, chosen, &at);
    if (!space->throw_dart(space->self, cell, at, work->side, numbers + 1, place)) {
        return PSPEC_OK;
    }
    if (work->num_points == work->asked->most_points) {
        return ps_blue_noise_fail_room(work->asked, error);
    }
    memcpy(work->points + work->num_points * space->width, place, space->width * sizeof *place);
    space->put(space->self, cell, work->num_points++);
    return PSPEC_OK;
}

static pspec_status throw_darts(darts *work, ps_error *error) {
    const unsigned per_dart = 1 + work->space->dimension;
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

/* Room for the children of num more parts, and one that is written over. */
static pspec_status reserve(darts *work, size_t num, ps_error *error) {
    const unsigned dimension = work->space->dimension;
    return ps_grow((void **)&work->next.words, &work->next.capacity,
                   work->next.num + (num << dimension) + 1,
                   (1 + dimension) * sizeof *work->next.words, "free places", error);
}

static void add_children(darts *work, uint32_t cell, const uint32_t *at) {
    const unsigned dimension = work->space->dimension;
    const unsigned open = work->space->open_children(work->space->self, cell, at, work->side);
    for (unsigned child = 0; child < 1u << dimension; child++) {
        uint32_t *const words = work->next.words + work->next.num * (1 + dimension);
        words[0] = cell;
        for (unsigned a = 0; a < dimension; a++) {
            words[1 + a] = 2 * at[a] + (child >> a & 1);
        }
        work->next.num += open >> child & 1; /* or written over */
    }
}

/* Parts of one cell follow each other. */
static pspec_status split_parts(darts *work, ps_error *error) {
    const size_t num = num_parts(work);
    uint32_t entered = 0;
    bool is_open = false;
    work->next.num = 0;
    work->side /= 2;
    for (size_t i = 0; i < num; i++) {
        const uint32_t *at = NULL;
        const uint32_t cell = find_part(work, i, &at);
        if (i % PARTS_TOLD == 0) {
            PS_TRY(tell(work, error));
            PS_TRY(reserve(work, PARTS_TOLD, error));
        }
        if (i == 0 || cell != entered) {
            is_open = work->space->enter(work->space->self, cell);
            entered = cell;
        }
        if (is_open) {
            add_children(work, cell, at);
        }
    }
    work->num_splits++;
    const parts last = work->now;
    work->now = work->next;
    work->next = last;
    return PSPEC_OK;
}

static pspec_status saturate(darts *work, ps_error *error) {
    while (num_parts(work) > 0 && work->num_splits < MOST_SPLITS) {
        PS_TRY(throw_darts(work, error));
        PS_TRY(split_parts(work, error));
    }
    return PSPEC_OK;
}

pspec_status ps_parts_saturate(const ps_parts_space *space, const ps_blue_noise *asked,
                               double expected, ps_random *random, double *points,
                               size_t *num_points, ps_error *error) {
    darts work = {.space = space,
                  .asked = asked,
                  .expected = expected,
                  .random = random,
                  .points = points,
                  .side = 1};
    const pspec_status status = saturate(&work, error);
    *num_points = status == PSPEC_OK ? work.num_points : 0;
    free(work.now.words);
    free(work.next.words);
    return status;
}
