/* From the columns of a file to points, and back: which columns are coordinates, which are angles,
 * which one is the weight. Private to host/points. */
#ifndef PS_POINTS_COLUMNS_H
#define PS_POINTS_COLUMNS_H

#include "points/points.h"

enum { PS_MAX_COLUMNS = PS_MAX_DIMENSION + 1 };

typedef enum ps_angle_order {
    PS_NO_ANGLES = 0,
    PS_THETA_PHI,
    PS_PHI_THETA,
    PS_LON_LAT
} ps_angle_order;

/* Columns of a row: coordinates or angles first, then perhaps the weight. */
typedef struct ps_layout {
    ps_coordinates coordinates; /* of the points that come out of the rows, or go into them */
    unsigned dimension;
    ps_angle_order angles; /* how the rows hold directions, if not as vectors */
    bool in_degrees;       /* are these angles; else they are in radians */
    ps_lift lift;          /* rows are points (x, y) of the plane, which become vectors */
    bool has_weight_column;
    bool drops_weight;
    bool has_own_box; /* coordinates are in units of a box that the file states */
    bool by_shape;    /* nothing but the shape of an array and its first point told that */
} ps_layout;

/* The facts that decide about the layout of a file. */
typedef struct ps_columns_question {
    const char *where;   /* "FILE" or "FILE, line 3" */
    unsigned columns;    /* of a row */
    const char *own;     /* layout that the format prescribes, or NULL */
    const double *first; /* the first row */
    bool by_shape;       /* of the columns of an array, which are points if they are unit vectors */
    const ps_point_options *options;
} ps_columns_question;

/* The name of a layout of angles, or of the plane, with or without a weight; NULL: it has none. */
const char *ps_columns_name(ps_angle_order angles, bool has_weight, bool in_degrees);
/* What follows names of columns, "lon-lat" of "ra,dec=lon-lat", or NULL. */
const char *ps_columns_meaning(const char *names);
/* Are the names numbers of columns, counted from 1? Writes the first most of them to numbers, which
 * may be NULL, and how many there are to *num. */
bool ps_columns_numbers(const char *names, unsigned numbers[], unsigned most, unsigned *num);
/* The same where nobody asks which; NULL are none. */
bool ps_columns_are_numbers(const char *names);
/* The layout that the names of columns mean, "ra,dec", "theta_deg,phi_deg,w", or NULL: static
 * storage. The latitude may come first, which *are_swapped tells. */
const char *ps_columns_of_names(const char *names, bool *are_swapped);

/* How many columns a row has by the options, 0: they do not tell. */
unsigned ps_columns_told(const ps_point_options *options);
/* May a row have so many columns, as far as the options tell? */
bool ps_columns_agree(const ps_point_options *options, size_t columns);

pspec_status ps_columns_resolve(ps_layout *out, const ps_columns_question *question,
                                ps_error *error) PS_MUST_CHECK;

/* The layout of rows to be written; columns NULL: as the coordinates are. */
pspec_status ps_columns_for_writing(ps_layout *out, const ps_point_shape *shape,
                                    ps_error *error) PS_MUST_CHECK;

/* Columns of a row in this layout. */
unsigned ps_layout_columns(const ps_layout *layout);
/* "xy", "xyzw", "theta-phi:degrees", "x1..x4": static storage. */
const char *ps_layout_name(const ps_layout *layout);
/* Are rows points as they stand? */
bool ps_layout_is_plain(const ps_layout *layout);

/* Takes num rows apart: points and weights (weights may be NULL) get num entries. */
void ps_columns_split(const ps_layout *layout, const double *rows, size_t num, double *points,
                      double *weights);
/* The other way round. source: what the points are. */
void ps_columns_join(const ps_layout *layout, ps_coordinates source, const double *points,
                     const double *weights, size_t num, double *rows);

/* Checks num points that came out of rows; wraps and normalizes them as options say. Returns the
 * number of the first bad point, or num. */
size_t ps_columns_accept(const ps_layout *layout, const ps_point_options *options,
                         const double *rows, double *points, size_t num);
/* The same for weights, which must be finite. */
size_t ps_weights_accept(const double *weights, size_t num);

/* The sentence for a row whose point or weight was not accepted. */
pspec_status ps_columns_refuse(const ps_layout *layout, const ps_point_options *options,
                               const char *where, const double *row, ps_error *error);

#endif
