/* What a point format must provide; the table of formats is in points.c. Private to host/io. */
#ifndef PS_IO_POINTS_FORMAT_H
#define PS_IO_POINTS_FORMAT_H

#include "io/input_file.h"
#include "io/output_file.h"
#include "io/points.h"

enum { PS_MAX_DIMENSION = 6, PS_MAX_COLUMNS = PS_MAX_DIMENSION + 1 };

typedef struct ps_point_format {
    const char *name;
    const char *ending; /* of files that are written in it, NULL: none */
    int first_byte;     /* that tells the format, -1: none */
    /* Reading: state is made by open, which need not clean up, and freed by close (NULL allowed).
     */
    pspec_status (*open)(ps_point_reader *reader, ps_error *error);
    pspec_status (*next)(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                         ps_error *error);
    void (*close)(ps_point_reader *reader);
    /* Writing; errors of the stream show when the caller checks it. NULL write: read only. */
    void (*begin)(ps_point_writer *writer);
    pspec_status (*write)(ps_point_writer *writer, const double *points, ps_error *error);
} ps_point_format;

struct ps_point_reader {
    ps_input input;
    ps_point_options options;
    const ps_point_format *format;
    void *state;
    size_t num_sets; /* read so far */
};

struct ps_point_writer {
    const ps_point_format *format;
    ps_output_file *file;
    size_t num_sets, num_points, num_written; /* num_written counts sets */
    unsigned dimension;
};

extern const ps_point_format ps_format_utk_text, ps_format_npy;

/* Columns of a row -> dimension, checked against the options. where: "FILE, line 3". */
pspec_status ps_points_dimension(const ps_point_reader *reader, const char *where, size_t columns,
                                 unsigned *dimension, ps_error *error) PS_MUST_CHECK;
/* Makes room for num_points points of set->dimension. */
pspec_status ps_points_reserve(ps_point_set *set, size_t num_points, ps_error *error) PS_MUST_CHECK;

/* Reduces *coordinate mod 1 to [0,1); false when it is not finite. */
bool ps_coordinate_wrap(double *coordinate);
/* Is *coordinate in [0,1), after wrapping when that is asked for? */
static inline bool ps_coordinate_accept(double *coordinate, bool wrap) {
    if (*coordinate >= 0 && *coordinate < 1) {
        return true;
    }
    return wrap && ps_coordinate_wrap(coordinate);
}
/* The sentence for a coordinate that was not accepted. text: the value as the input has it. */
pspec_status ps_coordinate_refuse(const char *where, const char *text, double coordinate,
                                  ps_error *error);
/* The sentence for a weight that is not finite. */
pspec_status ps_weight_refuse(const char *where, const char *text, ps_error *error);

#endif
