/* Points of a sampler: what they take, for whoever keeps them, and their pictures: the unit square,
 * a line, pairs of coordinates, both sides of the sphere. */
#ifndef PS_ANSWERS_POINTS_POINTS_H
#define PS_ANSWERS_POINTS_POINTS_H

#include "answers/figure.h"
#include "samplers/sampler.h"

/* Of so many sets, and of what makes one of them. */
double ps_points_bytes(const ps_sampler_request *sampler, double num_sets);
/* So many sets are in memory at a time: PSPEC_ERROR_MEMORY where they take more than the limit in
 * bytes; 0: than this machine has left. */
pspec_status ps_points_check_memory(const ps_sampler_request *sampler, double num_sets,
                                    uint64_t limit, ps_error *error) PS_MUST_CHECK;

/* Of more points a picture shows a corner of the square, or the middle of the sides of the sphere,
 * where so many are at most: in a frame of 860 pixels they are 3.4 apart, and marks as small as a
 * pixel can still be told from each other. Of a line that is so much less. */
enum { PS_MOST_DRAWN = 1 << 16, PS_MOST_DRAWN_OF_LINE = 1 << 8 };

/* A set as somebody has it: the points of the torus in [0,1), unit vectors. */
typedef struct ps_drawn_set {
    const char *name; /* for the panel, where there are several sets; borrowed */
    ps_sampler_domain where;
    unsigned dimension; /* numbers of a point */
    size_t num_points;
    const double *points;
} ps_drawn_set;

/* {.num_sets = N, .memory = ..}: nothing yet. What it has is freed with the pool. */
typedef struct ps_points_picture {
    size_t num_sets; /* that there will be: panels of one of several are named */
    ps_pool *memory;
    size_t num_points; /* of the set that came last */
    size_t num;
    ps_panel *panels; /* of the figure */
} ps_points_picture;

/* Adds the panels of a set, and keeps nothing of it. In the plane one; of more dimensions every
 * pair of coordinates, but the first alone where there are several sets; of the sphere the sides
 * z >= 0 and z < 0, each from outside: x runs to the right of the one and to the left of the other;
 * of the hemisphere the first of these. watch is told of large sets. */
pspec_status ps_points_picture_add(ps_points_picture *self, const ps_drawn_set *set,
                                   const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
/* The figure of all of them, of one at least; it borrows from the title. */
ps_figure ps_points_picture_figure(const ps_points_picture *self, const char *title);
/* The first realization of each part, whose array is coordinates, [M][N][D]. */
ps_make_figure ps_points_figure;

#endif
