/* Reading, as far as it is the same for all formats: blocks of rows become checked points. */
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "points/points_format.h"

#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_VALUES = 1 << 16, /* rows are converted while they are still in the cache: 512 KiB */
    FIRST_POINTS = 1024,    /* so that small sets are allocated once */
    PLACE_BYTES = 512       /* of "FILE, line 3", or "FILE, set 2, row 3" */
};

void ps_point_set_free(ps_point_set *set) {
    if (!set->is_lent) {
        free(set->points);
    }
    free(set->weights);
    *set = (ps_point_set){0};
}

pspec_status ps_points_reserve(ps_point_set *set, size_t num_points, ps_error *error) {
    size_t num_coordinates = 0;
    if (!ps_size_multiply(num_points, set->dimension, &num_coordinates)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for %zu points", num_points);
    }
    const double *const lent = set->is_lent ? set->points : NULL;
    void *memory = set->is_lent ? NULL : set->points;
    PS_TRY(
        ps_grow(&memory, &set->points_capacity, num_coordinates, sizeof(double), "points", error));
    set->points = memory;
    if (lent != NULL) {
        memcpy(set->points, lent, set->num_points * set->dimension * sizeof *lent);
        set->is_lent = false;
    }
    if (set->has_weights) {
        memory = set->weights;
        PS_TRY(
            ps_grow(&memory, &set->weights_capacity, num_points, sizeof(double), "weights", error));
        set->weights = memory;
    }
    return PSPEC_OK;
}

static const char *show_place(char place[PLACE_BYTES], const ps_point_reader *reader, size_t row) {
    if (reader->first_line > 0) {
        snprintf(place, PLACE_BYTES, "%.440s, line %zu", reader->input.name,
                 reader->first_line + row);
    } else {
        snprintf(place, PLACE_BYTES, "%.440s, set %llu, row %zu", reader->input.name,
                 (unsigned long long)reader->num_sets + 1, reader->rows_in_set + row + 1);
    }
    return place;
}

/* ---- one block --------------------------------------------------------------------------- */

static size_t block_rows(const ps_point_reader *reader) {
    return (reader->block_values > 0 ? reader->block_values : BLOCK_VALUES) / reader->columns;
}

static pspec_status read_rows(ps_point_reader *reader, double *rows, size_t capacity,
                              ps_rows_read *out, ps_error *error) {
    *out = (ps_rows_read){.rows = rows, .capacity = capacity};
    PS_TRY(reader->format->read(reader, out, error));
    reader->has_any_points = reader->has_any_points || out->num > 0;
    return PSPEC_OK;
}

static pspec_status read_staged(ps_point_reader *reader, size_t max_points, ps_rows_read *out,
                                ps_error *error) {
    const size_t fitting = block_rows(reader);
    const size_t num = max_points < fitting ? max_points : fitting;
    void *memory = reader->staging;
    PS_TRY(ps_grow(&memory, &reader->staging_capacity, num * reader->columns, sizeof(double),
                   "rows", error));
    reader->staging = memory;
    return read_rows(reader, reader->staging, num, out, error);
}

static pspec_status resolve_layout(ps_point_reader *reader, const double *first, ps_error *error) {
    char place[PLACE_BYTES];
    const ps_columns_question question = {
        .where = show_place(place, reader, 0),
        .columns = reader->columns,
        .own = reader->own_columns,
        .first = first,
        .by_shape = reader->by_shape,
        .options = &reader->options,
    };
    PS_TRY(ps_columns_resolve(&reader->layout, &question, error));
    reader->layout.has_own_box = reader->has_own_box;
    reader->has_layout = true;
    return PSPEC_OK;
}

static pspec_status refuse(const ps_point_reader *reader, const double *rows, size_t row,
                           ps_error *error) {
    char place[PLACE_BYTES];
    return ps_columns_refuse(&reader->layout, &reader->options, show_place(place, reader, row),
                             rows + row * reader->columns, error);
}

/* Rows that are points already, read to where they stay. Refused rows were perhaps wrapped up to
 * the bad one, which is shown as the file has it: what is refused is not changed. */
static pspec_status take_plain(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                               ps_rows_read *out, ps_error *error) {
    double *const points = set->points + set->num_points * set->dimension;
    PS_TRY(read_rows(reader, points, max_points, out, error));
    const size_t good =
        ps_columns_accept(&reader->layout, &reader->options, points, points, out->num);
    return good == out->num ? PSPEC_OK : refuse(reader, points, good, error);
}

/* Staged rows, taken apart. */
static pspec_status take_staged(ps_point_reader *reader, ps_point_set *set, const ps_rows_read *in,
                                ps_error *error) {
    double *const points = set->points + set->num_points * set->dimension;
    double *const weights = set->has_weights ? set->weights + set->num_points : NULL;
    ps_columns_split(&reader->layout, in->rows, in->num, points, weights);
    size_t good = ps_columns_accept(&reader->layout, &reader->options, in->rows, points, in->num);
    if (weights != NULL) {
        good = ps_weights_accept(weights, good);
    }
    return good == in->num ? PSPEC_OK : refuse(reader, in->rows, good, error);
}

static void shape_set(const ps_point_reader *reader, ps_point_set *set) {
    const ps_layout *layout = &reader->layout;
    set->coordinates = layout->coordinates;
    set->dimension = layout->dimension;
    set->has_weights = layout->has_weight_column && !layout->drops_weight;
}

/* Intervals of the file are those of the set if every coordinate has one; a weight may, too. */
static void box_set(const ps_point_reader *reader, ps_point_set *set) {
    const ps_layout *const layout = &reader->layout;
    const unsigned flat = layout->lift != PS_NO_LIFT                    ? 2
                          : layout->coordinates == PS_TORUS_COORDINATES ? layout->dimension
                                                                        : 0;
    const bool is_own = flat > 0 && reader->own_box.num_axes >= flat;
    set->box = is_own ? reader->own_box : reader->options.box;
    set->box.num_axes = is_own ? flat : set->box.num_axes;
}

/* ---- how large a set may become ----------------------------------------------------------- */

/* Bytes of so many points as the set keeps them. */
static double bytes_of(const ps_point_set *set, size_t num_points) {
    const unsigned columns = set->dimension + (set->has_weights ? 1 : 0);
    return (double)num_points * columns * (double)sizeof(double);
}

/* A stream may have no end, and its points are followed by the work: it gets half of what is free,
 * where nobody said how much it may take. Looked at when the set grows. */
static pspec_status check_memory(ps_point_reader *reader, const ps_point_set *set,
                                 size_t num_points, ps_error *error) {
    const uint64_t limit = reader->options.memory_limit;
    const double bytes = bytes_of(set, num_points);
    const bool grows = (double)num_points * set->dimension > (double)set->points_capacity;
    ps_memory_share *const share = &reader->share;
    char size[PS_SIZE_TEXT];
    if (limit == 0 && (reader->input.can_reopen || bytes < PS_LEAST_SHARE)) {
        return PSPEC_OK;
    }
    if (grows || share->by[0] == '\0') {
        const size_t held = (set->points_capacity + set->weights_capacity) * sizeof(double);
        ps_memory_share_find(share, limit, held);
    }
    return bytes <= share->bytes
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%.440s: set %llu takes more than %s, %s, after %zu points and goes on%s",
                         reader->input.name, (unsigned long long)reader->num_sets + 1,
                         ps_size_show(size, share->bytes), share->by, set->num_points,
                         limit > 0 ? "" : "; --memory SIZE would allow more");
}

/* Room for so many points in all, if the set may have them. */
static pspec_status reserve(ps_point_reader *reader, ps_point_set *set, size_t num_points,
                            ps_error *error) {
    PS_TRY(check_memory(reader, set, num_points, error));
    const pspec_status status = ps_points_reserve(set, num_points, error);
    if (status == PSPEC_ERROR_MEMORY && error != NULL) {
        const ps_error reason = *error;
        return ps_fail(error, status, "%.440s: set %llu: %s", reader->input.name,
                       (unsigned long long)reader->num_sets + 1, reason.message);
    }
    return status;
}

/* Room for the points of the next block: all of the set when its size is known and really there. */
static pspec_status reserve_block(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                                  size_t *num, ps_error *error) {
    const size_t fitting = block_rows(reader);
    const size_t left =
        reader->rows_per_set -
        (reader->rows_in_set < reader->rows_per_set ? reader->rows_in_set : reader->rows_per_set);
    *num = max_points < fitting ? max_points : fitting;
    if (left > 0) {
        const size_t wanted = left < max_points ? left : max_points;
        *num = wanted < *num ? wanted : *num;
        return reserve(reader, set, set->num_points + wanted, error);
    }
    /* Text: what is free already is filled before there is more. */
    const size_t free_points = set->points_capacity / set->dimension > set->num_points
                                   ? set->points_capacity / set->dimension - set->num_points
                                   : 0;
    const size_t least = set->num_points == 0 ? FIRST_POINTS : 1;
    const size_t room = free_points > least ? free_points : least;
    *num = *num < room ? *num : room;
    return reserve(reader, set, set->num_points + *num, error);
}

/* ---- points that stay where they are ----------------------------------------------------- */

/* Nothing is read into the set, whose points are those of the view from its first on. */
static bool can_lend(const ps_point_reader *reader, const ps_point_set *set) {
    const ps_point_options *const options = &reader->options;
    return options->may_lend && reader->given != NULL && reader->given->stays &&
           ps_layout_is_plain(&reader->layout) && options->box.num_axes == 0 && !options->wrap &&
           !options->normalize_vectors && (set->num_points == 0 || set->is_lent);
}

static pspec_status take_lent(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                              ps_rows_read *out, ps_error *error) {
    const size_t fitting = block_rows(reader);
    PS_TRY(read_rows(reader, NULL, max_points < fitting ? max_points : fitting, out, error));
    const double *const rows = out->rows;
    if (set->num_points == 0) {
        if (!set->is_lent) {
            free(set->points);
        }
        set->points = out->rows;
        set->points_capacity = 0;
        set->is_lent = true;
    }
    const size_t good =
        ps_columns_accept(&reader->layout, &reader->options, rows, out->rows, out->num);
    return good == out->num ? PSPEC_OK : refuse(reader, rows, good, error);
}

/* Appends at most max_points points; out tells how many came and what ended. */
static pspec_status read_block(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                               ps_rows_read *out, ps_error *error) {
    size_t num = 0;
    if (!reader->has_layout) { /* the first rows tell the layout */
        PS_TRY(
            read_staged(reader, max_points < FIRST_POINTS ? max_points : FIRST_POINTS, out, error));
        if (out->num == 0) {
            return PSPEC_OK;
        }
        PS_TRY(resolve_layout(reader, out->rows, error));
        shape_set(reader, set);
        if (can_lend(reader, set)) { /* from its beginning, which a view shows again */
            return take_lent(reader, set, max_points, out, error);
        }
        PS_TRY(ps_points_reserve(set, set->num_points + out->num, error));
        return take_staged(reader, set, out, error);
    }
    shape_set(reader, set);
    if (can_lend(reader, set)) {
        return take_lent(reader, set, max_points, out, error);
    }
    PS_TRY(reserve_block(reader, set, max_points, &num, error));
    if (ps_layout_is_plain(&reader->layout)) {
        return take_plain(reader, set, num, out, error);
    }
    PS_TRY(read_staged(reader, num, out, error));
    return take_staged(reader, set, out, error);
}

/* ---- sets -------------------------------------------------------------------------------- */

static pspec_status fail_empty_set(const ps_point_reader *reader, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: set %llu has no points", reader->input.name,
                   (unsigned long long)reader->num_sets + 1);
}

/* Sets have the number of points that the user said, if he said one. */
static pspec_status check_count(const ps_point_reader *reader, bool ends_set, ps_error *error) {
    const size_t wanted = reader->options.points_per_set;
    const size_t there = reader->rows_in_set;
    if (wanted == 0 || there == wanted || reader->options.points_vary ||
        (there < wanted && !ends_set)) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s: set %llu has %s%zu point%s, but %zu are asked for; %s says itself how many "
                   "its sets have",
                   reader->input.name, (unsigned long long)reader->num_sets + 1,
                   ends_set ? "" : "at least ", there, there == 1 ? "" : "s", wanted,
                   reader->format->name);
}

/* What a program prints may have no end. */
static pspec_status check_program(const ps_point_reader *reader, ps_error *error) {
    const uint64_t most = reader->options.programs.most_points;
    return reader->input.program == NULL || most == 0 || reader->rows_in_set <= most
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: set %llu goes on after %llu points, far more than were asked for",
                         reader->input.name, (unsigned long long)reader->num_sets + 1,
                         (unsigned long long)most);
}

/* Counts the rows that came, and the set when it is over. */
static pspec_status count_rows(ps_point_reader *reader, const ps_rows_read *read, bool *ends_set,
                               ps_error *error) {
    reader->rows_in_set += read->num;
    reader->is_at_end = read->end == PS_END_OF_INPUT;
    *ends_set = read->end != PS_MORE_ROWS && reader->rows_in_set > 0;
    if (read->end == PS_END_OF_SET && reader->rows_in_set == 0) {
        return fail_empty_set(reader, error);
    }
    PS_TRY(check_count(reader, *ends_set, error));
    PS_TRY(check_program(reader, error));
    if (*ends_set) {
        reader->num_sets++;
        reader->rows_in_set = 0;
    }
    return PSPEC_OK;
}

static pspec_status check_not_empty(const ps_point_reader *reader, ps_error *error) {
    return !reader->is_at_end || reader->has_any_points
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
}

static bool is_wanted(const ps_point_range *sets, uint64_t set) {
    return sets->last == 0 || (set >= sets->first && set <= sets->last);
}

/* Passes over sets in front of the wanted ones. They are read, but not understood. */
static pspec_status skip_sets(ps_point_reader *reader, ps_error *error) {
    const ps_point_range *sets = &reader->options.sets;
    while (sets->last > 0 && !reader->is_at_end && reader->num_sets + 1 < sets->first) {
        ps_rows_read read;
        bool ends_set = false;
        PS_TRY(read_staged(reader, SIZE_MAX, &read, error));
        PS_TRY(count_rows(reader, &read, &ends_set, error));
    }
    return PSPEC_OK;
}

/* Looked at after reading: the last set may turn out to be the last one only then. */
static pspec_status check_range(const ps_point_reader *reader, ps_error *error) {
    const ps_point_range *sets = &reader->options.sets;
    const bool is_open = sets->last == UINT64_MAX;
    const uint64_t needed = is_open || reader->num_sets < sets->first ? sets->first : sets->last;
    if (sets->last > 0 && reader->is_at_end && reader->num_sets < needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds %llu set%s; set %llu is asked for",
                       reader->input.name, (unsigned long long)reader->num_sets,
                       reader->num_sets == 1 ? "" : "s", (unsigned long long)needed);
    }
    return PSPEC_OK;
}

pspec_status ps_points_next_block(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                                  bool *has_set, bool *ends_set, ps_error *error) {
    *has_set = *ends_set = false;
    PS_TRY(skip_sets(reader, error));
    while (!reader->is_at_end && !*has_set && !*ends_set &&
           is_wanted(&reader->options.sets, reader->num_sets + 1)) {
        ps_rows_read read;
        PS_TRY(read_block(reader, set, max_points, &read, error));
        box_set(reader, set);
        set->num_points += read.num;
        *has_set = read.num > 0;
        PS_TRY(count_rows(reader, &read, ends_set, error));
    }
    *has_set = *has_set || *ends_set;
    PS_TRY(check_not_empty(reader, error));
    return check_range(reader, error);
}

size_t ps_points_per_set(const ps_point_reader *reader) {
    return reader->rows_per_set;
}

bool ps_points_can_reopen(const ps_point_reader *reader) {
    return reader->input.can_reopen;
}

bool ps_points_are_scattered(const ps_point_reader *reader) {
    return reader->is_scattered;
}

void ps_points_limit_threads(ps_point_reader *reader, unsigned most) {
    reader->most_threads = most;
}
