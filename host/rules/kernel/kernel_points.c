/* The points of kernel systems: duplicates, and those too near each other. */
#include "rules/kernel/kernel_private.h"

#include "base/memory.h"
#include "math/sobolev.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- duplicates ---------------------------------------------------------------------------- */

typedef struct place {
    double u[3];
    size_t index;
} place;

static int compare_vectors(const double *u, const double *v) {
    for (int i = 0; i < 3; i++) {
        if (u[i] != v[i]) {
            return u[i] < v[i] ? -1 : 1;
        }
    }
    return 0;
}

static int compare_places(const void *a, const void *b) {
    const place *const p = a;
    const place *const q = b;
    const int order = compare_vectors(p->u, q->u);
    return order != 0 ? order : (p->index > q->index) - (p->index < q->index);
}

/* group[j] becomes the index of the first point that is the same as point j. */
static pspec_status find_first_ones(size_t num_points, const double *points, size_t *group,
                                    ps_error *error) {
    place *places = NULL;
    PS_TRY(PS_NEW(&places, num_points, "points in order", error));
    for (size_t j = 0; j < num_points; j++) {
        memcpy(places[j].u, points + 3 * j, sizeof places[j].u);
        places[j].index = j;
    }
    qsort(places, num_points, sizeof *places, compare_places);
    size_t first = 0;
    for (size_t j = 0; j < num_points; j++) {
        first = j > 0 && compare_vectors(places[j].u, places[first].u) == 0 ? first : j;
        group[places[j].index] = places[first].index;
    }
    free(places);
    return PSPEC_OK;
}

/* First ones come before all of their duplicates. */
pspec_status ps_kernel_points_merge(ps_kernel_system *system, const double *points,
                                    ps_error *error) {
    PS_TRY(find_first_ones(system->num_points, points, system->group, error));
    for (size_t j = 0; j < system->num_points; j++) {
        const size_t first = system->group[j];
        if (first == j) {
            memcpy(system->points + 3 * system->num, points + 3 * j, 3 * sizeof(double));
            system->group[j] = system->num++;
        } else {
            system->group[j] = system->group[first];
        }
        system->shares[system->group[j]] += 1;
    }
    for (size_t i = 0; i < system->num; i++) {
        system->shares[i] = 1 / system->shares[i];
    }
    return PSPEC_OK;
}

/* ---- near ones ----------------------------------------------------------------------------- */

size_t ps_kernel_points_nearest(const ps_kernel_system *system, size_t i, double *distance) {
    const double s = 1.5; /* |u-v| itself */
    size_t nearest = i;
    *distance = INFINITY;
    for (size_t j = 0; j < system->num; j++) {
        const double between =
            ps_sobolev_distance(s, system->points + 3 * i, system->points + 3 * j);
        if (j != i && between < *distance) {
            *distance = between;
            nearest = j;
        }
    }
    return nearest;
}

static size_t first_of(const ps_kernel_system *system, size_t group) {
    size_t j = 0;
    while (system->group[j] != group) {
        j++;
    }
    return j;
}

pspec_status ps_kernel_points_refuse(const ps_kernel_system *system, size_t i, size_t j,
                                     double distance, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "points %zu and %zu are %.3g from each other: for smoothness %g the kernel "
                   "matrix is singular in double precision; merge them or take less smoothness",
                   first_of(system, i) + 1, first_of(system, j) + 1, distance, system->smoothness);
}

/* The first point that is not the first one of its group comes before groups of its number. */
pspec_status ps_kernel_system_check_distinct(const ps_kernel_system *system, ps_error *error) {
    size_t j = 0;
    while (j < system->num_points && system->group[j] == j) {
        j++;
    }
    return j == system->num_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "points %zu and %zu are equal; an interpolant has points that differ",
                         first_of(system, system->group[j]) + 1, j + 1);
}
