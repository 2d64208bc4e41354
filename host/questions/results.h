/* What can be asked for: the kinds of results, one table. A command of the same name prints one; a scene has several. */
#ifndef PS_QUESTIONS_RESULTS_H
#define PS_QUESTIONS_RESULTS_H

#include "questions/request.h"

typedef struct ps_result_kind {
    const char *name;
    const ps_option_id *
        options; /* that belong to the question, which is the same on every device; ended by PS_NUM_OPTIONS */
    const char *weights; /* words of --weights; NULL: equal|column|FILE */
    ps_domain samples;   /* which samplers it takes */
} ps_result_kind;

extern const ps_result_kind ps_result_power, ps_result_angular, ps_result_pairs,
    ps_result_quadrature, ps_result_truncation, ps_result_check;

/* Ended by NULL. */
extern const ps_result_kind *const ps_result_kinds[];

#endif
