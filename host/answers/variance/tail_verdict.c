#include "answers/variance/tail_verdict.h"

#include "base/memory.h"
#include "jobs/variance/tails.h"
#include "request/options.h"

#include <math.h>
#include <stdlib.h>

/* The rows of all questions and what would do for them. */
typedef struct judging {
    const ps_request *request;
    ps_variance_job *const *jobs;
    size_t num_missed;
    double cutoff;                     /* the largest that a row takes */
    double missed_cutoff;              /* the largest that one of those that miss takes, which is */
    size_t worst_job, worst_integrand; /* this one */
} judging;

static const ps_spectrum *spectrum_of(const judging *self, size_t job) {
    return &self->jobs[job]->spectrum->spectrum;
}

static double tail_of(const ps_prediction *prediction) {
    const double half = (prediction->upper - prediction->lower) / 2;
    return half > 0 ? half / prediction->variance : 0;
}

double ps_variance_largest_tail(const ps_request *request, ps_variance_job *const *jobs,
                                size_t num) {
    double largest = 0;
    for (size_t i = 0; i < num; i++) {
        for (size_t k = 0; k < request->num_integrands; k++) {
            largest = fmax(largest, tail_of(&jobs[i]->rows[k].prediction));
        }
    }
    return largest;
}

/* From here on sets of samplers have the power 1, or that as a mean: the default cut-off. */
static double white_from(const ps_spectrum *spectrum, bool is_on_torus) {
    const double times = is_on_torus ? 5 : 4;
    const unsigned dimension = ps_frequencies_space_dimension(&spectrum->frequencies);
    return ceil(times * pow(spectrum->mean_points, 1.0 / dimension));
}

/* What a sampler may have between a cut-off that misses its peak and white noise: more than P15 has
 * measured of any. */
static const double MOST_OF_PEAKS = 4;

static double cutoff_of(const ps_variance_job *job) {
    return job->spectrum->spectrum.frequencies.max_frequency;
}

static bool is_on_torus(const ps_variance_job *job) {
    return job->integrands[0]->place.where == PS_SAMPLES_TORUS;
}

double ps_variance_likely_most(const ps_variance_job *job) {
    const ps_power_beyond *const beyond = &job->beyond;
    const ps_spectrum *const spectrum = &job->spectrum->spectrum;
    const bool has_peak =
        beyond->is_known || cutoff_of(job) >= white_from(spectrum, is_on_torus(job));
    return has_peak ? beyond->most : fmax(beyond->most, MOST_OF_PEAKS);
}

/* The energy beyond a cut-off that would do: most T/2 <= X (sum + T). The sum can only grow with
 * the cut-off. Nobody knows what is added between this cut-off and white noise, and then nothing
 * is. */
static double find_energy(const judging *self, const ps_variance_job *job, size_t integrand,
                          const ps_tails *tails) {
    const ps_prediction *const prediction = &job->rows[integrand].prediction;
    const ps_power_beyond *const beyond = &job->beyond;
    const ps_spectrum *const spectrum = &job->spectrum->spectrum;
    const double factor = ps_integrand_factor(job->integrands[integrand]);
    const double from = fmax(cutoff_of(job), white_from(spectrum, is_on_torus(job)));
    const double rest = beyond->white * factor * ps_tails_beyond(tails, from);
    const double sum = prediction->lower * spectrum->mean_points + rest;
    return 2 * self->request->tail * sum / (ps_variance_likely_most(job) * factor);
}

/* Two digits, upwards, from a little more: the larger the better, but for what has nothing beyond
 * its reach. */
static double round_up(double cutoff, double reach) {
    const double more = 1.05;
    const double least = ceil(cutoff * more);
    const double unit = pow(10, fmax(floor(log10(least)) - 1, 0));
    const double rounded = isfinite(cutoff) ? ceil(least / unit) * unit : INFINITY;
    return cutoff <= reach ? fmin(rounded, reach) : rounded;
}

static bool is_possible(const ps_variance_job *job, double cutoff) {
    const ps_integrand_place place = job->integrands[0]->place;
    ps_frequencies set;
    if (place.where != PS_SAMPLES_TORUS) {
        return cutoff <= PS_MAX_DEGREE;
    }
    return cutoff <= PS_MAX_FREQUENCY &&
           ps_frequencies_lattice(&set, place.dimension, (int32_t)cutoff, false, NULL) == PSPEC_OK;
}

static pspec_status open_tails(ps_tails **out, const ps_request *request,
                               const ps_variance_job *job, size_t integrand, ps_error *error) {
    const bool over_shells = request->frequencies.bins.kind == PS_BINS_SHELLS;
    return ps_tails_create(out, job->integrands[integrand], over_shells, error);
}

/* Larger than that of the job, which was not enough. */
static double find_cutoff(const ps_tails *tails, const ps_variance_job *job, size_t integrand,
                          double energy) {
    const double reach = ps_integrand_reach(job->integrands[integrand]);
    return round_up(fmax(ps_tails_find(tails, energy), cutoff_of(job) + 1), reach);
}

pspec_status ps_variance_find_cutoff(double *out, const ps_request *request,
                                     const ps_variance_job *job, size_t integrand, double energy,
                                     ps_error *error) {
    ps_tails *tails = NULL;
    PS_TRY(open_tails(&tails, request, job, integrand, error));
    const double cutoff = find_cutoff(tails, job, integrand, energy);
    ps_tails_destroy(tails);
    *out = is_possible(job, cutoff) ? cutoff : INFINITY;
    return PSPEC_OK;
}

static void add_row(judging *self, size_t job, size_t integrand, const ps_tails *tails) {
    const ps_variance_job *const asked = self->jobs[job];
    if (tail_of(&asked->rows[integrand].prediction) <= self->request->tail) {
        self->cutoff = fmax(self->cutoff, cutoff_of(asked));
        return;
    }
    const double cutoff =
        find_cutoff(tails, asked, integrand, find_energy(self, asked, integrand, tails));
    if (self->num_missed == 0 || cutoff > self->missed_cutoff) {
        self->missed_cutoff = cutoff;
        self->worst_job = job;
        self->worst_integrand = integrand;
    }
    self->num_missed++;
    self->cutoff = fmax(self->cutoff, cutoff);
}

/* Of all questions: they have the same integrands. */
static pspec_status add_integrand(judging *self, size_t num, size_t integrand, ps_error *error) {
    ps_tails *tails = NULL;
    PS_TRY(open_tails(&tails, self->request, self->jobs[0], integrand, error));
    for (size_t i = 0; i < num; i++) {
        add_row(self, i, integrand, tails);
    }
    ps_tails_destroy(tails);
    return PSPEC_OK;
}

/* "half of upper - lower of disk by white at N = 64 is 0.12 of predicted, above tail 0.01; about
 * max-frequency 1300 would do": options by their names, for it stands in files, too, which do not
 * depend on how they were asked for */
static void describe(const judging *self, ps_text *out) {
    const ps_request *const request = self->request;
    const ps_spectrum *const spectrum = spectrum_of(self, self->worst_job);
    const bool on_torus = spectrum->frequencies.kind != PS_FREQUENCIES_DEGREES;
    const ps_option_id id = on_torus ? PS_OPTION_MAX_FREQUENCY : PS_OPTION_MAX_DEGREE;
    const ps_prediction *const prediction =
        &self->jobs[self->worst_job]->rows[self->worst_integrand].prediction;
    const char *const name = ps_request_name(request, self->worst_job);
    ps_text_append(out,
                   "half of upper - lower of %s by %s at N = %.10g is %.3g of predicted, above %s "
                   "%g",
                   request->integrands[self->worst_integrand],
                   name != NULL ? name : request->files[0], spectrum->mean_points,
                   tail_of(prediction), ps_options[PS_OPTION_TAIL].name, request->tail);
    if (self->num_missed > 1) {
        ps_text_append(out, ", and %zu rows are above it", self->num_missed);
    }
    if (is_possible(self->jobs[0], self->cutoff)) {
        ps_text_append(out, "; about %s %.0f would do%s", ps_options[id].name, self->cutoff,
                       self->num_missed > 1 ? " for all rows" : "");
    } else {
        ps_text_append(out, "; no cut-off that can be computed would do");
    }
}

pspec_status ps_variance_judge_tails(ps_error *verdict, const ps_request *request,
                                     ps_variance_job *const *jobs, size_t num, ps_error *error) {
    judging self = {.request = request, .jobs = jobs};
    ps_text sentence = {0};
    if (request->tail == 0 || ps_variance_largest_tail(request, jobs, num) <= request->tail) {
        return PSPEC_OK;
    }
    for (size_t k = 0; k < request->num_integrands; k++) {
        if (ps_integrand_is_predicted(jobs[0]->integrands[k])) {
            PS_TRY(add_integrand(&self, num, k, error));
        }
    }
    describe(&self, &sentence);
    const pspec_status status = ps_text_check(&sentence, error);
    if (status == PSPEC_OK) {
        ps_fail(verdict, PSPEC_ERROR_TOLERANCE, "%s", ps_text_string(&sentence));
    }
    ps_text_free(&sentence);
    return status;
}
