/* Reading and writing point sets of the torus and of the sphere, in the formats of the field
 * (docs/user/formats.md), from files or standard input.
 *
 * A reader yields one set (realization) at a time, or one block of a set, and holds no more than
 * that (up to 64 MiB of sets, or half of the memory limit, for NPY arrays of several sets in
 * Fortran order, which lie scattered over the file). Sets, rows and lines are counted from 1 in
 * messages. A read that a signal interrupts is PSPEC_ERROR_CANCELLED; a handler installed with
 * SA_RESTART does not interrupt. Another format is another row in the table of formats in points.c
 * and another file beside it. Sets that a caller of the library gives are one more of them.
 */
#ifndef PS_POINTS_POINTS_H
#define PS_POINTS_POINTS_H

#include "base/status.h"
#include "base/text.h"
#include "math/lift.h"
#include "math/morph.h"
#include "points/box.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where points are meant to lie. */
typedef enum ps_domain {
    PS_DOMAIN_TORUS = 0, /* [0,1)^d, d = 1..6 */
    PS_DOMAIN_SPHERE,    /* unit vectors */
    PS_DOMAIN_ANY        /* what the file holds; the first row tells vectors from the torus */
} ps_domain;

/* What the numbers of a point are. */
typedef enum ps_coordinates {
    PS_TORUS_COORDINATES = 0, /* each in [0,1) */
    PS_UNIT_VECTORS,          /* x, y, z */
    PS_ANGLES /* theta in [0,pi] from the pole, phi: radians; only with keep_angles */
} ps_coordinates;

/* One point set; {0} is empty. The arrays belong to the set and are reused by the next read. */
typedef struct ps_point_set {
    ps_coordinates coordinates;
    unsigned dimension; /* numbers per point: d, 3 or 2 */
    size_t num_points;
    double *points;  /* [num_points][dimension] */
    double *weights; /* [num_points], meaningful only when has_weights */
    bool has_weights;
    ps_box box; /* of the file or of the options, that became [0,1)^d; {0}: none */
    size_t points_capacity, weights_capacity; /* in doubles */
    bool is_lent; /* points are those of a caller of the library: nobody changes or frees them */
} ps_point_set;

void ps_point_set_free(ps_point_set *set);
/* Points (x, y, z) from number `first` on become (y, z, x). */
void ps_point_set_turn(ps_point_set *set, size_t first);
/* Makes room for num_points points (and weights) in all, what is there is kept. */
pspec_status ps_points_reserve(ps_point_set *set, size_t num_points, ps_error *error) PS_MUST_CHECK;

/* Names of all formats and of all layouts of columns, for options. */
#define PS_POINT_FORMATS "utk-text|csv|psa-text|gbn|edat|eps|utk-binary|rps|npy|openquad"
/* And with those that are only read. */
#define PS_INPUT_FORMATS PS_POINT_FORMATS "|utk1|lammps|xyz|ply|obj"
#define PS_SPHERE_COLUMNS                                                                          \
    "xyz|xyzw|theta-phi|theta-phi-w|phi-theta|phi-theta-w|lon-lat|lon-lat-w|theta-phi:degrees|"    \
    "theta-phi-w:degrees|phi-theta:degrees|phi-theta-w:degrees"
#define PS_TORUS_COLUMNS "xy|xyw"
#define PS_POINT_COLUMNS PS_TORUS_COLUMNS "|" PS_SPHERE_COLUMNS

/* Numbers from first to last, counted from 1; {0} means all. What is asked for must be there, but
 * last may be UINT64_MAX: up to the end. */
typedef struct ps_point_range {
    uint64_t first, last;
} ps_point_range;

/* Sets of a caller of the library: they are read, in order, where a path has this name. Names have
 * none of the letters ",*?[\\" that lists of files give a meaning to, and none is "-". */
typedef struct ps_given_set {
    const char *name;
    /* Set number `realization`, from 0: a view that is valid until the next call, or *has_set
     * false. It answers alike for the same number, whatever was asked before: sets are asked for in
     * order by the thread that reads, from 0 again whenever they are read again, and once more
     * where two readers take turns. A failure goes to who reads, with its sentence. */
    pspec_status (*next)(void *payload, uint64_t realization, pspec_pattern *out, bool *has_set,
                         ps_error *error);
    void *payload;
    uint64_t most;      /* sets; 0: as many as there are. For what makes sets without an end */
    uint64_t num;       /* sets that there are, for whoever plans; 0: nobody knows */
    bool stays;         /* views stay valid as long as the set does */
    uint64_t num_calls; /* of next, counted by readers, so that each knows whose view there is */
} ps_given_set;

typedef struct ps_given_sets {
    ps_given_set *sets;
    size_t num;
} ps_given_sets;

/* The name of the set of a curve with its number `count` of points, from 0: NAME, NAME=2, NAME=3.
 * No name of a set has =. */
void ps_given_name(ps_text *out, const char *curve, size_t count);
/* NULL: a path is that of a file. */
ps_given_set *ps_given_sets_find(const ps_given_sets *given, const char *path);
/* Sets of all paths, where all are those of given sets that say how many they are; else 0. */
uint64_t ps_given_sets_count(const ps_given_sets *given, const char *const *paths,
                             size_t num_paths);
/* All paths are those of given sets. */
bool ps_given_sets_are_all(const ps_given_sets *given, const char *const *paths, size_t num_paths);

/* Programs of which somebody said that they may be run. */
typedef struct ps_point_programs {
    bool may_run;
    uint64_t num_sets;    /* to take of what they print, together */
    uint64_t most_points; /* of a set, beyond which a program is stopped; 0: as memory allows */
} ps_point_programs;

typedef struct ps_point_options {
    const char *format;       /* NULL: detected, else one of PS_INPUT_FORMATS */
    const char *columns;      /* NULL: found out, else one of PS_POINT_COLUMNS */
    const char *column_names; /* NULL, or "x,y", "ra,dec=lon-lat": of a text with a line of names;
                                 or "3,7", numbers of the columns of a text or an array */
    const char *header;       /* NULL: found out, "yes" or "no": is the first line one of names? */
    const char *select;       /* "type=1": only rows with this in the column of that name */
    bool transpose;           /* points are the columns of an array of two axes */
    unsigned dimension;       /* of the torus; 0: from the file; otherwise it must agree */
    size_t points_per_set;  /* of formats that do not say (rps), where 0 means that all is one set;
                               sets of other formats must have so many, unless 0 */
    bool points_vary;       /* they may have others: the number is that of samplers beside them */
    ps_point_range sets;    /* others are passed over */
    ps_domain domain;       /* what the caller can use */
    bool weight_column;     /* the last column holds the weight */
    bool ignore_weights;    /* weights of the file are read and dropped */
    bool wrap;              /* torus coordinates outside [0,1) are reduced mod 1, not refused */
    ps_box box;             /* of coordinates that are not those of [0,1) already */
    bool normalize_vectors; /* vectors are divided by their length instead of refused when that
                                differs from 1 by more than 1e-6 */
    bool above_horizon;     /* points of the sphere with z < 0 are refused */
    ps_lift lift;           /* of points (x, y) of the plane, which then are points of the sphere */
    ps_morph morph;         /* of points that are lifted to the hemisphere */
    bool has_morph;         /* somebody said which: who knows a better default leaves it alone */
    uint64_t memory_limit;  /* bytes that a set may take; 0: half of the memory that is free */
    bool may_lend;          /* whoever reads changes no points: those of given sets that stay, and
                               are points as they are, are not copied */
    bool keep_angles;       /* angles stay angles (theta, phi) instead of becoming vectors */
    ps_given_sets given;    /* borrowed */
    ps_point_programs programs;
} ps_point_options;

/* A path of this beginning is a command of the shell that prints points. */
#define PS_POINT_PROGRAM "exec:"
/* Returns the command, a part of the path; NULL: the path is no program. */
const char *ps_points_program(const char *path);

typedef struct ps_point_reader ps_point_reader;

/* Can all be read? Without opening them, as ps_input_check. */
pspec_status ps_points_check(const char *const *paths, size_t num, const ps_point_options *options,
                             ps_error *error) PS_MUST_CHECK;
/* Opens path: a given set, a program, else a file, standard input for "-". The texts of options
 * must outlive the reader. */
pspec_status ps_points_open(ps_point_reader **out, const char *path,
                            const ps_point_options *options, ps_error *error) PS_MUST_CHECK;
/* Appends at most max_points of the current set to *set. *ends_set tells that the set is complete
 * with them; at the end of the input no points come and *has_set is false. A file without any point
 * is an error. Errors name file, line (or set and row), value and what would be right. */
pspec_status ps_points_next_block(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                                  bool *has_set, bool *ends_set, ps_error *error) PS_MUST_CHECK;
/* Points of every set, when the input tells before they come and they are really there; else 0. */
size_t ps_points_per_set(const ps_point_reader *reader);
/* Would another ps_points_open of the same path give the same points? Not of standard input, nor of
 * a pipe. */
bool ps_points_can_reopen(const ps_point_reader *reader);
/* So many threads may parse what comes, the caller counted; 0, as after opening: one on each
 * processor. Changes no bit. */
void ps_points_limit_threads(ps_point_reader *reader, unsigned most);
/* Do sets lie scattered over the file, so that its reader keeps many of them? */
bool ps_points_are_scattered(const ps_point_reader *reader);
/* Names of the format and of the columns in use, for the header of results; static storage. The
 * columns are known after the first set. */
const char *ps_points_format(const ps_point_reader *reader);
const char *ps_points_columns(const ps_point_reader *reader);
/* "x,y", the names of the columns that are read, where a text has names and others; else NULL.
 * Belongs to the reader. */
const char *ps_points_chosen(const ps_point_reader *reader);
void ps_points_close(ps_point_reader *reader);

/* ---- writing ----------------------------------------------------------------------------- */

typedef struct ps_point_writer ps_point_writer;

/* What will be written. Counts that are not known in advance are 0: headers that hold them are then
 * completed at the end. */
typedef struct ps_point_shape {
    size_t num_sets, num_points;
    ps_coordinates coordinates;
    unsigned dimension;
    bool has_weights;
    const char *columns; /* of the sphere: one of PS_POINT_COLUMNS; NULL: as the coordinates are */
    uint64_t memory_limit; /* bytes of points, where the format keeps a set whole; 0: any */
} ps_point_shape;

/* PSPEC_ERROR_INVALID_ARGUMENT where path has an ending that neither a format nor text has. */
pspec_status ps_points_check_ending(const char *path, ps_error *error) PS_MUST_CHECK;
/* The format that a file of this name would get: by its ending, else "utk-text". */
const char *ps_points_format_by_ending(const char *path);

/* Creates path ("-": standard output). Format by name, or NULL: by ending, which must
 * be known. Shapes that the format cannot hold are refused. The file appears under its name only
 * when ps_points_commit succeeds. */
pspec_status ps_points_create(ps_point_writer **out, const char *path, const char *format,
                              const ps_point_shape *shape, ps_error *error) PS_MUST_CHECK;
/* Writes a set, or a block of one. */
pspec_status ps_points_write(ps_point_writer *writer, const ps_point_set *block, bool ends_set,
                             ps_error *error) PS_MUST_CHECK;
/* Appends what the format could not keep ("2034 of 2048 coordinates were rounded to float32 ..."),
 * or nothing; to be called before commit. */
void ps_points_describe_loss(const ps_point_writer *writer, char *text, size_t text_bytes);
pspec_status ps_points_commit(ps_point_writer *writer, ps_error *error) PS_MUST_CHECK;
/* Frees the writer; what was not committed is removed. NULL is allowed. */
void ps_points_discard(ps_point_writer *writer);

#endif
