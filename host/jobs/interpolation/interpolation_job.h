/* Kernel interpolation of functions of the sphere from their values at sets of points, and its
 * error over all of the sphere (docs/mathematics/quadrature.md#interpolation):
 *
 *     f^(u) = sum_i alpha_i K(u, u_i),   K alpha = f;   of mean square error sum_p |pixel p|/(4 pi) (f^ - f)(u_p)^2
 *
 * over the pixels of a panorama, for one or several kernels, of which each is factored once for all
 * functions. Up to PS_INTERPOLATION_MOST_DENSE points the matrix is stored, and the host does the
 * work; beyond, products with the kernel are a device's, where there is one with double precision.
 */
#ifndef PS_JOBS_INTERPOLATION_INTERPOLATION_JOB_H
#define PS_JOBS_INTERPOLATION_INTERPOLATION_JOB_H

#include "jobs/interpolation/panorama.h"
#include "jobs/spectrum/power_sets.h"
#include "plan/phases.h"
#include "plan/specs.h"
#include "rules/kernel/kernel_system.h"
#include "spectra/sums.h"

/* From here on a product by a device is quicker than its part of a factor. */
enum { PS_INTERPOLATION_MOST_DENSE = 4096 };

typedef struct ps_interpolation_question {
    const ps_panorama *panorama; /* the functions, and where errors are measured */
    size_t num_smoothness;
    const double *smoothness;
    const ps_sampler_request *sampler; /* NULL: files; resolved */
    uint64_t num_realizations;         /* of the sampler */
    const char *const *paths;
    size_t num_paths;
    ps_point_options point_options;
    double residual; /* of conjugate gradients; 0: that of ps_kernel_options */
    bool keeps_images;
    bool no_skip; /* sets that are the same every time are computed as often as others */
    ps_limits_spec limits;
    bool may_lack_device;   /* to be planned only: nobody has opened one */
    ps_device *open_device; /* borrowed; NULL: the one that limits.device selects is opened */
    ps_watch watch;         /* told of all phases; {0}: nobody */
} ps_interpolation_question;

/* Of one kernel and function: means over realizations of squares, and largest numbers. */
typedef struct ps_interpolation_row {
    ps_sums squares, norms; /* of errors over the sphere; of f^ in the kernel's own norm */
    double largest_error;   /* at the centre of a pixel */
    double residual;        /* largest |f^ - f| at a point, over the largest |f| there */
    double condition;       /* as that of ps_kernel_facts */
    size_t num_steps;       /* of conjugate gradients; 0: a factor */
} ps_interpolation_row;

/* The same of one set, which rows are made of. */
typedef struct ps_interpolation_error {
    double square, norm, largest_error, residual, condition;
    size_t num_steps;
} ps_interpolation_error;

typedef struct ps_interpolation_job {
    const ps_interpolation_question *question;
    ps_power_sets sets;
    size_t first_points; /* of the first set, or that a sampler is asked for */
    ps_device *device;   /* NULL: none is needed, or there */
    bool owns_device;
    double *block; /* what the next ones lie in, for sets of up to most_points */
    size_t most_points;
    double *values, *alpha;      /* each [functions][points of the set] */
    double *directions, *pixels; /* of the rows of the panorama that are done at a time */
    size_t rows_of_block;
    uint64_t num_realizations;
    uint64_t num_points, smallest_points, largest_points; /* in all; of the smallest set, .. */
    ps_interpolation_row *rows; /* [num_smoothness][functions] of the sets that are done, */
    uint64_t number;            /* and of the set that is being done, which has that number */
    ps_interpolation_error *errors;
    double *images; /* of the first set, [num_smoothness][functions][height][width]; NULL */
} ps_interpolation_job;

/* Opens the source, of files reads the first two sets, and opens the device where the first set is
 * a large one. The question must outlive the job. More memory than question->limits has is
 * PSPEC_ERROR_MEMORY. */
pspec_status ps_interpolation_job_create(ps_interpolation_job **out,
                                         const ps_interpolation_question *question,
                                         ps_error *error) PS_MUST_CHECK;
void ps_interpolation_job_destroy(ps_interpolation_job *job); /* NULL is allowed */
/* Equal points of a set, and those that are so near that a kernel tells no difference, are
 * PSPEC_ERROR_INPUT with their numbers. */
pspec_status ps_interpolation_job_run(ps_interpolation_job *job, ps_error *error) PS_MUST_CHECK;
/* The part of it that is in interpolation_job.c: fills errors, which are 0 before, with those of
 * sets.sets[0]. */
pspec_status ps_interpolation_job_use_set(ps_interpolation_job *job, ps_error *error) PS_MUST_CHECK;
/* Gives back what only realizations need; after run. */
void ps_interpolation_job_release(ps_interpolation_job *job);

const ps_interpolation_row *ps_interpolation_job_row(const ps_interpolation_job *job,
                                                     size_t smoothness, size_t function);
/* Sets of a sampler that are computed; 0: of files nobody knows. */
uint64_t ps_interpolation_num_sets(const ps_interpolation_question *question);
/* Is the matrix of so many points stored? */
bool ps_interpolation_is_dense(const ps_interpolation_question *question, size_t num_points);
/* Bytes of a set of so many points, images included. */
uint64_t ps_interpolation_bytes(const ps_interpolation_question *question, size_t num_points);
/* How long it takes, phase by phase. */
void ps_interpolation_job_phases(const ps_interpolation_job *job, ps_phases *phases);

#endif
