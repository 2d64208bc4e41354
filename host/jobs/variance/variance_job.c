#include "jobs/variance/variance_job.h"

#include "base/memory.h"
#include "jobs/point_phases.h"
#include "jobs/variance/measurement.h"
#include "jobs/variance/prediction.h"

#include <math.h>
#include <stdlib.h>

struct ps_variance_job {
    const ps_variance_question *question;
    ps_power_question spectrum_question;
    ps_power_job *spectrum;
    ps_integrand **integrands; /* [num] */
    double *held;              /* [num] of the energy, up to the cut-off */
    ps_mean *measured;         /* [num] */
    ps_variance_row *rows;     /* [num] */
    ps_power_beyond beyond;
};

static pspec_status weigh(void *payload, const ps_frequencies *frequencies, double *weights,
                          ps_error *error) {
    ps_variance_job *const job = payload;
    for (size_t i = 0; i < job->question->num_integrands; i++) {
        PS_TRY(ps_prediction_weigh(job->integrands[i], frequencies, weights + i * frequencies->num,
                                   &job->held[i], error));
    }
    return PSPEC_OK;
}

/* ---- create -------------------------------------------------------------------------------- */

static ps_integrand_place place_of(const ps_variance_question *question) {
    const ps_sampler_request *const sampler = question->spectrum.sampler;
    return (ps_integrand_place){ps_sampler_where(sampler), sampler->dimension};
}

pspec_status ps_variance_question_check(const ps_variance_question *question, ps_error *error) {
    for (size_t i = 0; i < question->num_integrands; i++) {
        ps_integrand *integrand = NULL;
        PS_TRY(ps_integrand_parse(&integrand, question->texts[i], place_of(question), error));
        ps_integrand_destroy(integrand);
    }
    return PSPEC_OK;
}

static pspec_status parse_integrands(ps_variance_job *job, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const ps_integrand_place place = place_of(question);
    const size_t num = question->num_integrands;
    PS_TRY(PS_NEW(&job->integrands, num, "integrands", error));
    PS_TRY(PS_NEW(&job->held, num, "energies", error));
    PS_TRY(PS_NEW(&job->measured, num, "variances", error));
    PS_TRY(PS_NEW(&job->rows, num, "variances", error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_integrand_parse(&job->integrands[i], question->texts[i], place, error));
    }
    return PSPEC_OK;
}

static pspec_status prepare(ps_variance_job *job, ps_error *error) {
    PS_TRY(parse_integrands(job, error));
    job->spectrum_question = job->question->spectrum;
    job->spectrum_question.num_weighted = job->question->num_integrands;
    job->spectrum_question.weigh = weigh;
    job->spectrum_question.weigh_payload = job;
    return ps_power_job_create(&job->spectrum, &job->spectrum_question, error);
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
    for (size_t i = 0; job->integrands != NULL && i < job->question->num_integrands; i++) {
        ps_integrand_destroy(job->integrands[i]);
    }
    ps_power_job_destroy(job->spectrum);
    free(job->integrands);
    free(job->held);
    free(job->measured);
    free(job->rows);
    free(job);
}

/* ---- run ----------------------------------------------------------------------------------- */

static pspec_status measure(ps_variance_job *job, ps_error *error) {
    const ps_variance_question *const question = job->question;
    const ps_power_question *const spectrum = &question->spectrum;
    ps_sampler_request sampler = *spectrum->sampler;
    for (size_t i = 0; i < question->num_integrands; i++) {
        job->measured[i] = (ps_mean){NAN, NAN};
    }
    if (question->num_shifts == 0) {
        return PSPEC_OK;
    }
    sampler.homogenize = false;
    const ps_measurement_plan plan = {
        .sampler = &sampler,
        .integrands = (const ps_integrand *const *)job->integrands,
        .num_integrands = question->num_integrands,
        .first = spectrum->num_realizations,
        .num_sets = spectrum->num_realizations,
        .num_shifts = question->num_shifts,
        .is_moved = question->is_moved,
        .sets = ps_limits_sets(&spectrum->limits, spectrum->accuracy.no_skip),
        .device = ps_power_job_device(job->spectrum),
        .watch = &spectrum->watch,
    };
    return ps_measurement_run(&plan, job->measured, error);
}

static double z_score(const ps_variance_row *row, bool is_moved) {
    const double error = hypot(row->prediction.standard_error, row->measured_error);
    return is_moved && error > 0 ? (row->measured - row->prediction.variance) / error : NAN;
}

static void fill_rows(ps_variance_job *job) {
    const ps_variance_question *const question = job->question;
    const ps_spectrum *const spectrum = ps_power_job_spectrum(job->spectrum);
    const ps_mean *const sums = ps_power_job_weighted(job->spectrum);
    job->beyond = ps_prediction_power_beyond(question->spectrum.sampler, spectrum);
    for (size_t i = 0; i < question->num_integrands; i++) {
        ps_variance_row *const row = &job->rows[i];
        row->prediction = ps_prediction_make(job->integrands[i], sums[i], job->held[i],
                                             spectrum->mean_points, &job->beyond);
        row->measured = job->measured[i].mean;
        row->measured_error = job->measured[i].standard_error;
        row->z_score = z_score(row, question->is_moved);
    }
}

pspec_status ps_variance_job_run(ps_variance_job *job, ps_error *error) {
    PS_TRY(ps_power_job_run(job->spectrum, error));
    PS_TRY(measure(job, error));
    fill_rows(job);
    return PSPEC_OK;
}

void ps_variance_job_phases(const ps_variance_job *job, ps_phases *phases) {
    /* of a processor: 12 ns of a disk, 13 of a Gaussian, 42 of one with images (16384 points,
     * double precision, AVX2, PoCL 3.1) */
    const double value_seconds = 2e-8;
    const ps_variance_question *const question = job->question;
    const ps_power_question *const spectrum = &question->spectrum;
    const ps_sets_options sets = ps_limits_sets(&spectrum->limits, spectrum->accuracy.no_skip);
    const double num_sets = (double)spectrum->num_realizations;
    const double values = num_sets * (double)question->num_shifts *
                          (double)spectrum->sampler->num_points * (double)question->num_integrands;
    if (values == 0) {
        return;
    }
    ps_phases_sample(phases, spectrum->sampler, num_sets, &sets.place);
    ps_phases_add_seconds(phases, "trials", values * value_seconds);
    ps_phases_say(phases, "trials", "%.4g values of integrands", values);
}

ps_power_job *ps_variance_job_spectrum(const ps_variance_job *job) {
    return job->spectrum;
}

const ps_integrand *ps_variance_job_integrand(const ps_variance_job *job, size_t index) {
    return job->integrands[index];
}

const ps_variance_row *ps_variance_job_rows(const ps_variance_job *job) {
    return job->rows;
}

const ps_power_beyond *ps_variance_job_power_beyond(const ps_variance_job *job) {
    return &job->beyond;
}
