/* What a power job knows. */
#include "jobs/spectrum/power_job_private.h"

const ps_plan *ps_power_job_plan(const ps_power_job *job) {
    return &job->plan;
}

const ps_needs *ps_power_job_needs(const ps_power_job *job) {
    return &job->needs;
}

const ps_problem *ps_power_job_problem(const ps_power_job *job) {
    return &job->problem;
}

const ps_device_limits *ps_power_job_limits(const ps_power_job *job) {
    return job->device != NULL ? ps_device_get_limits(job->device) : NULL;
}

const ps_sampler_request *ps_power_job_sampler(const ps_power_job *job) {
    return job->question->sampler;
}

size_t ps_power_job_num_files(const ps_power_job *job) {
    return job->question->num_paths;
}

bool ps_power_job_takes_part(const ps_power_job *job) {
    return job->question->num_sets > 0;
}

const char *ps_power_job_source_format(const ps_power_job *job) {
    return ps_source_format(job->sets.source);
}

bool ps_power_job_empty_axis(const ps_power_job *job, ps_empty_axis *out) {
    return ps_axis_cells_find_empty(&job->sets.first_cells, out);
}

const ps_point_set *ps_power_job_first_set(const ps_power_job *job) {
    return job->sets.first.num_points > 0 ? &job->sets.first : NULL;
}

const char *ps_power_job_source_columns(const ps_power_job *job) {
    return ps_source_columns(job->sets.source);
}

const ps_boxes *ps_power_job_boxes(const ps_power_job *job) {
    return &job->sets.boxes;
}

const ps_spectrum *ps_power_job_spectrum(const ps_power_job *job) {
    return &job->spectrum;
}

pspec_status ps_power_job_sums(const ps_power_job *job, ps_spectrum_sums *out, ps_error *error) {
    PS_TRY(ps_estimator_sums(job->runner.estimator, out, error));
    out->num_equal = job->needs.one_realization ? job->spectrum.num_realizations : 0;
    return PSPEC_OK;
}

const ps_accuracy *ps_power_job_accuracy(const ps_power_job *job) {
    return &job->runner.accuracy;
}

const char *ps_power_job_description(const ps_power_job *job) {
    return ps_text_string(&job->description);
}

const char *ps_power_job_trouble(const ps_power_job *job) {
    return ps_source_trouble(job->sets.source);
}

const ps_sequential_look *ps_power_job_look(const ps_power_job *job) {
    return job->question->accuracy.standard_error > 0 && job->runner.num_done > 1 ? &job->look
                                                                                  : NULL;
}

ps_device *ps_power_job_device(const ps_power_job *job) {
    return job->device;
}

const ps_mean *ps_power_job_weighted(const ps_power_job *job) {
    return job->weighted;
}

const ps_block_sums *ps_power_job_weighted_blocks(const ps_power_job *job) {
    return job->weighted_blocks;
}

const ps_mean *ps_power_job_c2(const ps_power_job *job) {
    return job->c2;
}

bool ps_power_job_was_replanned(const ps_power_job *job) {
    return job->runner.was_replanned;
}

uint64_t ps_power_job_buffer_bytes(const ps_power_job *job) {
    return job->device != NULL ? ps_device_most_buffer_bytes(job->device) : 0;
}

const ps_profile_row *ps_power_job_profile(const ps_power_job *job, size_t *num_rows) {
    *num_rows = 0;
    return job->device != NULL ? ps_device_profile(job->device, num_rows) : NULL;
}
