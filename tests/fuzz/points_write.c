/* What was read, written and read again: the same bits, where the format keeps them. */
#include "points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The number of points of all sets, 0 when they differ. */
static size_t common_size(const fuzz_reading *reading) {
    const size_t first = reading->ends[0];
    for (size_t i = 1; i < reading->num_sets; i++) {
        if (reading->ends[i] - reading->ends[i - 1] != first) {
            return 0;
        }
    }
    return first;
}

/* ---- writing ----------------------------------------------------------------------------- */

static pspec_status write_set(ps_point_writer *writer, const fuzz_reading *reading, size_t set,
                              size_t block_points, ps_error *error) {
    const size_t end = reading->ends[set];
    pspec_status status = PSPEC_OK;
    for (size_t first = set > 0 ? reading->ends[set - 1] : 0; status == PSPEC_OK && first < end;
         first += block_points) {
        ps_point_set block = reading->all;
        block.num_points = end - first < block_points ? end - first : block_points;
        block.points += first * block.dimension;
        block.weights = block.has_weights ? block.weights + first : NULL;
        status = ps_points_write(writer, &block, first + block.num_points == end, error);
    }
    return status;
}

/* Formats cannot hold everything: a refusal is an answer. */
static bool write_all(const fuzz_reading *reading, const char *path, const char *format,
                      const fuzz_choices *choices) {
    const ps_point_shape shape = {
        .num_sets = choices->tells_counts ? reading->num_sets : 0,
        .num_points = choices->tells_counts ? common_size(reading) : 0,
        .coordinates = reading->all.coordinates,
        .dimension = reading->all.dimension,
        .has_weights = reading->all.has_weights,
    };
    ps_point_writer *writer = NULL;
    ps_error error = {0};
    pspec_status status = ps_points_create(&writer, path, format, &shape, &error);
    for (size_t set = 0; status == PSPEC_OK && set < reading->num_sets; set++) {
        status = write_set(writer, reading, set, choices->block_points, &error);
    }
    if (status == PSPEC_OK) {
        status = ps_points_commit(writer, &error);
    }
    ps_points_discard(writer);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status != PSPEC_OK && status != PSPEC_ERROR_INVALID_ARGUMENT) {
        fuzz_fail("cannot write %s: %s", format, error.message);
    }
    if (status != PSPEC_OK && strcmp(format, "utk-text") == 0) {
        fuzz_fail("utk-text, which holds everything, refuses: %s", error.message);
    }
    return status == PSPEC_OK;
}

/* ---- reading again ----------------------------------------------------------------------- */

static ps_point_options options_for_again(const fuzz_reading *reading, const char *format) {
    const ps_point_set *const joined = &reading->all;
    const bool is_torus = joined->coordinates == PS_TORUS_COORDINATES;
    ps_point_options options = {.format = format,
                                .domain = is_torus ? PS_DOMAIN_TORUS : PS_DOMAIN_SPHERE,
                                .dimension = is_torus ? joined->dimension : 0,
                                .points_per_set = common_size(reading),
                                .weight_column = joined->has_weights};
    if (joined->coordinates == PS_ANGLES) {
        options.keep_angles = true;
        options.columns = joined->has_weights ? "theta-phi-w" : "theta-phi";
    }
    if (strcmp(format, "utk-binary") == 0) { /* which asks about sets that repeat the first */
        options.sets = (ps_point_range){1, reading->num_sets};
    }
    return options;
}

/* What rps makes of a coordinate. */
static double narrow(double value) {
    const float rounded = (float)value;
    return rounded < 1 ? rounded : nextafterf(1, 0);
}

/* A copy of what was read, as it should come back. */
static void expect(fuzz_reading *out, const fuzz_reading *reading, const char *format) {
    *out = *reading;
    const size_t count = reading->all.num_points * reading->all.dimension;
    out->all.points = fuzz_allocate(NULL, count, sizeof(double));
    memcpy(out->all.points, reading->all.points, count * sizeof(double));
    out->ends = fuzz_allocate(NULL, reading->num_sets, sizeof *out->ends);
    memcpy(out->ends, reading->ends, reading->num_sets * sizeof *out->ends);
    if (strcmp(format, "rps") == 0) {
        for (size_t i = 0; i < count; i++) {
            out->all.points[i] = narrow(out->all.points[i]);
        }
        if (common_size(reading) == 0) { /* nothing in the file tells where sets end */
            out->num_sets = 1;
            out->ends[0] = reading->all.num_points;
        }
    }
}

/* openquad keeps vectors as angles. */
static void compare_rounded(const fuzz_reading *a, const fuzz_reading *b) {
    const double tolerance = 2e-6; /* also the length that a unit vector may lack */
    for (size_t i = 0; i < a->all.num_points * a->all.dimension; i++) {
        if (!(fabs(a->all.points[i] - b->all.points[i]) <= tolerance)) {
            fuzz_fail("openquad made %.17g of %.17g", b->all.points[i], a->all.points[i]);
        }
    }
}

static void compare_again(const fuzz_reading *expected, const fuzz_reading *again,
                          const char *format) {
    if (again->status != PSPEC_OK || again->num_sets != expected->num_sets ||
        again->all.num_points != expected->all.num_points ||
        again->all.dimension != expected->all.dimension) {
        fuzz_fail("%s: %zu sets were written, %zu came back: %s", format, expected->num_sets,
                  again->num_sets, again->error.message);
    }
    if (strcmp(format, "openquad") == 0 && expected->all.coordinates == PS_UNIT_VECTORS) {
        compare_rounded(expected, again);
    } else {
        fuzz_compare(expected, again, expected->num_sets, format);
    }
}

void fuzz_write_and_read(const fuzz_reading *reading, const char *format,
                         const fuzz_choices *choices) {
    fuzz_file file = fuzz_file_make((fuzz_bytes){NULL, 0});
    if (write_all(reading, file.path, format, choices)) {
        const fuzz_choices plain = {.options = options_for_again(reading, format)};
        fuzz_reading expected;
        fuzz_reading again;
        expect(&expected, reading, format);
        fuzz_read(&again, file.path, &plain, 0);
        compare_again(&expected, &again, format);
        free(expected.all.points);
        free(expected.ends);
        fuzz_reading_free(&again);
    }
    fuzz_file_close(&file);
}
