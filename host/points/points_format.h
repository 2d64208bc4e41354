/* What a point format must provide; the table of formats is in points.c. Private to host/points. */
#ifndef PS_POINTS_POINTS_FORMAT_H
#define PS_POINTS_POINTS_FORMAT_H

#include "base/process/memory_limit.h"
#include "base/text.h"
#include "files/input_file.h"
#include "files/output_file.h"
#include "points/columns.h"
#include "points/points.h"

#include <stdio.h>

typedef enum ps_read_end {
    PS_MORE_ROWS,   /* the set may go on */
    PS_END_OF_SET,  /* complete with these rows, which may be none */
    PS_END_OF_INPUT /* nothing follows; rows that came with it complete the last set */
} ps_read_end;

/* Rows of one read: raw numbers as the file has them. */
typedef struct ps_rows_read {
    double *rows;    /* [capacity][columns] */
    size_t capacity; /* at least 1 */
    size_t num;
    ps_read_end end;
} ps_rows_read;

/* What a format can hold besides one set of torus points. */
typedef enum ps_format_ability {
    PS_HOLDS_SETS = 1,
    PS_HOLDS_WEIGHTS = 2,
    PS_HOLDS_TORUS = 4,
    PS_HOLDS_VECTORS = 8,
    PS_HOLDS_ANGLES = 16,
    PS_NEEDS_COUNTS = 32, /* in its header */
    PS_EQUAL_SETS = 64    /* does not say where a set ends: all have the same number of points */
} ps_format_ability;

typedef struct ps_point_format {
    const char *name;
    const char *endings[3]; /* of file names; the first one is that of files that are written */
    const char *magic;      /* first bytes that tell the format, NULL: none */
    /* Reading. open sets reader->columns and what else it knows; it need not clean up: where there
     * is a reader->state, close (NULL: nothing) frees in every case what it holds. A read that
     * cannot go on after some rows returns these and fails at the next call, so that errors come in
     * order. */
    pspec_status (*open)(ps_point_reader *reader, ps_error *error);
    pspec_status (*read)(ps_point_reader *reader, ps_rows_read *out, ps_error *error);
    void (*close)(ps_point_reader *reader);
    /* Of frames (text/points_frames.h): reads the header at the cursor, which it leaves at the
     * first row. */
    pspec_status (*read_header)(ps_point_reader *reader, ps_error *error);
    /* Writing (all NULL: it is only read); errors of the stream show when the caller checks it.
     * begin (NULL: nothing) writes the header with the counts known so far, always of the same
     * length, and is called again at the end when they were not. begin_set (NULL: nothing) is
     * called for every set, write for rows of it. */
    unsigned abilities;      /* of ps_format_ability */
    unsigned only_dimension; /* of the torus; 0: any */
    uint64_t max_count;      /* of sets, and of points of a set; 0: any */
    void (*begin)(ps_point_writer *writer);
    void (*begin_set)(ps_point_writer *writer);
    void (*write)(ps_point_writer *writer, const double *rows, size_t num_rows);
    pspec_status (*finish)(ps_point_writer *writer, ps_error *error); /* NULL: nothing */
} ps_point_format;

struct ps_point_reader {
    ps_input input;
    ps_point_options options;
    const ps_point_format *format;
    ps_given_set *given; /* NULL: points are those of the input; else that has but a name */
    void *state;
    /* set by the format */
    unsigned columns;        /* of every row */
    const char *own_columns; /* name of the layout that the format prescribes, or NULL */
    bool by_shape;           /* columns of an array that may be vectors: the first one tells */
    bool is_scattered;       /* sets lie so, and many are kept */
    bool has_own_box;        /* the file states the box that coordinates are in units of */
    ps_box own_box;          /* that of the set, an interval a column; {0}: not known of them */
    const char *chosen;      /* names of the columns that are read, where not all are, or NULL */
    size_t rows_per_set;     /* when it is known and really there; else 0 */
    unsigned most_threads;   /* that read, the caller counted; 0: all */
    size_t block_values;     /* numbers of a read, if not as many as fit the cache of a core */
    size_t first_line;       /* of the rows last read, for formats with a row per line; else 0 */
    /* points_read.c */
    bool has_layout, is_at_end;
    ps_layout layout;
    double *staging;         /* rows on their way to points */
    size_t staging_capacity; /* in doubles */
    uint64_t num_sets;       /* complete ones */
    size_t rows_in_set;      /* of the set that is being read */
    bool has_any_points;
    ps_memory_share share; /* of the last time that a set grew */
};

struct ps_point_writer {
    const ps_point_format *format;
    ps_output_file *file;
    ps_point_shape shape;
    ps_layout layout;
    unsigned columns;
    bool completes_header; /* counts were unknown: begin is called again at the end */
    size_t num_sets;       /* complete ones */
    size_t rows_in_set;
    double *staging;
    uint64_t num_values, num_rounded; /* for ps_points_describe_loss */
    double largest_rounding;
    ps_text kept; /* rows, of a format that cannot write them at once */
};

extern const ps_point_format ps_format_utk_text, ps_format_csv, ps_format_edat, ps_format_psa_text,
    ps_format_gbn, ps_format_eps, ps_format_utk_binary, ps_format_rps, ps_format_npy,
    ps_format_openquad;
/* What is only read. */
extern const ps_point_format ps_format_utk1, ps_format_lammps, ps_format_xyz, ps_format_ply,
    ps_format_obj;
/* Numbers in lines that mean nothing; in no table, for only the options tell it from utk-text. */
extern const ps_point_format ps_format_tokens;
/* Given sets; in no table, for no file has it. */
extern const ps_point_format ps_format_memory;

/* How points_npy.c writes openquad. */
void ps_openquad_write(ps_point_writer *writer, const double *rows, size_t num_rows);
pspec_status ps_openquad_finish(ps_point_writer *writer, ps_error *error) PS_MUST_CHECK;

/* Of those that are written. */
pspec_status ps_point_format_find(const char *name, const ps_point_format **out,
                                  ps_error *error) PS_MUST_CHECK;

/* Which of the formats of text it is; looks at the first lines. A format that the name of the file
 * tells, and that these do not confirm, is none. */
pspec_status ps_text_detect(ps_point_reader *reader, ps_error *error) PS_MUST_CHECK;

#endif
