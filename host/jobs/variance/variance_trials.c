/* The measured side of a variance job, and the pairs of a single set. */
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "jobs/point_phases.h"
#include "jobs/variance/measurement.h"
#include "jobs/variance/variance_job.h"
#include "math/random/random.h"
#include "spectra/row_tape.h"

#include <math.h>

/* ---- what is measured ---------------------------------------------------------------------- */

bool ps_variance_has_one_set(const ps_sampler_request *sampler) {
    ps_sampler_request plain = *sampler;
    plain.homogenize = false;
    return ps_sampler_has_constant_power(&plain);
}

/* The one set of a sampler without randomness is moved as often as several would be. */
static ps_variance_trials choose_trials(const ps_variance_job *job) {
    const ps_variance_question *const question = job->question;
    const ps_power_question *const spectrum = &question->spectrum;
    const uint64_t num = spectrum->num_realizations;
    if (spectrum->sampler == NULL) {
        const bool is_single = job->files.num == 1;
        const uint64_t moves = question->is_moved ? question->single_shifts : 1;
        return (ps_variance_trials){is_single, ps_variance_sets_measured(&job->files),
                                    is_single ? moves : question->num_shifts};
    }
    return ps_variance_has_one_set(spectrum->sampler)
               ? (ps_variance_trials){true, 1, num * question->num_shifts}
               : (ps_variance_trials){false, num, question->num_shifts};
}

/* Samplers, sets of a request and numbers of points have moves of their own, so that answers beside
 * each other are independent. */
static pspec_status choose_seed(const ps_variance_job *job, uint64_t *seed, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const ps_sampler_request *const sampler = question->spectrum.sampler;
    ps_text text = {0};
    if (sampler != NULL) {
        ps_sampler_identify(sampler, &text);
        ps_text_append(&text, "lift %d\n", (int)sampler->lift);
    } else {
        ps_text_append(&text, "files\npoints %zu\ndimension %u\n", job->files.most_points,
                       job->files.dimension);
        if (question->name != NULL) {
            ps_text_append(&text, "set %s\n", question->name);
        }
    }
    const pspec_status status = ps_text_check(&text, error);
    *seed = ps_random_seed_of(sampler != NULL ? sampler->seed : question->seed, PS_STREAM_TRIALS,
                              ps_text_string(&text));
    ps_text_free(&text);
    return status;
}

/* All but source and seed. Trials of one set are sets of one trial each, so that the error is over
 * trials. */
static ps_measurement_plan plan_measurement(const ps_variance_job *job) {
    const ps_variance_question *const question = job->question;
    const ps_power_question *const spectrum = &question->spectrum;
    const bool is_one_set = job->trials.is_one_set;
    ps_measurement_plan plan = {
        .is_one_set = is_one_set,
        .most_points = spectrum->sampler != NULL ? ps_sampler_most_points(spectrum->sampler)
                                                 : job->files.most_points,
        .weights = job->files.weights,
        .integrands = (const ps_integrand *const *)job->integrands,
        .num_integrands = question->num_integrands,
        .first = spectrum->sampler != NULL ? spectrum->num_realizations : job->files.num_predicting,
        .num_sets = is_one_set ? job->trials.num_shifts : job->trials.num_sets,
        .num_shifts = is_one_set ? 1 : job->trials.num_shifts,
        .is_moved = question->is_moved,
        .memory_limit = spectrum->limits.constraints.memory_limit,
        .making_bytes = spectrum->sampler != NULL ? ps_sampler_work_bytes(spectrum->sampler) : 0,
        .device = job->spectrum->device,
        .watch = &spectrum->watch,
    };
    if (spectrum->sampler != NULL && ps_measurement_may_make(&plan, &job->measured_sampler)) {
        plan.made = &job->measured_sampler;
        plan.making_bytes = 0;
    }
    return plan;
}

pspec_status ps_variance_trials_prepare(ps_variance_job *job, ps_error *error) {
    const ps_sampler_request *const sampler = job->question->spectrum.sampler;
    job->trials = choose_trials(job);
    if (sampler != NULL) {
        job->measured_sampler = *sampler;
        job->measured_sampler.homogenize = false;
    }
    const ps_measurement_plan plan = plan_measurement(job);
    return job->trials.num_shifts > 0 ? ps_measurement_bytes(&plan, &job->trial_bytes, error)
                                      : PSPEC_OK;
}

/* ---- run ----------------------------------------------------------------------------------- */

/* The source of the plan: the sampler's *owned, to be destroyed, the files', or none where the
 * device makes the sets. */
static pspec_status open_source(ps_variance_job *job, ps_measurement_plan *plan, ps_source **owned,
                                ps_error *error) {
    const ps_power_question *const spectrum = &job->question->spectrum;
    plan->source = job->files.source;
    if (spectrum->sampler == NULL) {
        return ps_variance_sets_seek(&job->files, error);
    }
    if (plan->made != NULL) {
        return PSPEC_OK;
    }
    ps_sets_options sets = ps_limits_sets(&spectrum->limits, spectrum->accuracy.no_skip);
    sets.first = plan->first;
    sets.taken = (uint64_t)fmax(job->trial_bytes - plan->making_bytes, 0);
    PS_TRY(ps_source_sampler(owned, &job->measured_sampler, job->trials.num_sets, &sets,
                             &spectrum->watch, error));
    plan->source = *owned;
    return PSPEC_OK;
}

pspec_status ps_variance_trials_measure(ps_variance_job *job, ps_error *error) {
    ps_measurement_plan plan = plan_measurement(job);
    ps_checkpoint_spec checkpoint = job->question->spectrum.limits.checkpoint;
    ps_source *owned = NULL;
    uint64_t num_sets = 0;
    for (size_t i = 0; i < plan.num_integrands; i++) {
        job->measured[i] = (ps_mean){NAN, NAN};
    }
    if (job->trials.num_shifts == 0) {
        return PSPEC_OK;
    }
    pspec_status status = PSPEC_OK;
    checkpoint.part = job->question->trials_part;
    plan.checkpoint = &checkpoint;
    PS_TRY_OUT(status, choose_seed(job, &plan.seed, error));
    if (checkpoint.tape == NULL || !checkpoint.tape->is_played) { /* which has the rows of all */
        PS_TRY_OUT(status, open_source(job, &plan, &owned, error));
    }
    status = ps_measurement_run(&plan, &num_sets, job->measured, job->measured_blocks, error);
    job->trials.num_sets = job->trials.is_one_set ? job->trials.num_sets : num_sets;
out:
    ps_source_destroy(owned);
    return status;
}

static pspec_status sum_pairs(ps_variance_job *job, const ps_point_set *set, ps_error *error) {
    const double *const own = set->has_weights ? set->weights : NULL;
    const double *const weights = job->files.weights != NULL ? job->files.weights : own;
    for (size_t i = 0; i < job->question->num_integrands; i++) {
        if (ps_integrand_has_pairs(job->integrands[i])) {
            PS_TRY(ps_watch_tell(&job->question->spectrum.watch, "pairs summed", i,
                                 job->question->num_integrands, NULL, error));
            PS_TRY(ps_integrand_pairwise(job->integrands[i], set->points, weights, set->num_points,
                                         &job->rows[i].pairwise, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_variance_trials_sum_pairs(ps_variance_job *job, ps_error *error) {
    ps_measurement_plan plan = plan_measurement(job);
    ps_source *owned = NULL;
    ps_point_set set = {0};
    for (size_t i = 0; i < plan.num_integrands; i++) {
        job->rows[i].pairwise = NAN;
    }
    if (!job->trials.is_one_set || plan.most_points > PS_MOST_PAIRWISE_POINTS) {
        return PSPEC_OK;
    }
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, open_source(job, &plan, &owned, error));
    PS_TRY_OUT(status, ps_variance_sets_next(plan.source, &set, error));
    status = sum_pairs(job, &set, error);
out:
    ps_point_set_free(&set);
    ps_source_destroy(owned);
    return status;
}

/* ---- plan ---------------------------------------------------------------------------------- */

/* Files are read once more to count their sets, and once more to measure them. */
static void add_reading(const ps_variance_job *job, ps_phases *phases) {
    const ps_power_question *const spectrum = &job->question->spectrum;
    for (int i = 0; i < 2; i++) {
        ps_phases_read(phases, spectrum->paths, spectrum->num_paths, &spectrum->point_options,
                       job->files.dimension);
    }
}

/* Seconds of a processor for a value: 12 ns of a disk, 13 of a Gaussian, 42 of one with images
 * (16384 points, double precision, AVX2, PoCL 3.1). Of a step of a value that is a sum
 * (integrands/integrand.h): 780 coefficients of the plane and 1891 of the sphere at 4096 points,
 * doubles, AVX-512, one processor. Of a GPU 40 operations for a value and 10 for a step at an
 * eighth of an H200's peak in double precision, counted, not measured; there a point that the host
 * hands over counts, too, however often it is moved. */
typedef struct trial_seconds {
    double value, step, point;
} trial_seconds;

static const trial_seconds by_host = {2e-8, 5e-9, 0}, by_kernel = {2e-8, 5e-10, 0};
static const trial_seconds by_gpu = {1e-11, 2.5e-12, 8e-9};

static double seconds_of(const ps_variance_job *job, const ps_integrand *integrand,
                         double num_points, double num_values) {
    const ps_device *const device = job->spectrum->device;
    const bool has_kernel = device != NULL && ps_integrand_kernel(integrand, true) != NULL;
    const bool on_gpu = has_kernel && ps_device_get_limits(device)->has_dedicated_local_memory;
    const trial_seconds *const seconds = on_gpu ? &by_gpu : has_kernel ? &by_kernel : &by_host;
    return num_values * (seconds->value + ps_integrand_steps(integrand) * seconds->step) +
           num_points * seconds->point;
}

void ps_variance_job_phases(const ps_variance_job *job, ps_phases *phases) {
    const ps_power_question *const spectrum = &job->question->spectrum;
    const ps_sets_options sets = ps_limits_sets(&spectrum->limits, spectrum->accuracy.no_skip);
    const double num_sets = (double)job->trials.num_sets;
    const double points = spectrum->sampler != NULL ? (double)spectrum->sampler->num_points
                                                    : (double)job->files.most_points;
    const double value_points = num_sets * (double)job->trials.num_shifts * points;
    const double values = value_points * (double)job->question->num_integrands;
    double seconds = 0;
    char size[PS_SIZE_TEXT];
    ps_phases_add_seconds(phases, "images", job->image_seconds);
    ps_phases_say(phases, "images", "their powers, from pixels");
    if (values == 0) {
        return;
    }
    const bool is_made = plan_measurement(job).made != NULL;
    if (spectrum->sampler == NULL) {
        add_reading(job, phases);
    } else if (!is_made) {
        ps_phases_sample(phases, spectrum->sampler, num_sets, &sets);
    }
    for (size_t i = 0; i < job->question->num_integrands; i++) {
        seconds +=
            seconds_of(job, job->integrands[i], is_made ? 0 : num_sets * points, value_points);
    }
    ps_phases_add(phases, "trials", seconds);
    ps_phases_say(phases, "trials", "%.4g values of integrands, %s of memory", values,
                  ps_size_show(size, job->trial_bytes));
}
