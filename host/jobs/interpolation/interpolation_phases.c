#include "jobs/interpolation/interpolation_job.h"
#include "jobs/point_phases.h"
#include "jobs/quadrature/quadrature_job.h"

#include <math.h>

bool ps_interpolation_is_dense(const ps_interpolation_question *question, size_t num_points) {
    return ps_kernel_system_is_dense(num_points, PS_INTERPOLATION_MOST_DENSE,
                                     question->limits.constraints.memory_limit);
}

/* Values and solutions of a set, the functions, and images. */
uint64_t ps_interpolation_bytes(const ps_interpolation_question *question, size_t num_points) {
    const uint64_t functions = question->panorama->num;
    const uint64_t images = question->keeps_images ? functions * question->num_smoothness : 0;
    const uint64_t pixels = question->panorama->width * question->panorama->height;
    return ps_kernel_system_bytes(num_points, ps_interpolation_is_dense(question, num_points)) +
           (2 * functions * num_points + (images + functions) * pixels) * sizeof(double);
}

/* A set that is the same every time is interpolated at once. */
uint64_t ps_interpolation_num_sets(const ps_interpolation_question *question) {
    const ps_sampler_request *const sampler = question->sampler;
    const bool is_same = sampler != NULL && !question->no_skip && !sampler->homogenize &&
                         ps_sampler_has_constant_power(sampler);
    return is_same ? 1 : question->num_realizations;
}

/* Sets that are made; of files as many as their size suggests. */
static double add_points(const ps_interpolation_job *job, ps_phases *phases) {
    const ps_interpolation_question *const question = job->question;
    if (question->sampler != NULL) {
        const ps_sets_options sets = ps_limits_sets(&question->limits, question->no_skip);
        const double num = (double)ps_interpolation_num_sets(question);
        ps_phases_sample(phases, question->sampler, num, &sets);
        return num;
    }
    const double points =
        ps_phases_read(phases, question->paths, question->num_paths, &question->point_options, 3);
    return fmax(1, nearbyint(points / (double)job->first_points));
}

void ps_interpolation_job_phases(const ps_interpolation_job *job, ps_phases *phases) {
    static const char kernel[] = "kernel systems";
    static const char pixels[] = "interpolation";
    const ps_interpolation_question *const question = job->question;
    const ps_panorama *const panorama = question->panorama;
    const double points = (double)job->first_points;
    const double num = (double)panorama->num;
    const double sets = add_points(job, phases);
    /* of a function beside others, which share distances: 1000 points, s = 1.1 and 1.5, EPYC */
    const double beside = 0.12;
    const double each = points * ((double)panorama->width * (double)panorama->height + points);
    for (size_t i = 0; i < question->num_smoothness; i++) {
        const double s = question->smoothness[i];
        ps_phases_kernel_system(phases, kernel, s, points, num,
                                ps_interpolation_is_dense(question, job->first_points), job->device,
                                sets);
        ps_phases_distances(phases, pixels, s, each * (1 + beside * (num - 1)), sets);
    }
    ps_phases_say(phases, pixels, "%.4g pixels and points from %.6g points", each / points, points);
    ps_phases_tabulate(phases, num * (double)question->num_smoothness);
}
