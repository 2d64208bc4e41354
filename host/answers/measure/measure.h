/* Measures of point sets: what question, table and picture share. */
#ifndef PS_ANSWERS_MEASURE_MEASURE_H
#define PS_ANSWERS_MEASURE_MEASURE_H

#include "answers/spectra/spectra.h"
#include "jobs/measure/measure_job.h"

typedef struct ps_measures_asked {
    ps_request own; /* without the range, which is of rows, not of blocks of spectra */
    ps_question_list list;
    ps_measure_question *questions; /* [list.num] */
    ps_measure_result *results;     /* [list.num] */
    ps_device *device;
    bool owns_device;
} ps_measures_asked;

/* A row for every measure of every question; g(r) and the number variance as arrays. */
pspec_status ps_measure_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                 ps_error *error);
extern const ps_field_row ps_fields_measure[];

/* Both arrays, a curve for every question. */
ps_make_figure ps_measure_figure;

#endif
