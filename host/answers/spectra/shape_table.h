/* --fit: what a table and a picture say of the shape of a spectrum (spectra/shape). */
#ifndef PS_ANSWERS_SPECTRA_SHAPE_TABLE_H
#define PS_ANSWERS_SPECTRA_SHAPE_TABLE_H

#include "request/request.h"
#include "spectra/shape/shape.h"
#include "fields/table.h"

/* Columns of rows: the profile below, the one above, and up to where it goes the fit. */
enum { PS_SHAPE_COLUMNS = 3 };

/* The columns of a row of the spectrum behind num others; how many there are then. Without --fit
 * there are none. */
size_t ps_shape_add_columns(const char **columns, size_t num, const ps_request *request);
size_t ps_shape_add_cells(ps_cell *cells, size_t num, const ps_request *request,
                          const ps_shape *shape, const ps_spectrum *spectrum,
                          const ps_spectrum_bin *bin);
/* Header lines of --fit: numbers, and sentences for people. */
pspec_status ps_shape_add_header(ps_table *table, const ps_shape *shape,
                                 const ps_spectrum *spectrum, ps_error *error) PS_MUST_CHECK;
/* Those of them that are about its profiles. */
pspec_status ps_shape_add_profiles(ps_table *table, const ps_shape *shape,
                                   const ps_spectrum *spectrum, ps_error *error) PS_MUST_CHECK;

#endif
