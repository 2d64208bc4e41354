/* Random small jobs give the same answer with and without skips, within the tolerance asked. */
#include "harness_estimator.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"
#include "jobs/quadrature/quadrature_job.h"
#include "jobs/spectrum/power_job.h"

#include <math.h>

static size_t pick(uint64_t *state, size_t num) {
    return (size_t)(test_uniform(state) * (double)num);
}

static double pick_power(uint64_t *state, double low, double high) {
    return low * pow(high / low, test_uniform(state));
}

/* Every third job takes what the planner takes, which has kernels of its own for each size and
 * tolerance: building them is what this test takes. */
static const char *pick_engine(size_t job, const char *direct) {
    return job % 3 == 0 ? NULL : direct;
}

static double pick_tolerance(uint64_t *state, size_t job, double low, double high) {
    const double any = pick_power(state, low, high);
    return job % 3 == 0 ? 1e-4 : any;
}

static void sample(ps_sampler_request *request, const char *text, size_t num_points,
                   unsigned dimension, uint64_t seed, bool homogenize) {
    *request = (ps_sampler_request){
        .num_points = num_points, .dimension = dimension, .seed = seed, .homogenize = homogenize};
    assert_ok(ps_sampler_parse(request, text, error));
    assert_ok(ps_sampler_resolve(request, error));
}

/* ---- spectra --------------------------------------------------------------------------------- */

static ps_power_job *run_power(ps_power_question *question, bool no_skip) {
    ps_power_job *job = NULL;
    question->accuracy.no_skip = no_skip;
    assert_ok(ps_power_job_create(&job, question, error));
    assert_ok(ps_power_job_run(job, error));
    return job;
}

/* sqrt(P) of a bin is within e / sqrt(its share of the modes) (docs/user/conventions.md), on both
 * sides. */
static double allowed(const ps_spectrum_bin *bin, double modes, double tolerance) {
    const double e = 2 * tolerance * sqrt(modes / (double)bin->num_computed);
    return 2 * sqrt(bin->power) * e + e * e;
}

static void compare_spectra(const ps_power_job *a, const ps_power_job *b) {
    const ps_spectrum *const x = &a->spectrum;
    const ps_spectrum *const y = &b->spectrum;
    const double tolerance = a->problem.tolerance;
    const bool of_pairs = a->problem.measure == PS_OF_PAIR_SUMS;
    double modes = 0;
    assert_true(b->problem.tolerance <= tolerance);
    assert_int_equal(x->num_bins, y->num_bins);
    assert_int_equal(x->num_realizations, y->num_realizations);
    for (size_t i = 0; i < x->num_bins; i++) {
        modes += (double)x->bins[i].num_computed;
    }
    for (size_t i = 0; i < x->num_bins; i++) {
        const double most = of_pairs ? 2 * tolerance : allowed(&x->bins[i], modes, tolerance);
        assert_int_equal(x->bins[i].key, y->bins[i].key);
        assert_true(fabs(x->bins[i].power - y->bins[i].power) <= most + 1e-14);
        if (x->num_realizations >
            1) { /* of white noise at most a few powers, so a few errors of one */
            assert_true(fabs(x->bins[i].standard_error - y->bins[i].standard_error) <=
                        2 * most + 1e-13 * (1 + x->bins[i].power));
        }
    }
}

static void torus(void **state) {
    static const char *const samplers[] = {"white",   "jittered", "latin-hypercube",
                                           "regular", "sobol",    "hammersley"};
    enum { JOBS = 10 };
    uint64_t random = 41;
    size_t skipped = 0;
    (void)state;
    for (size_t i = 0; i < JOBS; i++) {
        ps_sampler_request request;
        const size_t side = test_uniform(&random) < 0.5 ? 6 : 11;
        const unsigned dimension = 1 + (unsigned)pick(&random, 2);
        sample(&request, samplers[pick(&random, 6)], dimension == 2 ? side * side : side, dimension,
               i + 1, test_uniform(&random) < 0.3);
        ps_power_question question = {
            .sampler = &request,
            .num_realizations = test_uniform(&random) < 0.3 ? 1 : 6,
            .frequencies.max_frequency = test_uniform(&random) < 0.5 ? 5 : 17,
            .frequencies.bins.kind = test_uniform(&random) < 0.3 ? PS_BINS_SHELLS : PS_BINS_ROUND,
            .accuracy.tolerance = pick_tolerance(&random, i, 1e-9, 1e-2),
            .accuracy.floor = test_uniform(&random) < 0.3 ? pick_power(&random, 1e-4, 1) : 0,
            .accuracy.no_self_check = true,
            .limits.constraints = {.engine = pick_engine(i, "torus_direct"), .precision = -1}};
        ps_power_job *const lean = run_power(&question, false);
        ps_power_job *const full = run_power(&question, true);
        skipped += lean->needs.num_skips - full->needs.num_skips;
        compare_spectra(lean, full);
        ps_power_job_destroy(lean);
        ps_power_job_destroy(full);
    }
    assert_true(skipped > JOBS); /* else there is nothing to compare */
}

static void sphere(void **state) {
    static const char *const samplers[] = {"white-sphere", "fibonacci", "spiral",
                                           "white-hemisphere", "fibonacci-hemisphere"};
    enum { JOBS = 8 };
    uint64_t random = 42;
    size_t skipped = 0;
    (void)state;
    for (size_t i = 0; i < JOBS; i++) {
        ps_sampler_request request;
        const bool of_pairs = i % 2 == 1;
        sample(&request, samplers[pick(&random, 5)], test_uniform(&random) < 0.5 ? 30 : 77, 0,
               i + 1, test_uniform(&random) < 0.3);
        ps_power_question question = {
            .on_sphere = true,
            .on_hemisphere = test_uniform(&random) < 0.3,
            .wants_pair_sums = of_pairs,
            .sampler = &request,
            .num_realizations = test_uniform(&random) < 0.3 ? 1 : 6,
            .max_degree = test_uniform(&random) < 0.5 ? 7 : 24,
            .normalization = of_pairs ? PSPEC_NORMALIZATION_PAIRS : PSPEC_NORMALIZATION_POWER,
            .accuracy.tolerance = pick_tolerance(&random, i, 1e-9, 1e-2),
            .accuracy.no_self_check = true,
            .limits.constraints = {.engine = pick_engine(i, "sphere_direct"), .precision = -1}};
        ps_power_job *const lean = run_power(&question, false);
        ps_power_job *const full = run_power(&question, true);
        skipped += lean->needs.num_skips - full->needs.num_skips;
        compare_spectra(lean, full);
        ps_power_job_destroy(lean);
        ps_power_job_destroy(full);
    }
    assert_true(skipped > JOBS / 2);
}

/* A target that is reached ends a job sooner: both answers are that far from each other, six
 * standard errors. */
static void statistics(void **state) {
    const double six = 6;
    ps_sampler_request request;
    (void)state;
    sample(&request, "jittered", 64, 2, 3, false);
    ps_power_question question = {
        .sampler = &request,
        .num_realizations = 3000,
        .frequencies.max_frequency = 12,
        .accuracy.tolerance = 1e-6,
        .accuracy.floor = 0.05,
        .may_loosen = true,
        .accuracy.standard_error = 0.05,
        .limits.constraints = {.engine = "torus_direct", .precision = -1}};
    ps_power_job *const lean = run_power(&question, false);
    ps_power_job *const full = run_power(&question, true);
    const ps_spectrum *const x = &lean->spectrum;
    const ps_spectrum *const y = &full->spectrum;
    assert_true(lean->problem.tolerance > full->problem.tolerance);
    assert_true(3 * x->num_realizations < y->num_realizations);
    assert_int_equal(y->num_realizations, 3000);
    for (size_t i = 0; i < x->num_bins; i++) {
        const double error = hypot(x->bins[i].standard_error, y->bins[i].standard_error);
        assert_true(fabs(x->bins[i].power - y->bins[i].power) <= six * error);
    }
    ps_power_job_destroy(lean);
    ps_power_job_destroy(full);
}

/* ---- quadrature ------------------------------------------------------------------------------ */

static ps_quadrature_job *run_rule(ps_quadrature_question *question, bool no_skip) {
    ps_quadrature_job *job = NULL;
    question->accuracy.no_skip = no_skip;
    assert_ok(ps_quadrature_job_create(&job, question, error));
    assert_ok(ps_quadrature_job_run(job, error));
    return job;
}

/* E^2 is the kernel form in both; e_l^2 are compared in units of c, as the tolerance is meant, and
 * what the degrees that were left out are together is within it. */
static void compare_rules(const ps_quadrature_job *lean_job, const ps_quadrature_job *full_job,
                          double tolerance) {
    const ps_quadrature_result *const lean = &lean_job->result;
    const ps_quadrature_result *const full = &full_job->result;
    const size_t last = lean_job->setup.max_degree;
    const size_t all = full_job->setup.max_degree;
    const double most =
        tolerance * lean_job->setup.representer.constant * full->weight_size * full->weight_size;
    double differ = 0;
    double beyond = 0;
    assert_true(last <= all);
    for (size_t l = 0; l <= all; l++) {
        const ps_mean e2 = full->degrees[l].e2;
        if (l <= last) {
            differ += fabs(lean->degrees[l].e2.mean - e2.mean);
        } else {
            beyond += e2.mean;
        }
    }
    assert_true(differ <= 2 * most);
    assert_true(beyond <= most * (1 + tolerance) || last == all);
    assert_true(fabs(lean->squared.mean - full->squared.mean) <=
                lean->numerical_bound + full->numerical_bound);
}

static void quadrature(void **state) {
    static const char *const lobes[] = {"diffuse", "glossy:n=3", "glossy:n=30", "phong:n=2",
                                        "phong:n=3"};
    static const char *const samplers[] = {"white-hemisphere", "fibonacci-hemisphere",
                                           "jittered:lift=hemisphere"};
    enum { JOBS = 12 };
    uint64_t random = 43;
    size_t fewer_degrees = 0;
    size_t fewer_sets = 0;
    ps_device *const device = test_open_device();
    (void)state;
    for (size_t i = 0; i < JOBS; i++) {
        ps_sampler_request request;
        ps_brdf *brdf = NULL;
        assert_ok(ps_brdf_parse(&brdf, lobes[pick(&random, 5)], error));
        const size_t side = test_uniform(&random) < 0.5 ? 5 : 9;
        sample(&request, samplers[pick(&random, 3)], side * side, 0, i + 1, false);
        request.morph = ps_brdf_morph(brdf);
        ps_quadrature_question question = {
            .brdf = brdf,
            .smoothness = 1.2 + 0.7 * test_uniform(&random),
            .sampler = &request,
            .num_realizations = test_uniform(&random) < 0.3 ? 1 : 6,
            .weights.kind = test_uniform(&random) < 0.3 ? PS_WEIGHTS_OPTIMAL : PS_WEIGHTS_EQUAL,
            .max_degree = test_uniform(&random) < 0.6 ? 0 : 20,
            .accuracy.tolerance = i % 2 == 0 ? 1e-2 : pick_tolerance(&random, i, 1e-10, 1e-2),
            .open_device = device,
            .limits.constraints = {.engine = pick_engine(i, "sphere_direct"), .precision = -1}};
        ps_quadrature_job *const lean = run_rule(&question, false);
        ps_quadrature_job *const full = run_rule(&question, true);
        compare_rules(lean, full, question.accuracy.tolerance);
        assert_int_equal(full->result.num_realizations, question.num_realizations);
        fewer_degrees += lean->setup.max_degree < full->setup.max_degree;
        fewer_sets += lean->result.num_realizations < full->result.num_realizations;
        ps_quadrature_job_destroy(lean);
        ps_quadrature_job_destroy(full);
        ps_brdf_destroy(brdf);
    }
    ps_device_close(device);
    assert_true(fewer_degrees > 0 && fewer_sets > 0);
}

/* ---- standard errors of single frequencies --------------------------------------------------- */

/* Without those of frequencies everything else has the same bits, in one dimension, where rings are
 * frequencies, too. */
static void check_bins_only(const ps_frequencies *set, const ps_engine *engine,
                            ps_precision precision, ps_device *device) {
    test_sample what = test_make_sample(23, set->dimension, 40, 3, true);
    ps_estimator_options options = test_make_options(set, engine, precision, 200, 7);
    ps_spectrum with = test_estimate(&options, &what, 23, device);
    options.no_frequency_errors = true;
    ps_spectrum without = test_estimate(&options, &what, 23, device);
    assert_int_equal(with.num_bins, without.num_bins);
    for (size_t b = 0; b < with.num_bins; b++) {
        const ps_spectrum_bin *const x = &with.bins[b];
        const ps_spectrum_bin *const y = &without.bins[b];
        assert_true(x->power == y->power && x->standard_error == y->standard_error);
        assert_true(isnan(x->anisotropy_db) ? isnan(y->anisotropy_db)
                                            : x->anisotropy_db == y->anisotropy_db);
    }
    for (size_t i = 0; i < set->num; i++) {
        assert_true(with.powers[i].mean == without.powers[i].mean);
        assert_true(set->dimension == 1 || isnan(without.powers[i].standard_error));
    }
    ps_spectrum_free(&with);
    ps_spectrum_free(&without);
    test_free_sample(&what);
}

static void same_bins_without_errors_of_frequencies(void **state) {
    ps_device *const device = test_open_device();
    (void)state;
    for (unsigned dimension = 1; dimension <= 2; dimension++) {
        ps_frequencies grid = test_make_lattice(dimension, 9, false);
        check_bins_only(&grid, &ps_torus_direct, PS_SINGLE, device);
        check_bins_only(&grid, &ps_host_direct, PS_EXTENDED, device);
        ps_frequencies_free(&grid);
    }
    ps_device_close(device);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torus),
        cmocka_unit_test(sphere),
        cmocka_unit_test(statistics),
        cmocka_unit_test(quadrature),
        cmocka_unit_test(same_bins_without_errors_of_frequencies),
    };
    ps_device_close(test_open_device()); /* skips where there is none */
    return cmocka_run_group_tests_name("needs_jobs", tests, NULL, NULL);
}
