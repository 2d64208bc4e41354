#include "jobs/variance/variance_job.h"

#include "base/memory.h"
#include "files/input_file.h"
#include "jobs/variance/formulas.h"

#include <math.h>
#include <stdlib.h>

static ps_point_way way_of(const ps_variance_job *job) {
    const ps_power_question *const spectrum = &job->question->spectrum;
    return (ps_point_way){job->spectrum->device, spectrum->limits.constraints.memory_limit,
                          &spectrum->watch};
}

static pspec_status weigh(void *payload, const ps_frequencies *frequencies, double *weights,
                          ps_error *error) {
    ps_variance_job *const job = payload;
    const ps_point_way way = way_of(job);
    for (size_t i = 0; i < job->question->num_integrands; i++) {
        PS_TRY(ps_prediction_weigh(job->integrands[i], frequencies, job->question->over_shells,
                                   &way, weights + i * frequencies->num, &job->held[i], error));
    }
    return PSPEC_OK;
}

/* ---- create -------------------------------------------------------------------------------- */

/* The dimension of files is known once they are open. */
static ps_integrand_place place_of(const ps_variance_question *question, unsigned dimension) {
    const ps_sampler_request *const sampler = question->spectrum.sampler;
    const ps_power_question *const spectrum = &question->spectrum;
    const ps_sampler_domain where = spectrum->on_hemisphere ? PS_SAMPLES_HEMISPHERE
                                    : spectrum->on_sphere   ? PS_SAMPLES_SPHERE
                                                            : PS_SAMPLES_TORUS;
    return sampler != NULL ? (ps_integrand_place){ps_sampler_where(sampler), sampler->dimension}
                           : (ps_integrand_place){where, dimension};
}

static pspec_status check_integrand(const ps_variance_question *question,
                                    const ps_integrand *integrand, ps_error *error) {
    const bool is_on_torus = integrand->place.where == PS_SAMPLES_TORUS;
    if (question->over_shells && !is_on_torus) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "shells are of frequencies of the torus; degrees are exact as they are");
    }
    if (question->over_shells && !ps_integrand_is_isotropic(integrand)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: its powers depend on more than |k|, and a sum over shells "
                       "takes them from |k| alone",
                       integrand->kind->name);
    }
    return !question->wants_paper || ps_integrand_is_radial(integrand)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "integrand %s: the integral of the paper is over |k| on the torus, and "
                         "its spectrum is no function of |k|",
                         integrand->kind->name);
}

static pspec_status take_integrand(ps_integrand **out, const ps_variance_question *question,
                                   size_t index, unsigned dimension, ps_error *error) {
    PS_TRY(ps_integrand_take(out, question->made, &question->given, question->texts[index],
                             place_of(question, dimension),
                             question->spectrum.limits.constraints.memory_limit, error));
    return check_integrand(question, *out, error);
}

pspec_status ps_variance_question_check(const ps_variance_question *question, ps_error *error) {
    const ps_power_question *const spectrum = &question->spectrum;
    const unsigned dimension =
        spectrum->on_sphere ? PS_SPHERE_DIMENSION : spectrum->point_options.dimension;
    if (spectrum->sampler == NULL && dimension == 0) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < question->num_integrands; i++) {
        ps_integrand *integrand = NULL;
        PS_TRY(take_integrand(&integrand, question, i, dimension, error));
    }
    return PSPEC_OK;
}

static pspec_status take_integrands(ps_variance_job *job, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const size_t num = question->num_integrands;
    PS_TRY(PS_NEW(&job->integrands, num, "integrands", error));
    PS_TRY(PS_NEW(&job->held, num, "energies", error));
    PS_TRY(PS_NEW(&job->measured, num, "variances", error));
    PS_TRY(PS_NEW(&job->measured_blocks, num, "variances", error));
    PS_TRY(PS_NEW(&job->rows, num, "variances", error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(take_integrand(&job->integrands[i], question, i, job->files.dimension, error));
    }
    return PSPEC_OK;
}

static pspec_status open_files(ps_variance_job *job, ps_error *error) {
    ps_power_question *const spectrum = &job->spectrum_question;
    if (spectrum->sampler != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_points_check(spectrum->paths, spectrum->num_paths, &spectrum->point_options, error));
    PS_TRY(ps_input_check(spectrum->weights.path, error));
    PS_TRY(ps_variance_sets_open(&job->files, spectrum, job->question->num_shifts > 0, error));
    spectrum->source = job->files.source;
    spectrum->num_sets = job->files.num_predicting;
    return PSPEC_OK;
}

static bool are_predicted(const ps_variance_job *job) {
    size_t i = 0;
    while (i < job->question->num_integrands && !ps_integrand_is_predicted(job->integrands[i])) {
        i++;
    }
    return i < job->question->num_integrands;
}

/* Frequencies that matter to no integrand are left out, unless profiles are to be found of them. */
static void find_useful(ps_variance_job *job) {
    const ps_variance_question *const question = job->question;
    ps_power_question *const spectrum = &job->spectrum_question;
    job->reach = ps_prediction_reach((const ps_integrand *const *)job->integrands,
                                     question->num_integrands, question->over_shells);
    const bool finds_profiles = question->bounds.is_wanted && !question->bounds.is_given;
    if (job->reach <= PS_MAX_FREQUENCY && !finds_profiles) {
        spectrum->useful = (int32_t)job->reach;
        spectrum->useful_why = are_predicted(job)
                                   ? "less than 1e-16 of the energy of every integrand is there"
                                   : "of no integrand a variance is predicted";
    }
}

static pspec_status time_images(ps_variance_job *job, ps_error *error) {
    const ps_point_way way = way_of(job);
    for (size_t i = 0; i < job->question->num_integrands; i++) {
        double seconds = 0;
        if (ps_integrand_has_points(job->integrands[i])) {
            PS_TRY(ps_point_powers_seconds(&seconds, job->integrands[i],
                                           job->spectrum->problem.frequencies, &way, error));
        }
        job->image_seconds += seconds;
    }
    return PSPEC_OK;
}

static pspec_status prepare(ps_variance_job *job, ps_error *error) {
    job->spectrum_question = job->question->spectrum;
    job->spectrum_question.num_weighted = job->question->num_integrands;
    job->spectrum_question.weigh = weigh;
    job->spectrum_question.weigh_payload = job;
    PS_TRY(open_files(job, error));
    PS_TRY(take_integrands(job, error));
    find_useful(job);
    PS_TRY(ps_power_job_create(&job->spectrum, &job->spectrum_question, error));
    PS_TRY(time_images(job, error));
    return ps_variance_trials_prepare(job, error);
}

pspec_status ps_variance_job_create(ps_variance_job **out, const ps_variance_question *question,
                                    ps_error *error) {
    ps_variance_job *job = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&job, 1, "a job", error));
    job->question = question;
    const pspec_status status = prepare(job, error);
    if (status != PSPEC_OK) {
        ps_variance_job_destroy(job);
        return status;
    }
    *out = job;
    return PSPEC_OK;
}

void ps_variance_job_destroy(ps_variance_job *job) {
    if (job == NULL) {
        return;
    }
    ps_power_job_destroy(job->spectrum);
    ps_variance_sets_close(&job->files);
    free(job->integrands);
    free(job->held);
    free(job->measured);
    free(job->measured_blocks);
    free(job->rows);
    free(job);
}

/* ---- run ----------------------------------------------------------------------------------- */

/* None where both sides are but rounding: the variance of an error of 1e-14 of the mean, as that of
 * a constant map, or what the energy is not known to. */
static double z_score(const ps_variance_row *row, const ps_integrand *integrand, bool is_moved) {
    const double integral = ps_integrand_integral(integrand);
    const double energy = ps_integrand_factor(integrand) * ps_integrand_energy(integrand);
    const double rounding = 1e-28 * integral * integral + PS_BEYOND_REACH * energy;
    const double error = hypot(row->prediction.standard_error, row->measured_error);
    return is_moved && error > 0 && fmax(row->measured, row->prediction.variance) > rounding
               ? (row->measured - row->prediction.variance) / error
               : NAN;
}

/* A single set has at most N (sum |w|)^2/W^2 at any frequency. */
static ps_power_beyond find_power_beyond(const ps_variance_job *job, const ps_spectrum *spectrum) {
    const double num_points = spectrum->mean_points;
    ps_power_beyond beyond =
        ps_prediction_power_beyond(job->question->spectrum.sampler, spectrum, job->reach);
    if (job->files.num > 0) { /* and no less than what predictions have there */
        beyond.white = num_points * job->files.white;
        beyond.most = fmax(beyond.most, beyond.white);
    }
    if (job->files.num == 1) {
        beyond.most = num_points * job->files.size;
        beyond.is_known = true;
    }
    return beyond;
}

static pspec_status find_shape(ps_variance_job *job, ps_error *error) {
    const ps_bounds_spec *const bounds = &job->question->bounds;
    if (bounds->is_given) {
        job->shape = (ps_shape){.above = bounds->above, .below = bounds->below};
    }
    return bounds->is_wanted && !bounds->is_given
               ? ps_shape_find(&job->shape, &job->spectrum->spectrum, NAN, error)
               : PSPEC_OK;
}

static pspec_status add_bounds(ps_variance_job *job, size_t integrand, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const ps_spectrum *const spectrum = &job->spectrum->spectrum;
    ps_variance_row *const row = &job->rows[integrand];
    const ps_shape *const shape = &job->shape;
    const ps_point_way way = way_of(job);
    row->best_bound = NAN;
    row->worst_bound = NAN;
    if (!ps_integrand_is_predicted(job->integrands[integrand])) {
        row->prediction = (ps_prediction){NAN, NAN, NAN, NAN, NAN};
        return PSPEC_OK;
    }
    if (question->bounds.is_wanted && shape->below_reason.status == PSPEC_OK) {
        PS_TRY(ps_bounds_variance(&row->best_bound, job->integrands[integrand], spectrum,
                                  question->over_shells, &way, &shape->below, true, error));
    }
    return question->bounds.is_wanted && shape->above_reason.status == PSPEC_OK
               ? ps_bounds_variance(&row->worst_bound, job->integrands[integrand], spectrum,
                                    question->over_shells, &way, &shape->above, false, error)
               : PSPEC_OK;
}

static pspec_status fill_rows(ps_variance_job *job, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const ps_spectrum *const spectrum = &job->spectrum->spectrum;
    job->beyond = find_power_beyond(job, spectrum);
    PS_TRY(find_shape(job, error));
    for (size_t i = 0; i < question->num_integrands; i++) {
        ps_variance_row *const row = &job->rows[i];
        ps_mean sum = job->spectrum->weighted[i];
        if (job->trials.is_one_set) {
            sum.standard_error = 0; /* every move of the set has this spectrum */
        }
        row->prediction = ps_prediction_make(job->integrands[i], sum, job->held[i],
                                             spectrum->mean_points, &job->beyond);
        PS_TRY(add_bounds(job, i, error));
        row->paper = NAN;
        if (question->wants_paper) {
            PS_TRY(ps_radial_variance(&row->paper, job->integrands[i], spectrum, error));
        }
        row->measured = job->measured[i].mean;
        row->measured_error = job->measured[i].standard_error;
        row->z_score = z_score(row, job->integrands[i], question->is_moved);
    }
    return PSPEC_OK;
}

pspec_status ps_variance_job_run(ps_variance_job *job, ps_error *error) {
    PS_TRY(ps_power_job_run(job->spectrum, error));
    ps_power_job_release(job->spectrum);
    PS_TRY(ps_variance_trials_measure(job, error));
    PS_TRY(ps_variance_trials_sum_pairs(job, error));
    return fill_rows(job, error);
}

/* What is added to the sum of powers for what lies beyond the cut-off has no error. */
void ps_variance_job_log(const ps_variance_job *job, size_t integrand, ps_variance_number number,
                         ps_log_variance *out) {
    const ps_variance_row *const row = &job->rows[integrand];
    const bool is_measured = number == PS_VARIANCE_MEASURED;
    const double values[] = {
        [PS_VARIANCE_PREDICTED] = row->prediction.variance,
        [PS_VARIANCE_LOWER] = row->prediction.lower,
        [PS_VARIANCE_UPPER] = row->prediction.upper,
        [PS_VARIANCE_MEASURED] = row->measured,
    };
    const ps_mean variance = {values[number],
                              is_measured ? row->measured_error : row->prediction.standard_error};
    ps_log_variance_make(out, job->spectrum->spectrum.mean_points, variance,
                         is_measured ? &job->measured_blocks[integrand]
                                     : &job->spectrum->weighted_blocks[integrand]);
}
