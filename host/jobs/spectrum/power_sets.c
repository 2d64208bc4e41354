#include "jobs/spectrum/power_sets.h"

#include "base/memory.h"
#include "points/lists/weight_list.h"

#include <stdlib.h>
#include <string.h>

static void free_batch(ps_power_sets *sets) {
    for (size_t i = 0; i < sets->capacity; i++) {
        ps_point_set_free(&sets->sets[i]);
    }
    free(sets->sets);
    free(sets->patterns);
    sets->sets = NULL;
    sets->patterns = NULL;
    sets->capacity = 0;
}

void ps_power_sets_release(ps_power_sets *sets) {
    ps_point_set_free(&sets->next);
    ps_point_set_free(&sets->after);
    sets->has_next = sets->has_after = false;
    free_batch(sets);
}

void ps_power_sets_free(ps_power_sets *sets) {
    if (!sets->is_borrowed) {
        ps_source_destroy(sets->source);
    }
    ps_power_sets_release(sets);
    ps_point_set_free(&sets->first);
    free(sets->weights);
    *sets = (ps_power_sets){0};
}

pspec_status ps_power_sets_read_weights(ps_power_sets *sets, const char *path, uint64_t num_points,
                                        ps_error *error) {
    sets->weights_path = path;
    return ps_read_weights(path, num_points, &sets->weights, &sets->num_weights, error);
}

pspec_status ps_power_sets_allocate(ps_power_sets *sets, size_t capacity, ps_error *error) {
    free_batch(sets);
    /* When a job plans again, a set that is left of the run before is one more than announced. */
    if (!sets->has_next) {
        ps_point_set_free(&sets->next);
    }
    PS_TRY(PS_NEW(&sets->patterns, capacity, "patterns", error));
    PS_TRY(PS_NEW(&sets->sets, capacity, "patterns", error));
    sets->capacity = capacity;
    return PSPEC_OK;
}

pspec_status ps_power_sets_rewind(ps_power_sets *sets, ps_error *error) {
    sets->has_next = sets->has_after = false;
    sets->has_looked = false;
    sets->first_cells = (ps_axis_cells){0};
    return ps_source_rewind(sets->source, error);
}

static void exchange(ps_point_set *a, ps_point_set *b) {
    const ps_point_set kept = *a;
    *a = *b;
    *b = kept;
}

static pspec_status read_set(ps_power_sets *sets, ps_point_set *set, ps_source_part *part,
                             bool *has_set, ps_error *error) {
    PS_TRY(ps_source_next(sets->source, set, part, has_set, error));
    if (*has_set) {
        ps_boxes_add(&sets->boxes, &set->box, set->dimension);
    }
    return PSPEC_OK;
}

pspec_status ps_power_sets_peek(ps_power_sets *sets, bool *has_set, ps_error *error) {
    if (!sets->has_next && sets->has_after) {
        exchange(&sets->next, &sets->after);
        ps_point_set_free(&sets->after);
        sets->part = sets->after_part;
        sets->used = 0;
        sets->has_next = true;
        sets->has_after = false;
    }
    if (!sets->has_next) {
        sets->used = 0;
        PS_TRY(read_set(sets, &sets->next, &sets->part, &sets->has_next, error));
    }
    *has_set = sets->has_next;
    return PSPEC_OK;
}

pspec_status ps_power_sets_is_last(ps_power_sets *sets, bool *is_last, ps_error *error) {
    if (sets->part.is_whole && !sets->has_after) {
        PS_TRY(read_set(sets, &sets->after, &sets->after_part, &sets->has_after, error));
    }
    *is_last = sets->part.is_whole && !sets->has_after;
    return PSPEC_OK;
}

uint64_t ps_power_sets_next_points(const ps_power_sets *sets) {
    return sets->part.is_whole ? sets->next.num_points : sets->part.count.num_points;
}

/* ---- sets in memory ---------------------------------------------------------------------- */

static pspec_status check_weights(const ps_power_sets *sets, uint64_t num_points, ps_error *error) {
    return sets->weights == NULL || sets->num_weights == num_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "\"%s\" holds %zu weights, but a set has %llu points", sets->weights_path,
                         sets->num_weights, (unsigned long long)num_points);
}

/* The first points of a set, or of a part of it that begins with point `position` of the whole. */
static pspec_pattern show(const ps_power_sets *sets, const ps_point_set *set, size_t num,
                          uint64_t position) {
    const double *const own = set->has_weights ? set->weights : NULL;
    return (pspec_pattern){set->dimension, num, set->points,
                           sets->weights != NULL ? sets->weights + position : own};
}

static void look_at(ps_power_sets *sets, const pspec_pattern *block, bool ends_set) {
    if (sets->looks_at_axes && !sets->has_looked) {
        ps_axis_cells_add(&sets->first_cells, block);
        sets->has_looked = ends_set;
    }
}

/* A copy, for the batch has the set for itself. */
static pspec_status keep_first(ps_power_sets *sets, const ps_point_set *set, ps_error *error) {
    const size_t num = set->num_points * set->dimension;
    if (!sets->keeps_first || sets->has_kept) {
        return PSPEC_OK;
    }
    sets->has_kept = true;
    if (set->num_points > PS_MOST_POINTS_KEPT) {
        return PSPEC_OK;
    }
    sets->first.dimension = set->dimension;
    sets->first.coordinates = set->coordinates;
    PS_TRY(ps_points_reserve(&sets->first, set->num_points, error));
    memcpy(sets->first.points, set->points, num * sizeof *set->points);
    sets->first.num_points = set->num_points;
    return PSPEC_OK;
}

/* The next set becomes number `at` of the batch. */
static pspec_status take_next(ps_power_sets *sets, size_t at, ps_error *error) {
    ps_point_set *const set = &sets->sets[at];
    exchange(set, &sets->next);
    sets->has_next = false;
    sets->patterns[at] = show(sets, set, set->num_points, 0);
    look_at(sets, &sets->patterns[at], true);
    PS_TRY(keep_first(sets, set, error));
    return check_weights(sets, set->num_points, error);
}

/* Reads the rest of a set that came in part because it is large: some engines want it whole. */
static pspec_status load_next(ps_power_sets *sets, ps_error *error) {
    return ps_source_more(sets->source, &sets->next, SIZE_MAX, &sets->part.is_whole, error);
}

pspec_status ps_power_sets_fill(ps_power_sets *sets, bool can_stream, uint64_t most, size_t *num,
                                ps_error *error) {
    for (*num = 0; *num < sets->capacity && *num < most; (*num)++) {
        bool has_set = false;
        if (!sets->has_next) { /* read to where it will stay */
            exchange(&sets->next, &sets->sets[*num]);
        }
        PS_TRY(ps_power_sets_peek(sets, &has_set, error));
        if (!has_set || (!sets->part.is_whole && can_stream)) {
            return PSPEC_OK;
        }
        if (!sets->part.is_whole) {
            PS_TRY(load_next(sets, error));
        }
        PS_TRY(take_next(sets, *num, error));
    }
    return PSPEC_OK;
}

/* ---- sets that nobody takes -------------------------------------------------------------- */

/* Looked at and kept as sets that are taken; the rest of one that comes in blocks is read, too. */
static pspec_status pass_next(ps_power_sets *sets, ps_error *error) {
    ps_point_set *const set = &sets->next;
    bool ends = sets->part.is_whole;
    PS_TRY(ends ? keep_first(sets, set, error) : PSPEC_OK);
    for (bool is_last = false; !is_last;) {
        const pspec_pattern block = show(sets, set, set->num_points, 0);
        is_last = ends;
        look_at(sets, &block, is_last);
        if (!is_last) {
            set->num_points = 0;
            PS_TRY(ps_source_more(sets->source, set, sets->part.block_points, &ends, error));
        }
    }
    sets->has_next = false;
    return PSPEC_OK;
}

pspec_status ps_power_sets_pass(ps_power_sets *sets, uint64_t num, ps_look_at_sets *look,
                                void *payload, ps_passed_sets *passed, ps_error *error) {
    bool has_set = true;
    for (*passed = (ps_passed_sets){0}; passed->num < num; passed->num++) {
        PS_TRY(look(payload, error));
        PS_TRY(ps_power_sets_peek(sets, &has_set, error));
        if (!has_set) {
            return PSPEC_OK;
        }
        const uint64_t num_points = ps_power_sets_next_points(sets);
        passed->longest = num_points > passed->longest ? num_points : passed->longest;
        PS_TRY(pass_next(sets, error));
    }
    return PSPEC_OK;
}

pspec_status ps_power_sets_skip(ps_power_sets *sets, uint64_t num, ps_look_at_sets *look,
                                void *payload, ps_passed_sets *passed, ps_error *error) {
    const uint64_t kept = sets->keeps_first && num > 0 ? 1 : 0;
    ps_passed_sets rest = {0};
    PS_TRY(ps_power_sets_pass(sets, kept, look, payload, passed, error));
    const uint64_t skipped = ps_source_skip(sets->source, num - kept);
    PS_TRY(ps_power_sets_pass(sets, num - kept - skipped, look, payload, &rest, error));
    passed->num += skipped + rest.num;
    passed->longest = rest.longest > passed->longest ? rest.longest : passed->longest;
    return PSPEC_OK;
}

/* ---- sets in blocks ---------------------------------------------------------------------- */

static void drop_points(ps_point_set *set, size_t num) {
    set->num_points -= num;
    if (set->is_lent) {
        set->points += num * set->dimension;
        return;
    }
    if (num > 0) {
        memmove(set->points, set->points + num * set->dimension,
                set->num_points * set->dimension * sizeof(double));
    }
    if (num > 0 && set->has_weights) {
        memmove(set->weights, set->weights + num, set->num_points * sizeof(double));
    }
}

/* What the last block left over comes first. */
static pspec_status next_block(void *payload, size_t unit, pspec_pattern *block, ps_error *error) {
    ps_power_sets *const sets = payload;
    ps_point_set *const set = &sets->next;
    const size_t room =
        sets->part.block_points > unit ? sets->part.block_points / unit * unit : unit;
    const size_t left = set->num_points - sets->used;
    bool ends = left >= room;
    drop_points(set, sets->used);
    if (!ends) {
        PS_TRY(ps_source_more(sets->source, set, room - left, &ends, error));
    }
    sets->used = set->num_points < room ? set->num_points : room;
    if (sets->num_streamed + sets->used > sets->part.count.num_points) {
        sets->used = 0; /* more than were counted: the estimator will say so */
    }
    *block = show(sets, set, sets->used, sets->num_streamed);
    sets->num_streamed += sets->used;
    look_at(sets, block, sets->num_streamed == sets->part.count.num_points);
    return PSPEC_OK;
}

/* The weights of a file of their own are counted here. */
static pspec_status sum_next(ps_power_sets *sets, pspec_normalization normalization,
                             ps_pattern_sums *sums, ps_error *error) {
    ps_pattern_count count = sets->part.count;
    if (sets->weights != NULL) {
        count = (ps_pattern_count){.realization = count.realization};
        PS_TRY(ps_pattern_count_weights(&count, sets->weights, sets->num_weights, error));
    }
    return ps_pattern_count_finish(&count, normalization, sums, error);
}

pspec_status ps_power_sets_stream(ps_power_sets *sets, ps_estimator *estimator,
                                  pspec_normalization normalization, ps_error *error) {
    ps_pattern_stream stream = {.dimension = sets->next.dimension,
                                .num_points = sets->part.count.num_points,
                                .next = next_block,
                                .payload = sets};
    PS_TRY(check_weights(sets, stream.num_points, error));
    PS_TRY(sum_next(sets, normalization, &stream.sums, error));
    sets->num_streamed = 0;
    PS_TRY(ps_estimator_add_stream(estimator, &stream, error));
    sets->has_next = false;
    return PSPEC_OK;
}
