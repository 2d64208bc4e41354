/* Point files of tests: written from text or bytes, read back as a whole. */
#ifndef TEST_HARNESS_POINTS_H
#define TEST_HARNESS_POINTS_H

#include "points/points.h"
#include "test_folder.h"

/* All sets of a file: their points and weights one after the other; freed by test_points_free. */
typedef struct test_points {
    size_t num_sets, num_points;
    ps_coordinates coordinates;
    unsigned dimension;
    bool has_weights;
    double *points, *weights;
    char format[32], columns[32];
} test_points;

pspec_status test_points_read(test_points *out, const char *path, const ps_point_options *options,
                              ps_error *error);
/* The same in blocks of at most max_points (0: set by set, as above). */
pspec_status test_points_read_blocks(test_points *out, const char *path,
                                     const ps_point_options *options, size_t max_points,
                                     ps_error *error);
/* Reads the next set. *has_set is false at the end of the input. */
pspec_status test_points_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                              ps_error *error);
void test_points_free(test_points *points);

/* Writes num_sets sets of the same size, or says why not. columns: see ps_point_shape. */
pspec_status test_points_write(const char *path, const char *format, const ps_point_set *sets,
                               size_t num_sets, bool shape_is_known, const char *columns,
                               ps_error *error);

#endif
