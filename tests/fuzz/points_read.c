/* Reading all sets of a file in either way, and what must hold of them. */
#include "points.h"

#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Compressed files of 4 KiB can hold millions of points. */
enum { MOST_POINTS = 1 << 16, MOST_SETS = 1 << 12 };

/* ---- collecting -------------------------------------------------------------------------- */

static void check_shape(const fuzz_reading *out, const ps_point_set *set) {
    if (out->all.num_points > 0 &&
        (set->coordinates != out->all.coordinates || set->dimension != out->all.dimension ||
         set->has_weights != out->all.has_weights)) {
        fuzz_fail("the layout changes after %zu points", out->all.num_points);
    }
}

static void append(fuzz_reading *out, const ps_point_set *set, size_t first) {
    const size_t num = set->num_points - first;
    if (num == 0) {
        return;
    }
    check_shape(out, set);
    ps_point_set *const joined = &out->all;
    const unsigned d = set->dimension;
    joined->coordinates = set->coordinates;
    joined->dimension = d;
    joined->has_weights = set->has_weights;
    joined->points = fuzz_allocate(joined->points, (joined->num_points + num) * d, sizeof(double));
    memcpy(joined->points + joined->num_points * d, set->points + first * d,
           num * d * sizeof(double));
    if (set->has_weights) {
        joined->weights = fuzz_allocate(joined->weights, joined->num_points + num, sizeof(double));
        memcpy(joined->weights + joined->num_points, set->weights + first, num * sizeof(double));
    }
    joined->num_points += num;
}

static void end_set(fuzz_reading *out) {
    const size_t before = out->num_sets > 0 ? out->ends[out->num_sets - 1] : 0;
    if (out->all.num_points == before) {
        fuzz_fail("set %zu has no points, and there is no error", out->num_sets + 1);
    }
    out->ends = fuzz_allocate(out->ends, out->num_sets + 1, sizeof *out->ends);
    out->ends[out->num_sets++] = out->all.num_points;
    out->was_cut = out->num_sets == MOST_SETS || out->all.num_points > MOST_POINTS;
}

/* ---- reading ----------------------------------------------------------------------------- */

static pspec_status next_set(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                             ps_error *error) {
    bool has_block = true;
    bool ends_set = false;
    set->num_points = 0;
    while (has_block && !ends_set) {
        PS_TRY(ps_points_next_block(reader, set, SIZE_MAX, &has_block, &ends_set, error));
    }
    *has_set = ends_set;
    return PSPEC_OK;
}

static void read_sets(fuzz_reading *out, ps_point_reader *reader) {
    ps_point_set set = {0};
    bool has_set = true;
    while (has_set && !out->was_cut) {
        out->status = next_set(reader, &set, &has_set, &out->error);
        has_set = has_set && out->status == PSPEC_OK;
        if (has_set) {
            append(out, &set, 0);
            end_set(out);
        }
    }
    ps_point_set_free(&set);
}

static void check_block(size_t num, size_t most, bool has_set, bool ends_set) {
    if (num > most) {
        fuzz_fail("a block of %zu points, %zu were asked for", num, most);
    }
    if (has_set != (num > 0 || ends_set)) {
        fuzz_fail("%zu points, has_set %d, ends_set %d", num, has_set, ends_set);
    }
}

static void read_blocks(fuzz_reading *out, ps_point_reader *reader, const fuzz_choices *choices,
                        size_t block_points) {
    ps_point_set set = {0};
    bool has_set = true;
    bool ends_set = false;
    while (has_set && !out->was_cut) {
        if (ends_set || !choices->keeps_blocks) {
            set.num_points = 0;
        }
        const size_t first = set.num_points;
        out->status =
            ps_points_next_block(reader, &set, block_points, &has_set, &ends_set, &out->error);
        has_set = has_set && out->status == PSPEC_OK;
        if (out->status == PSPEC_OK) {
            check_block(set.num_points - first, block_points, has_set, ends_set);
        }
        if (has_set) {
            append(out, &set, first);
        }
        if (has_set && ends_set) {
            end_set(out);
        }
    }
    ps_point_set_free(&set);
}

/* The end of the input stays the end. */
static void check_end(fuzz_reading *out, ps_point_reader *reader) {
    ps_point_set set = {0};
    bool has_set = false;
    if (out->status == PSPEC_OK && !out->was_cut &&
        (next_set(reader, &set, &has_set, &out->error) != PSPEC_OK || has_set)) {
        fuzz_fail("something comes after the end: %s", out->error.message);
    }
    ps_point_set_free(&set);
}

void fuzz_read(fuzz_reading *out, const char *path, const fuzz_choices *choices,
               size_t block_points) {
    ps_point_reader *reader = NULL;
    *out = (fuzz_reading){0};
    out->status = ps_points_open(&reader, path, &choices->options, &out->error);
    if (out->status == PSPEC_OK) {
        if (block_points == 0) {
            read_sets(out, reader);
        } else {
            read_blocks(out, reader, choices, block_points);
        }
        check_end(out, reader);
        out->format = ps_points_format(reader);
        if (out->all.num_points > 0 && ps_points_columns(reader)[0] == '\0') {
            fuzz_fail("points, but no name of their columns");
        }
    } else if (reader != NULL) {
        fuzz_fail("a reader comes with an error: %s", out->error.message);
    }
    ps_points_close(reader);
    fuzz_check_error(out->status, &out->error, FUZZ_PRINTABLE);
    if (out->status == PSPEC_OK && out->num_sets == 0) {
        fuzz_fail("no set, and no error");
    }
}

void fuzz_reading_free(fuzz_reading *reading) {
    ps_point_set_free(&reading->all);
    free(reading->ends);
    *reading = (fuzz_reading){0};
}

/* ---- what must hold ---------------------------------------------------------------------- */

static bool is_point(const ps_point_set *set, const double *x) {
    const double slack = 2e-6; /* of angles, and of the square of a length */
    bool is_good = true;
    switch (set->coordinates) {
    case PS_TORUS_COORDINATES:
        for (unsigned j = 0; j < set->dimension; j++) {
            is_good = is_good && x[j] >= 0 && x[j] < 1;
        }
        return is_good;
    case PS_UNIT_VECTORS:
        return fabs(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1) <= slack;
    case PS_ANGLES:
        return x[0] >= -slack && x[0] <= PS_PI + slack && fabs(x[1]) <= PS_TWO_PI + slack;
    }
    return false;
}

static void check_kind(const ps_point_set *set, const ps_point_options *options) {
    enum { MOST_DIMENSIONS = 6 };
    const unsigned d = set->dimension;
    const bool is_torus = set->coordinates == PS_TORUS_COORDINATES;
    const bool is_right_size =
        is_torus ? d >= 1 && d <= MOST_DIMENSIONS : d == (set->coordinates == PS_ANGLES ? 2 : 3);
    if (!is_right_size || (is_torus && options->dimension != 0 && d != options->dimension)) {
        fuzz_fail("dimension %u, asked for %u", d, options->dimension);
    }
    if ((is_torus && options->domain == PS_DOMAIN_SPHERE) ||
        (!is_torus && options->domain == PS_DOMAIN_TORUS) ||
        (set->coordinates == PS_ANGLES && !options->keep_angles)) {
        fuzz_fail("points of kind %d for domain %d", (int)set->coordinates, (int)options->domain);
    }
    if (set->has_weights && options->ignore_weights) {
        fuzz_fail("weights that were to be ignored");
    }
}

void fuzz_check_points(const fuzz_reading *reading, const ps_point_options *options) {
    const ps_point_set *const set = &reading->all;
    if (set->num_points > 0) {
        check_kind(set, options);
    }
    for (size_t i = 0; i < set->num_points; i++) {
        const double *const x = set->points + i * set->dimension;
        if (!is_point(set, x)) {
            fuzz_fail("point %zu (%.17g, ...) is none", i + 1, x[0]);
        }
        if (set->has_weights && !isfinite(set->weights[i])) {
            fuzz_fail("weight %zu is %g", i + 1, set->weights[i]);
        }
    }
}

void fuzz_compare(const fuzz_reading *a, const fuzz_reading *b, size_t num_sets, const char *what) {
    if (num_sets == 0) {
        return;
    }
    const size_t num = a->ends[num_sets - 1];
    const unsigned d = a->all.dimension;
    if (memcmp(a->ends, b->ends, num_sets * sizeof *a->ends) != 0 || b->all.dimension != d ||
        b->all.coordinates != a->all.coordinates || b->all.has_weights != a->all.has_weights) {
        fuzz_fail("%s: %zu sets of other shapes", what, num_sets);
    }
    if (memcmp(a->all.points, b->all.points, num * d * sizeof(double)) != 0) {
        fuzz_fail("%s: other points", what);
    }
    if (a->all.has_weights && memcmp(a->all.weights, b->all.weights, num * sizeof(double)) != 0) {
        fuzz_fail("%s: other weights", what);
    }
}
