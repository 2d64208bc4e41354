/* Formats of text whose sets say how many rows they have, what their columns are called and in
 * which box they lie: frames of simulations. Private to host/points. */
#ifndef PS_POINTS_FRAMES_H
#define PS_POINTS_FRAMES_H

#include "points/text/points_text.h"

/* What the header of a frame says. */
typedef struct ps_frame {
    const char *names;    /* of the columns, a line between blanks */
    const char *row;      /* the first one, behind the header */
    const char *absolute; /* "x,y,z": coordinates that have the units of the box, axis by axis */
    const char *relative; /* "xs,ys,zs": coordinates that are in units of it already */
    const char *chosen;   /* "xs,ys,zs": the columns that are read unless --columns tells others */
    const char *filter;   /* the name of the column that type and element mean, or NULL */
    bool has_box;
    uint64_t num_rows;
} ps_frame;

/* The line at the cursor, which must be there. */
pspec_status ps_frame_line(ps_point_reader *reader, const char **line,
                           ps_error *error) PS_MUST_CHECK;
/* The line at the cursor as a number of rows, which is passed over; else that sentence. */
pspec_status ps_frame_count(ps_point_reader *reader, const char *otherwise, uint64_t *count,
                            ps_error *error) PS_MUST_CHECK;
/* Takes over what a header says; rows come next. */
pspec_status ps_frame_begin(ps_point_reader *reader, const ps_frame *frame,
                            ps_error *error) PS_MUST_CHECK;
/* Open and read of formats that have a read_header. */
pspec_status ps_frame_open(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;
pspec_status ps_frame_read(ps_point_reader *reader, ps_rows_read *out,
                           ps_error *error) PS_MUST_CHECK;

#endif
