/* Predicting a variance beside measuring it, both to a standard error of 3 %: seconds of each, and
 * how many times cheaper the prediction is, for samplers of the plane and one integrand.
 *
 *     bench_variance [INTEGRAND [MOST_POINTS [SAMPLER...]]]
 *
 * by default disk:radius=0.25, N = 16, 32, .. 16384, and five samplers; where one cannot have so
 * many points, it takes the nearest number. A pilot says how many sets each way needs. The
 * prediction is `pointspec variance --shifts 0 --tol 1e-3`, spectra and all but the device, which
 * is open. The measurement is done twice, with one shift of every set and with 16. Sets are made
 * anew, and are a part of all times: points_s is what those of the prediction cost alone. The
 * errors that came out stand beside.
 */
#include "bench.h"

#include "jobs/variance/measurement.h"
#include "jobs/variance/variance_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double TARGET = 0.03; /* 2200 trials of a normal estimate */
enum { PILOT = 64, LEAST_SETS = 8, SEED = 3, SHIFTS = 16, MOST_SETS = 100000 };

typedef struct asked {
    const char *integrand;
    ps_sampler_request sampler;
    ps_device *device;
} asked;

/* What a way needed. */
typedef struct spent {
    double value, error, seconds;
    uint64_t num_sets;
} spent;

/* ---- predicting ---------------------------------------------------------------------------- */

static ps_variance_question make_question(const asked *what, uint64_t num_sets,
                                          ps_made_integrands *made) {
    const double tolerance = 1e-3; /* enough for TARGET */
    return (ps_variance_question){.spectrum = {.sampler = &what->sampler,
                                               .num_realizations = num_sets,
                                               .wants_full_array = true,
                                               .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                                               .accuracy.tolerance = tolerance,
                                               .limits.constraints.precision = -1,
                                               .open_device = what->device},
                                  .texts = &what->integrand,
                                  .num_integrands = 1,
                                  .made = made,
                                  .is_moved = true};
}

static spent predict(const asked *what, uint64_t num_sets) {
    ps_made_integrands made = {0};
    const ps_variance_question question = make_question(what, num_sets, &made);
    ps_variance_job *job = NULL;
    const double begin = bench_seconds();
    BENCH_TRY(ps_variance_job_create(&job, &question, error));
    BENCH_TRY(ps_variance_job_run(job, error));
    const ps_prediction *const found = &job->rows[0].prediction;
    const spent out = {.value = found->variance,
                       .error = found->standard_error,
                       .seconds = bench_seconds() - begin,
                       .num_sets = num_sets};
    ps_variance_job_destroy(job);
    ps_made_integrands_free(&made);
    return out;
}

/* ---- measuring ----------------------------------------------------------------------------- */

static ps_source *open_source(const asked *what, uint64_t first, uint64_t num_sets) {
    const ps_sets_options sets = {.first = first};
    ps_source *source = NULL;
    BENCH_TRY(ps_source_sampler(&source, &what->sampler, num_sets, &sets, NULL, error));
    return source;
}

static spent measure(const asked *what, uint64_t num_sets, uint64_t num_shifts) {
    const ps_integrand_place place = {PS_SAMPLES_TORUS, what->sampler.dimension};
    const ps_watch watch = {0};
    ps_integrand *integrand = NULL;
    ps_mean found;
    ps_block_sums blocks = {0};
    const double begin = bench_seconds();
    BENCH_TRY(ps_integrand_parse(&integrand, what->integrand, place, error));
    ps_source *const source = open_source(what, num_sets, num_sets);
    const ps_measurement_plan plan = {.source = source,
                                      .most_points = ps_sampler_most_points(&what->sampler),
                                      .integrands = (const ps_integrand *const *)&integrand,
                                      .num_integrands = 1,
                                      .first = num_sets,
                                      .num_sets = num_sets,
                                      .num_shifts = num_shifts,
                                      .seed = SEED,
                                      .is_moved = true,
                                      .device = what->device,
                                      .watch = &watch};
    uint64_t num_measured = 0;
    BENCH_TRY(ps_measurement_run(&plan, &num_measured, &found, &blocks, error));
    const spent out = {found.mean, found.standard_error, bench_seconds() - begin, num_sets};
    ps_source_destroy(source);
    ps_integrand_destroy(integrand);
    return out;
}

static double make_sets(const asked *what, uint64_t num_sets) {
    const size_t most = ps_sampler_most_points(&what->sampler);
    double *const points = calloc(most * what->sampler.dimension, sizeof *points);
    ps_sets *sets = NULL;
    const ps_sets_options options = {0};
    const double begin = bench_seconds();
    if (points == NULL) {
        bench_die("no memory for points");
    }
    BENCH_TRY(ps_sets_create(&sets, &what->sampler, num_sets, &options, error));
    for (uint64_t r = 0; r < num_sets; r++) {
        size_t num = 0;
        BENCH_TRY(ps_sets_next(sets, points, &num, NULL, error));
    }
    ps_sets_destroy(sets);
    free(points);
    return bench_seconds() - begin;
}

/* ---- both ---------------------------------------------------------------------------------- */

/* Sets that have the error, if that of the pilot is right. */
static uint64_t sets_for(const spent *pilot) {
    const double times = pow(pilot->error / pilot->value / TARGET, 2);
    const double num = ceil((double)pilot->num_sets * times);
    return num < LEAST_SETS ? LEAST_SETS : num > MOST_SETS ? MOST_SETS : (uint64_t)num;
}

static spent predict_well(const asked *what) {
    const spent pilot = predict(what, PILOT);
    return predict(what, sets_for(&pilot));
}

static spent measure_well(const asked *what, uint64_t num_shifts) {
    const uint64_t num = PILOT * SHIFTS / num_shifts; /* of one shift more: they are skewed */
    const spent pilot = measure(what, num, num_shifts);
    const uint64_t needed = sets_for(&pilot);
    return measure(what, needed < PILOT ? PILOT : needed, num_shifts);
}

static void print_measured(const spent *measured, const spent *predicted) {
    printf(" %10.3e %5.1f %6llu %9.3f %7.2f %6.2f", measured->value,
           100 * measured->error / measured->value, (unsigned long long)measured->num_sets,
           measured->seconds, measured->seconds / predicted->seconds,
           (measured->value - predicted->value) / hypot(measured->error, predicted->error));
}

static void run_case(const char *name, const char *integrand, size_t num_points,
                     ps_device *device) {
    asked what = {.integrand = integrand,
                  .sampler = {.num_points = num_points, .seed = SEED},
                  .device = device};
    BENCH_TRY(ps_sampler_parse(&what.sampler, name, error));
    BENCH_TRY(ps_sampler_resolve(&what.sampler, error));
    const spent predicted = predict_well(&what);
    const spent once = measure_well(&what, 1);
    const spent often = measure_well(&what, SHIFTS);
    const double sets = make_sets(&what, predicted.num_sets);
    printf("%-16s %6zu %10.3e %5.1f %6llu %9.3f %9.3f", name, what.sampler.num_points,
           predicted.value, 100 * predicted.error / predicted.value,
           (unsigned long long)predicted.num_sets, sets, predicted.seconds);
    print_measured(&once, &predicted);
    print_measured(&often, &predicted);
    printf("\n");
    fflush(stdout);
}

int main(int argc, char **argv) {
    static const char *const defaults[] = {"white", "jittered", "latin-hypercube", "poisson-disk",
                                           "bridson"};
    enum { FIRST_SAMPLER = 3, LEAST_POINTS = 16, MOST_POINTS = 16384 };
    const char *const integrand = argc > 1 ? argv[1] : "disk:radius=0.25";
    const size_t most = argc > 2 ? strtoul(argv[2], NULL, 10) : MOST_POINTS;
    const bool has_own = argc > FIRST_SAMPLER;
    const size_t num =
        has_own ? (size_t)(argc - FIRST_SAMPLER) : sizeof defaults / sizeof *defaults;
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, getenv("POINTSPEC_DEVICE"), false, error));
    printf("# %s; all to %g %%: error in %%, sets, seconds; measured with a shift of each set, and "
           "with %d; ratio: times cheaper is the prediction\n",
           integrand, 100 * TARGET, SHIFTS);
    printf("%-16s %6s %10s %5s %6s %9s %9s %10s %5s %6s %9s %7s %6s %10s %5s %6s %9s %7s %6s\n",
           "sampler", "N", "predicted", "error", "sets", "points_s", "predict_s", "measured",
           "error", "sets", "seconds", "ratio", "z", "often", "error", "sets", "seconds", "ratio",
           "z");
    for (size_t i = 0; i < num; i++) {
        for (size_t n = LEAST_POINTS; n <= most; n *= 2) {
            run_case(has_own ? argv[FIRST_SAMPLER + i] : defaults[i], integrand, n, device);
        }
    }
    ps_device_close(device);
    return 0;
}
