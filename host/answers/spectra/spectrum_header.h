/* Header lines of a table of powers, on the torus and on the sphere: how every number was made. */
#ifndef PS_ANSWERS_SPECTRA_SPECTRUM_HEADER_H
#define PS_ANSWERS_SPECTRA_SPECTRUM_HEADER_H

#include "integrands/integrand.h"
#include "answers/spectra/measured.h"
#include "fields/table.h"

/* A header that is being written. */
typedef struct ps_header {
    ps_table *table;
    ps_error *error;
    pspec_status status; /* the first failure; later entries do nothing */
} ps_header;
void ps_header_put(ps_header *head, const char *key, ps_cell value);

/* What all questions have in common. */
pspec_status ps_header_begin(ps_table *table, const ps_request *arguments, const ps_measured *first,
                             ps_error *error) PS_MUST_CHECK;
/* Adds what is to be said of question `index` of the num that the table is of. */
pspec_status ps_header_add(ps_table *table, const ps_request *arguments, const ps_measured *all,
                           size_t num, size_t index, ps_error *error) PS_MUST_CHECK;

/* Numbers of points of sets. */
typedef struct ps_points_range {
    double mean;
    uint64_t smallest, largest;
} ps_points_range;
/* N of all sets, or their mean, then, with_range, the smallest and the largest: where they differ
 * in a question of the table, they are there for all, since JSON has the values of a key in an
 * array, without gaps. */
pspec_status ps_header_add_points(ps_table *table, const ps_points_range *points, bool with_range,
                                  ps_error *error) PS_MUST_CHECK;

/* "2 files, 200 realizations, one average", where files, or runs of a program, are several;
 * are_for: these realizations. */
pspec_status ps_header_add_files(ps_table *table, const char *const *paths, size_t num_paths,
                                 uint64_t num_realizations, const char *are_for,
                                 ps_error *error) PS_MUST_CHECK;

/* integrand, integral and, where there is something to say, integrand_note; text: as it was asked
 * for. */
pspec_status ps_header_add_integrand(ps_table *table, const char *text,
                                     const ps_integrand *integrand, ps_error *error) PS_MUST_CHECK;

/* nan is a missing number. */
ps_cell ps_number_or_missing(double value);
/* From which box point files came, if not from [0,1), and how they were lifted to the sphere, if
 * they were. */
pspec_status ps_header_add_box(ps_table *table, const ps_box *box, ps_error *error) PS_MUST_CHECK;
pspec_status ps_header_add_lift(ps_table *table, const ps_point_options *options,
                                ps_error *error) PS_MUST_CHECK;

#endif
