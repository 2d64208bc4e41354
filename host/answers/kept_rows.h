/* Rows of a range of realizations (spectra/row_tape.h) as state of an answer. */
#ifndef PS_ANSWERS_KEPT_ROWS_H
#define PS_ANSWERS_KEPT_ROWS_H

#include "answers/kind.h"
#include "spectra/row_tape.h"

/* Where a request of a kind that has rows names a range, its jobs get the tape, which records it.
 * Points and functions of a caller, whom merge cannot ask, and input that comes once are
 * PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_kept_rows_begin(ps_row_tape *tape, ps_request *request, const ps_kind *kind,
                                ps_error *error) PS_MUST_CHECK;
/* Adds what the jobs of the request have kept of a part, if they have. */
pspec_status ps_kept_rows_add(ps_table *table, const ps_request *request,
                              ps_error *error) PS_MUST_CHECK;
/* Have the files that options of the request name the contents that the part knows them with? */
pspec_status ps_kept_rows_check_inputs(const ps_request *request, const ps_table *table,
                                       const char *name, ps_error *error) PS_MUST_CHECK;
/* Adds the rows of the answer to a range behind those of the tape; names are those of the answer
 * before and of this one, in sentences. *all: realizations of the job. */
pspec_status ps_kept_rows_read(ps_row_tape *tape, uint64_t *all, const ps_table *table,
                               const char *const names[2], ps_error *error) PS_MUST_CHECK;

extern const ps_field_row ps_fields_kept_rows[];

#endif
