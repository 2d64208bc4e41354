#include "api/kept_patterns.h"

#include "base/memory.h"
#include "base/workers.h"

#include <stdlib.h>
#include <string.h>

/* As much as the source keeps of a file (PS_SOURCE_WHOLE_BYTES): a thousand sets of four thousand
 * points in the plane. */
static const uint64_t most_by_default = (uint64_t)64 << 20;

/* Patterns that `room` numbers are enough for. Smaller ones than were announced may be more. */
static size_t count_patterns(const ps_kept_shape *shape, size_t columns, size_t room) {
    const size_t few = 64;
    const size_t by_room = (size_t)(room / columns / shape->num_points) + few;
    return shape->num_realizations > 0 && shape->num_realizations < by_room
               ? (size_t)shape->num_realizations
               : by_room;
}

static size_t count_most(const ps_kept_shape *shape) {
    const uint64_t bytes = shape->most_bytes > 0 && shape->most_bytes < most_by_default
                               ? shape->most_bytes
                               : most_by_default;
    return (size_t)(bytes / sizeof(double));
}

/* Numbers of all patterns that were announced, within bounds. */
static size_t count_numbers(const ps_kept_shape *shape, size_t columns, size_t most) {
    size_t per_pattern = 0;
    size_t numbers = 0;
    return shape->num_realizations > 0 &&
                   ps_size_multiply((size_t)shape->num_points, columns, &per_pattern) &&
                   ps_size_multiply(per_pattern, (size_t)shape->num_realizations, &numbers) &&
                   numbers < most
               ? numbers
               : most;
}

pspec_status ps_kept_patterns_create(ps_kept_patterns *kept, const ps_kept_shape *shape,
                                     ps_error *error) {
    const size_t columns = shape->dimension + 1; /* with a weight */
    const size_t most = count_most(shape);
    *kept = (ps_kept_patterns){.room = count_numbers(shape, columns, most), .most = most};
    kept->capacity = count_patterns(shape, columns, kept->room);
    PS_TRY(PS_NEW(&kept->numbers, kept->room, "patterns for a second plan", error));
    PS_TRY(PS_NEW(&kept->patterns, kept->capacity, "patterns for a second plan", error));
    return PSPEC_OK;
}

void ps_kept_patterns_free(ps_kept_patterns *kept) {
    free(kept->patterns);
    free(kept->numbers);
    *kept = (ps_kept_patterns){0};
}

uint64_t ps_kept_patterns_bytes(const ps_kept_patterns *kept) {
    return (uint64_t)kept->room * sizeof *kept->numbers +
           (uint64_t)kept->capacity * sizeof *kept->patterns;
}

/* Numbers that are worth threads: 8 MiB. */
static const size_t least_shared = 1 << 20;

typedef struct copying {
    double *to;
    const double *from;
    size_t count;
} copying;

static void copy_some(void *payload, unsigned index, unsigned count) {
    const copying *work = payload;
    const size_t first = ps_share_begin(work->count, index, count);
    const size_t end = ps_share_begin(work->count, index + 1, count);
    memcpy(work->to + first, work->from + first, (end - first) * sizeof(double));
}

static const double *copy_numbers(ps_kept_patterns *kept, const double *numbers, size_t count) {
    double *const copy = kept->numbers + kept->used;
    copying all = {copy, numbers, count};
    if (count >= least_shared) {
        ps_workers_share(count, copy_some, &all);
    } else {
        copy_some(&all, 0, 1);
    }
    kept->used += count;
    return copy;
}

/* Coordinates of a pattern, and its weights behind them. */
static size_t count_coordinates(const pspec_pattern *pattern) {
    return pattern->num_points * pattern->dimension;
}

static size_t count_all(const pspec_pattern *pattern) {
    return count_coordinates(pattern) + (pattern->weights != NULL ? pattern->num_points : 0);
}

/* Numbers may have moved. */
static void point_at_numbers(ps_kept_patterns *kept) {
    size_t used = 0;
    for (size_t i = 0; i < kept->num; i++) {
        pspec_pattern *const pattern = &kept->patterns[i];
        const double *const numbers = kept->numbers + used;
        used += count_all(pattern);
        pattern->points = numbers;
        pattern->weights = pattern->weights != NULL ? numbers + count_coordinates(pattern) : NULL;
    }
}

/* Room for one more pattern of so many numbers, also where fewer or smaller ones were announced. */
static bool make_room(ps_kept_patterns *kept, size_t needed) {
    static const char what[] = "patterns for a second plan";
    void *patterns = kept->patterns;
    void *numbers = kept->numbers;
    const bool has_room = needed <= kept->most - kept->used &&
                          ps_grow(&patterns, &kept->capacity, kept->num + 1, sizeof *kept->patterns,
                                  what, NULL) == PSPEC_OK &&
                          ps_grow(&numbers, &kept->room, kept->used + needed, sizeof *kept->numbers,
                                  what, NULL) == PSPEC_OK;
    kept->patterns = patterns;
    if (numbers != kept->numbers) {
        kept->numbers = numbers;
        point_at_numbers(kept);
    }
    return has_room;
}

static bool add_one(ps_kept_patterns *kept, const pspec_pattern *pattern) {
    const size_t coordinates = count_coordinates(pattern);
    if (!make_room(kept, count_all(pattern))) {
        return false;
    }
    pspec_pattern *const copy = &kept->patterns[kept->num++];
    *copy = *pattern;
    copy->points = copy_numbers(kept, pattern->points, coordinates);
    if (pattern->weights != NULL) {
        copy->weights = copy_numbers(kept, pattern->weights, pattern->num_points);
    }
    return true;
}

void ps_kept_patterns_add(ps_kept_patterns *kept, const pspec_pattern *patterns, size_t num) {
    for (size_t i = 0; i < num && !kept->is_partial; i++) {
        kept->is_partial = !add_one(kept, &patterns[i]);
    }
}

void ps_kept_patterns_reset(ps_kept_patterns *kept) {
    kept->num = 0;
    kept->used = 0;
    kept->is_partial = false;
}
