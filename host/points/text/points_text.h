/* What the formats of text share: lines, and rows of numbers in them. Private to host/points. */
#ifndef PS_POINTS_POINTS_TEXT_H
#define PS_POINTS_POINTS_TEXT_H

#include "files/text_rows.h"
#include "points/points_format.h"
#include "points/text/text_header.h"

typedef struct ps_text_state {
    ps_lines lines;
    ps_row_parser parser;
    char separator;
    size_t columns_line; /* the line that fixed the columns */
    ps_text_header header;
    size_t promised; /* points, by a count at the beginning of the file */
    size_t num_idle; /* lines one after the other that are of no point */
    bool is_in_line; /* the cursor is not at the beginning of a line (such files only) */
    /* tokens: numbers of the point that is being read */
    unsigned num_partial;
    double partial[PS_MAX_COLUMNS];
    /* edat: the domain of this set */
    unsigned num_corners; /* coordinates of a corner */
    bool needs_header;    /* the next line is that of the next set */
    bool has_dropped;     /* --select dropped rows of this set */
    /* frames: their box, rows that are to come, and those of the set that are kept */
    double lower[PS_MAX_DIMENSION], upper[PS_MAX_DIMENSION];
    uint64_t rows_left, num_kept;
    short axes[PS_MAX_COLUMNS]; /* of the columns that are scaled; -1: as they are */
} ps_text_state;

typedef enum ps_line_kind { PS_LINE_POINT, PS_LINE_MARK, PS_LINE_BLANK, PS_LINE_NONE } ps_line_kind;

/* Makes the next line available and tells what it is. */
pspec_status ps_text_next_line(ps_text_state *state, ps_line_kind *kind,
                               ps_error *error) PS_MUST_CHECK;

/* Makes the state of a text reader, or takes over the one that ps_text_detect has made, and goes to
 * the first line that is not a '#' line. */
pspec_status ps_text_open_lines(ps_point_reader *reader, char separator,
                                ps_error *error) PS_MUST_CHECK;
/* Makes one line of those that the row num_after lines after the one at the cursor takes: line
 * breaks in quotes become blanks. Pointers into the buffer do not survive this call. */
pspec_status ps_text_join(ps_text_state *state, size_t num_after, ps_error *error) PS_MUST_CHECK;
/* Fixes the number of columns of all rows. */
void ps_text_set_columns(ps_point_reader *reader, unsigned columns);
/* A line of names before the rows says which columns there are. */
pspec_status ps_text_take_header(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;
/* The row at the cursor fixes the number of columns for all sets of the input. */
pspec_status ps_text_fix_columns(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;
/* At the '#' line that ends a set. */
pspec_status ps_text_end_set(ps_point_reader *reader, ps_rows_read *out,
                             ps_error *error) PS_MUST_CHECK;
/* The sentence for a set of which --select takes no row. */
pspec_status ps_text_fail_selection(const ps_point_reader *reader, ps_error *error);
/* Rows of the whole lines in the buffer, up to the first line that is something else, or until
 * there are `most`. */
void ps_text_take_rows(const ps_point_reader *reader, ps_rows_read *out, size_t most);
pspec_status ps_text_read(ps_point_reader *reader, ps_rows_read *out,
                          ps_error *error) PS_MUST_CHECK;
void ps_text_close(ps_point_reader *reader);

/* Makes edat the format where the lines at the cursor are its header, and refuses those that could
 * also be points. is_named: the file has the name of one. */
pspec_status ps_edat_detect(ps_point_reader *reader, bool is_named, ps_error *error) PS_MUST_CHECK;

/* Makes xyz the format where the lines at the cursor begin a frame of it. */
pspec_status ps_xyz_detect(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;

/* Makes obj the format where the lines at the cursor are of one: groups and comments, and then
 * vertices, their normals or materials. */
pspec_status ps_obj_detect(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;

/* '#' between sets. */
void ps_text_begin_set(ps_point_writer *writer);
/* Rows of numbers between blanks, shortest digits. */
void ps_text_write_rows(ps_point_writer *writer, const double *rows, size_t num_rows);

#endif
