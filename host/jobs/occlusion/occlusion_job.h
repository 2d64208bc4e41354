/* Ambient occlusion by the directions of point sets: of every pixel of a view, which share of the
 * hemisphere about its normal sees no triangle, and how far estimates are from a reference of many
 * rays (docs/user/occlusion.md).
 *
 *     sphere       V = (2/N) rays above the horizon that see nothing
 *     hemisphere   V = (1/N) rays that see nothing
 */
#ifndef PS_JOBS_OCCLUSION_OCCLUSION_JOB_H
#define PS_JOBS_OCCLUSION_OCCLUSION_JOB_H

#include "jobs/occlusion/view.h"
#include "jobs/spectrum/power_job.h"

/* What estimates are compared with: independent sets of the hemisphere with a point in each of many
 * strata, and turns of their own for every pixel. */
typedef struct ps_reference {
    uint64_t num_rays; /* of a pixel */
    double *seen;      /* [num_pixels] of the view: V */
    double mean;       /* of seen */
    double variance;   /* mean of the squares of its standard errors, */
    /* and how far that may be from the mean square of its errors at these pixels */
    double variance_error;
} ps_reference;

enum { PS_REFERENCE_SETS = 4 };

/* num_rays is rounded up to sets of n^2 points. checkpoint NULL: none. ps_reference_free frees it,
 * also after a failure. */
pspec_status ps_reference_make(ps_reference *out, const ps_view *view, uint64_t num_rays,
                               uint64_t seed, ps_device *device,
                               const ps_checkpoint_spec *checkpoint, const ps_watch *watch,
                               ps_error *error) PS_MUST_CHECK;
/* Of each of its sets. */
size_t ps_reference_points(uint64_t num_rays);
void ps_reference_free(ps_reference *reference);

/* What sets of at most num_points from a view take, of which width, height and num_triangles are
 * looked at: points, rays, the view, what is added up of pixels, and num_images of them. */
typedef struct ps_occlusion_size {
    const ps_view *view;
    size_t num_points;
    size_t num_images;
    ps_device *device;
} ps_occlusion_size;
uint64_t ps_occlusion_bytes(const ps_occlusion_size *size);
/* limit: bytes; 0: none. More is PSPEC_ERROR_MEMORY. */
pspec_status ps_occlusion_check_memory(const ps_occlusion_size *size, uint64_t limit,
                                       ps_error *error) PS_MUST_CHECK;

typedef struct ps_occlusion_question {
    const ps_view *view;
    const ps_reference *reference;
    /* A sampler of the sphere or the hemisphere, resolved, and how many sets of it; NULL: files */
    const ps_sampler_request *sampler;
    uint64_t num_realizations;
    ps_sets_options sets; /* where those of the sampler are kept */
    const char *const *paths;
    size_t num_paths;
    ps_point_options point_options;
    bool is_folded;    /* points are of the hemisphere, as those of some samplers are anyway */
    uint64_t seed;     /* of the turns of files; a sampler has its own */
    const char *name;  /* of files beside others, whose turns are their own; NULL: files alone */
    ps_device *device; /* NULL: the host does it */
    uint64_t memory_limit; /* bytes; 0: none */
    size_t num_images;     /* that are kept of all questions */
    const ps_watch *watch;
    ps_checkpoint_spec checkpoint;
} ps_occlusion_question;

typedef struct ps_occlusion_result {
    uint64_t num_realizations;
    double mean_points;
    uint64_t smallest_points, largest_points;
    double mean; /* of V over pixels and realizations */
    /* Mean square over pixels and realizations of what V is off, without the reference's variance;
     * its standard error is over realizations, of one over pixels, and of that variance */
    ps_mean squared;
    double *seen; /* [num_pixels]: V of the first set */
} ps_occlusion_result;

/* ps_occlusion_result_free frees it, also after a failure. */
pspec_status ps_occlusion_run(ps_occlusion_result *out, const ps_occlusion_question *question,
                              ps_error *error) PS_MUST_CHECK;
void ps_occlusion_result_free(ps_occlusion_result *result);

#endif
