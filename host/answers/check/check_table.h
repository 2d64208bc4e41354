/* What a check has found, and its table: a row for every ring, shell or degree. */
#ifndef PS_ANSWERS_CHECK_CHECK_TABLE_H
#define PS_ANSWERS_CHECK_CHECK_TABLE_H

#include "answers/check/check_sides.h"
#include "answers/homogeneity/homogeneity.h"

/* The saved spectrum, and the measured one, which may have been saved, too. */
typedef struct ps_check {
    ps_saved_spectrum saved, measured;
    ps_request own; /* what is asked of the measured side */
    ps_question_list list;
    ps_power_job *job;   /* that measured, and has run; NULL: the other side was saved, too */
    ps_comparison *rows; /* [saved.num_bins] */
    size_t num_different;
    /* Where that is asked instead, and the others are not there; else NULL. */
    ps_homogeneity *homogeneity;
} ps_check;

pspec_status ps_check_table(ps_table **out, const ps_check *check, ps_error *error) PS_MUST_CHECK;

#endif
