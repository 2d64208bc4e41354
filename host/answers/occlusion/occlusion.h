/* Ambient occlusion of a mesh by point sets: what its question, table and picture share. */
#ifndef PS_ANSWERS_OCCLUSION_OCCLUSION_H
#define PS_ANSWERS_OCCLUSION_OCCLUSION_H

#include "answers/kind.h"
#include "jobs/occlusion/occlusion_job.h"
#include "request/file_list.h"

#define PS_RAYS_ENGINE "rays"

typedef struct ps_occlusion {
    size_t num;
    ps_occlusion_question *questions; /* [num] */
    ps_sampler_request *samplers;     /* [num] */
    ps_file_list *files;              /* [num] */
    ps_occlusion_result *results;     /* [num] */
    ps_mesh mesh;
    ps_view view;
    ps_reference reference;
    ps_watch watch;
    ps_device *device; /* NULL: the host does it */
    bool owns_device;
} ps_occlusion;

/* A row of mse and visibility for every question, and the images that the request asks for. */
pspec_status ps_occlusion_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                   ps_error *error);
extern const ps_field_row ps_fields_occlusion[];

/* The image of every sampler or set, of the first number of points, and its error beside it. */
ps_make_figure ps_occlusion_figure;

#endif
