/* Questions of interpolation and their jobs, and the table of jobs that have run. */
#ifndef PS_ANSWERS_INTERPOLATION_INTERPOLATION_H
#define PS_ANSWERS_INTERPOLATION_INTERPOLATION_H

#include "answers/kind.h"
#include "jobs/interpolation/interpolation_job.h"
#include "request/file_list.h"

/* One question for each sampler or set and number of points, or one for the files, as the request
 * counts them; all of the same functions. They borrow from the request, and from here. */
typedef struct ps_interpolation_list {
    ps_panorama panorama;
    size_t num;
    ps_interpolation_question *questions; /* [num] */
    ps_sampler_request *requests;         /* [num] */
    ps_file_list *files;                  /* [num] */
    ps_device *device;           /* of all of them, where they share one that was opened for them */
    ps_interpolation_job **jobs; /* [num] */
} ps_interpolation_list;

/* Are images of the question kept where somebody wants some? Those of the most points. */
bool ps_interpolation_is_shown(const ps_request *request, size_t question);

/* The functions, then their images, if there are any: those of the kind `light` have none. */
ps_make_figure ps_interpolation_figure;

/* The array `light`: the functions at all pixels. */
pspec_status ps_interpolation_add_light(ps_table *table, const ps_panorama *panorama,
                                        ps_error *error) PS_MUST_CHECK;

/* A row for every question, smoothness and function. */
pspec_status ps_interpolation_table(ps_table **out, const ps_interpolation_list *list,
                                    const ps_request *request, ps_error *error) PS_MUST_CHECK;

#endif
