#include "harness_points.h"

static pspec_status append(test_points *out, const ps_point_set *set) {
    const size_t total = out->num_points + set->num_points;
    double *const points = realloc(out->points, (total + 1) * set->dimension * sizeof(double));
    double *const weights = realloc(out->weights, (total + 1) * sizeof(double));
    if (points == NULL || weights == NULL) {
        return PSPEC_ERROR_MEMORY;
    }
    out->points = points;
    out->weights = weights;
    if (set->num_points > 0) {
        memcpy(points + out->num_points * set->dimension, set->points,
               set->num_points * set->dimension * sizeof(double));
    }
    if (set->num_points > 0 && set->has_weights) {
        memcpy(weights + out->num_points, set->weights, set->num_points * sizeof(double));
    }
    out->num_points = total;
    out->coordinates = set->coordinates;
    out->dimension = set->dimension;
    out->has_weights = set->has_weights;
    return PSPEC_OK;
}

pspec_status test_points_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
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

/* max_points 0: whole sets. */
static pspec_status read_step(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                              bool *has_set, bool *ends_set, ps_error *error) {
    set->num_points = 0;
    if (max_points > 0) {
        return ps_points_next_block(reader, set, max_points, has_set, ends_set, error);
    }
    const pspec_status status = test_points_next(reader, set, has_set, error);
    *ends_set = *has_set;
    return status;
}

pspec_status test_points_read_blocks(test_points *out, const char *path,
                                     const ps_point_options *options, size_t max_points,
                                     ps_error *error) {
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = true;
    *out = (test_points){0};
    pspec_status status = ps_points_open(&reader, path, options, error);
    while (status == PSPEC_OK && has_set) {
        bool ends_set = false;
        status = read_step(reader, &set, max_points, &has_set, &ends_set, error);
        if (status == PSPEC_OK && has_set) {
            status = append(out, &set);
            out->num_sets += ends_set;
        }
    }
    if (reader != NULL) {
        snprintf(out->format, sizeof out->format, "%s", ps_points_format(reader));
        snprintf(out->columns, sizeof out->columns, "%s", ps_points_columns(reader));
    }
    ps_point_set_free(&set);
    ps_points_close(reader);
    return status;
}

pspec_status test_points_read(test_points *out, const char *path, const ps_point_options *options,
                              ps_error *error) {
    return test_points_read_blocks(out, path, options, 0, error);
}

void test_points_free(test_points *points) {
    free(points->points);
    free(points->weights);
    *points = (test_points){0};
}

pspec_status test_points_write(const char *path, const char *format, const ps_point_set *sets,
                               size_t num_sets, bool shape_is_known, const char *columns,
                               ps_error *error) {
    ps_point_writer *writer = NULL;
    const ps_point_shape shape = {.num_sets = shape_is_known ? num_sets : 0,
                                  .num_points = shape_is_known ? sets[0].num_points : 0,
                                  .coordinates = sets[0].coordinates,
                                  .dimension = sets[0].dimension,
                                  .has_weights = sets[0].has_weights,
                                  .columns = columns};
    pspec_status status = ps_points_create(&writer, path, format, &shape, error);
    for (size_t i = 0; status == PSPEC_OK && i < num_sets; i++) {
        status = ps_points_write(writer, &sets[i], true, error);
    }
    if (status == PSPEC_OK) {
        status = ps_points_commit(writer, error);
    }
    ps_points_discard(writer);
    return status;
}
