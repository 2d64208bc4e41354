/* A line of names before rows of numbers, as data frames are written: which columns of the file are
 * read, by their names or without an index. Private to host/points. */
#ifndef PS_POINTS_TEXT_HEADER_H
#define PS_POINTS_TEXT_HEADER_H

#include "files/text_lines.h"
#include "points/columns.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* More columns than a data frame of points has. */
enum { PS_MOST_FILE_COLUMNS = 64 };

/* What a column without a name holds, which is passed over: text, or the numbers of the rows of the
 * file or of a set, from 0 or from 1 on. Anything else could be a coordinate. */
typedef struct ps_row_index {
    enum { PS_INDEX_UNKNOWN = 0, PS_INDEX_TEXT, PS_INDEX_NUMBERS } kind;
    uint64_t next;
    bool may_restart; /* a set begins */
} ps_row_index;

/* --select NAME=VALUE: of all rows those that have this value in the column of that name. {0} takes
 * all rows. */
typedef struct ps_row_filter {
    const char *value; /* NULL: every row is taken */
    unsigned column;
    bool is_number;
    double number; /* that the value is */
} ps_row_filter;

/* Which columns and rows of a text with names are read. {0}: all but an index. */
typedef struct ps_text_choice {
    const char *names;  /* of the columns, separated by commas, or NULL */
    const char *select; /* "type=1", whose column is none of the others, or NULL */
    const char
        *alias; /* the column that "type" and "element" mean where none is called so, or NULL */
} ps_text_choice;

typedef struct ps_text_header {
    bool is_there;        /* a line of names */
    unsigned num_columns; /* of the file */
    unsigned num_chosen;
    bool has_index;   /* the first column is passed over for want of a name */
    bool lacks_name;  /* there is a name less than columns */
    bool are_similar; /* names like x, y, z or x1, x2: nothing but coordinates */
    ps_row_index index;
    bool chooses;                       /* not all columns as they stand */
    short places[PS_MOST_FILE_COLUMNS]; /* of each column in a row; -1: it is passed over */
    char used[128];                     /* "x,y", the names of the chosen ones */
    ps_row_filter filter;
} ps_text_header;

/* Is this line one of names? They begin with letters, and numbers are among them only behind the
 * empty name of an index. */
bool ps_text_header_is(const char *line, char separator);

/* What parts the fields of a file whose first two rows these are, the first one of names: that of
 * ; , and the tab by which they agree; `otherwise` where none of them is there. */
char ps_text_header_separator(const char *names, const char *row, char otherwise);
/* The same of a line of it: one with a tab is parted by tabs alone. */
char ps_text_header_line_separator(const ps_text_header *header, const char *line, char separator);

/* Is it "0", "0,1" and so on: labels of columns that nobody named, or a point? */
bool ps_text_header_is_numbered(const char *line, char separator);
/* Have all numbers of this row a decimal point or an exponent? Labels have none. */
bool ps_text_header_is_decimal(const char *line, char separator);

/* Reads the names at line and looks at the row after it, which has as many fields, or one more
 * where all tells that the first name is missing. The line at the cursor of lines is named in
 * sentences. */
pspec_status ps_text_header_read(ps_text_header *out, const char *line, const char *row,
                                 char separator, const ps_text_choice *choice,
                                 const ps_lines *lines, ps_error *error) PS_MUST_CHECK;

/* For a text without a line of names: columns by their numbers, "3,7", or all of them for NULL.
 * Counts those of the row. */
pspec_status ps_text_header_choose(ps_text_header *out, const char *row, char separator,
                                   const char *numbers, const ps_lines *lines,
                                   ps_error *error) PS_MUST_CHECK;

/* The layout that the names of the chosen columns mean ("xyw", "theta-phi"), or NULL. Where these
 * are a latitude and then a longitude, rows have them in the other order from now on. */
const char *ps_text_header_meaning(ps_text_header *header);

/* Finds the column of the filter in a line of names. */
pspec_status ps_row_filter_find(ps_row_filter *out, const char *names, char separator,
                                const ps_text_choice *choice, const ps_lines *lines,
                                ps_error *error) PS_MUST_CHECK;
/* Takes the filter a row with this number, of a file of numbers? is_single: it was rounded to
 * float32 there. */
bool ps_row_filter_takes_number(const ps_row_filter *filter, double number, bool is_single);

/* The chosen numbers of a line, or NULL where it is no such row; returns its '\n'. *is_taken: has
 * it the text of the filter, or another one of the same number? The rows of a file are to come in
 * order. */
const char *ps_text_header_row(ps_text_header *header, const char *line, char separator,
                               double *row, bool *is_taken);
/* Why it is none. */
pspec_status ps_text_header_refuse(const ps_text_header *header, const char *line, char separator,
                                   const ps_lines *lines, ps_error *error) PS_MUST_CHECK;

#endif
