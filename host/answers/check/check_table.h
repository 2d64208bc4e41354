/* The table of pointspec check: a row for every ring, shell or degree. */
#ifndef PS_ANSWERS_CHECK_CHECK_TABLE_H
#define PS_ANSWERS_CHECK_CHECK_TABLE_H

#include "answers/check/check_sides.h"
#include "request/request.h"
#include "tables/table.h"

typedef struct ps_check_results {
    const ps_saved_spectrum *saved, *measured;
    const ps_power_job *job;   /* that measured, and has run; NULL: the other side was saved, too */
    const ps_comparison *rows; /* [saved->num_bins] */
    size_t num_different;
} ps_check_results;

pspec_status ps_check_table(ps_table **out, const ps_request *arguments,
                            const ps_check_results *results, ps_error *error) PS_MUST_CHECK;

#endif
