/* Jobs that are cancelled and go on from their checkpoint, wherever that is, end with the bits of
 * those that nobody cancelled. */
#include "harness.h"
#include "test_folder.h"

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/spectrum/power_job.h"

#include <stdlib.h>
#include <string.h>

static ps_device *device; /* of all jobs: kernels are built once */

/* ---- who cancels --------------------------------------------------------------------------- */

typedef struct canceller {
    int left; /* calls before it cancels; negative: never */
} canceller;

static int tell(const ps_watch_report *report, void *payload) {
    canceller *const self = payload;
    (void)report;
    return self->left >= 0 && self->left-- == 0;
}

/* ---- spectra ------------------------------------------------------------------------------- */

static pspec_status weigh(void *payload, const ps_frequencies *frequencies, double *weights,
                          ps_error *error) {
    (void)payload;
    (void)error;
    for (size_t i = 0; i < 2 * frequencies->num; i++) {
        weights[i] = 1.0 / (double)(i + 1);
    }
    return PSPEC_OK;
}

static void assert_same_means(const ps_mean *a, const ps_mean *b, size_t num) {
    for (size_t i = 0; i < num; i++) {
        assert_memory_equal(&a[i], &b[i], sizeof a[i]);
    }
}

static void assert_same_spectra(const ps_power_job *a, const ps_power_job *b) {
    const size_t num = a->spectrum.frequencies.num;
    assert_int_equal(a->spectrum.num_bins, b->spectrum.num_bins);
    assert_int_equal(a->spectrum.num_realizations, b->spectrum.num_realizations);
    for (size_t i = 0; i < a->spectrum.num_bins; i++) {
        const ps_spectrum_bin *const bin = &a->spectrum.bins[i];
        assert_memory_equal(&bin->power, &b->spectrum.bins[i].power, sizeof bin->power);
        assert_memory_equal(&bin->standard_error, &b->spectrum.bins[i].standard_error,
                            sizeof bin->standard_error);
    }
    assert_true((a->spectrum.powers == NULL) == (b->spectrum.powers == NULL));
    assert_same_means(a->spectrum.powers, b->spectrum.powers, a->spectrum.powers != NULL ? num : 0);
    assert_same_means(a->c2, b->c2, a->c2 != NULL ? num : 0);
    assert_same_means(a->weighted, b->weighted, a->question->num_weighted);
    const ps_accuracy *const x = &a->runner.accuracy;
    const ps_accuracy *const y = &b->runner.accuracy;
    assert_true(x->error == y->error && x->length_error == y->length_error);
    assert_true(x->largest_share == y->largest_share && x->self_check == y->self_check);
    assert_true(x->largest_mean_power == y->largest_mean_power);
    assert_true(x->largest_points == y->largest_points && x->was_checked == y->was_checked);
    assert_int_equal(a->runner.num_replans, b->runner.num_replans);
    assert_int_equal(a->sets.first.num_points, b->sets.first.num_points);
}

/* Runs it to the end, cancelled after so many calls each time; returns how often that was. */
static int run_in_pieces(ps_power_job **out, ps_power_question *question, canceller *who,
                         int calls) {
    int num = 0;
    pspec_status status = PSPEC_ERROR_CANCELLED;
    while (status == PSPEC_ERROR_CANCELLED) {
        ps_error error = {0};
        who->left = -1;
        assert_ok(ps_power_job_create(out, question, error));
        who->left = calls + num * num * num; /* further each time, or it would never end */
        status = ps_power_job_run(*out, &error);
        if (status == PSPEC_ERROR_CANCELLED) {
            ps_power_job_destroy(*out);
            num++;
        } else if (status != PSPEC_OK) {
            fail_msg("%s", error.message);
        }
    }
    return num;
}

static void compare(const test_folder *folder, ps_power_question *question) {
    char path[TEST_PATH_BYTES];
    canceller who = {-1};
    ps_power_job *whole = NULL;
    int num = 0;
    question->watch = (ps_watch){tell, &who};
    question->open_device = device;
    assert_ok(ps_power_job_create(&whole, question, error));
    assert_ok(ps_power_job_run(whole, error));
    question->limits.checkpoint = (ps_checkpoint_spec){
        .path = test_path(folder, "job.npz", path), .key = "the same\n", .interval = 0};
    for (int calls = 1; calls < 12; calls += 7) {
        ps_power_job *pieces = NULL;
        num += run_in_pieces(&pieces, question, &who, calls);
        assert_same_spectra(whole, pieces);
        ps_power_job_destroy(pieces);
        ps_checkpoint_remove(path, 0, 1);
    }
    assert_true(num > 1);
    question->limits.checkpoint.path = NULL;
    ps_power_job_destroy(whole);
}

static ps_sampler_request parse(const char *text, size_t num_points, unsigned dimension) {
    ps_sampler_request request = {.num_points = num_points, .dimension = dimension, .seed = 5};
    assert_ok(ps_sampler_parse(&request, text, error));
    return request;
}

typedef struct power_case {
    const char *sampler, *engine;
    int precision; /* -1: auto */
    unsigned dimension;
    size_t points;
    uint64_t realizations;
    int32_t last; /* K or L */
    bool is_pairs, wants_full, is_weighted, keeps_first;
    double standard_error;
    ps_realization_range range;
} power_case;

static const power_case power_cases[] = {
    {"jittered", "torus_nufft", PS_SINGLE, 2, 256, 3000, 16, false, true, false, true, 0, {0, 0}},
    {"white", "torus_nufft", PS_DOUBLE, 2, 100, 3000, 12, false, false, true, false, 0, {0, 0}},
    {"white", "torus_direct", PS_SINGLE, 1, 64, 3000, 32, false, false, false, false, 0, {0, 0}},
    {"latin-hypercube",
     "torus_direct",
     PS_DOUBLE,
     3,
     27,
     2000,
     3,
     false,
     true,
     true,
     false,
     0,
     {0, 0}},
    {"poisson-disk", NULL, -1, 2, 60, 140, 8, false, true, false, true, 0, {0, 0}},
    {"white", "host_direct", -1, 2, 16, 260, 4, false, true, true, false, 0, {0, 0}},
    {"jittered", NULL, -1, 2, 64, 20000, 16, false, false, false, false, 0.05, {0, 0}},
    {"white-sphere",
     "sphere_nufft",
     PS_SINGLE,
     3,
     200,
     1500,
     24,
     false,
     false,
     false,
     true,
     0,
     {0, 0}},
    {"white-sphere",
     "sphere_direct",
     PS_DOUBLE,
     3,
     30,
     1500,
     8,
     false,
     false,
     false,
     false,
     0,
     {0, 0}},
    {"white-sphere", NULL, -1, 3, 24, 1500, 6, true, false, false, false, 0, {0, 0}},
    {"white", "torus_nufft", PS_SINGLE, 2, 64, 5000, 12, false, true, false, false, 0, {384, 4992}},
    {"white-sphere", NULL, -1, 3, 24, 1500, 6, true, false, false, false, 0, {128, 1500}},
};

static void spectra_go_on(void **state) {
    for (size_t i = 0; i < sizeof power_cases / sizeof power_cases[0]; i++) {
        const power_case *const own = &power_cases[i];
        const bool on_sphere = strstr(own->sampler, "sphere") != NULL;
        ps_sampler_request request = parse(own->sampler, own->points, own->dimension);
        ps_power_question question = {
            .sampler = &request,
            .num_realizations = own->realizations,
            .range = own->range,
            .on_sphere = on_sphere,
            .wants_pair_sums = own->is_pairs,
            .max_degree = on_sphere ? own->last : 0,
            .frequencies.max_frequency = on_sphere ? 0 : own->last,
            .has_rings_of_box = !on_sphere,
            .wants_full_array = own->wants_full,
            .keeps_first = own->keeps_first,
            .num_weighted = own->is_weighted ? 2 : 0,
            .weigh = weigh,
            .normalization = own->is_pairs ? PSPEC_NORMALIZATION_PAIRS : PSPEC_NORMALIZATION_POWER,
            .accuracy = {.tolerance = 1e-5, .standard_error = own->standard_error},
            .limits.constraints = {.engine = own->engine, .precision = own->precision}};
        compare(*state, &question);
    }
}

/* Files of several sets, with weights, some in blocks; what is found out of all sets is there. */
static void files_go_on(void **state) {
    enum { SETS = 6, POINTS = 3000 };
    char names[SETS][TEST_PATH_BYTES];
    const char *paths[SETS];
    static double points[POINTS * 3];
    uint64_t random = 3;
    for (size_t i = 0; i < SETS; i++) {
        const size_t num = POINTS - 100 * i;
        char name[16];
        char shape[32];
        for (size_t j = 0; j < 3 * num; j++) {
            points[j] = test_uniform(&random);
        }
        snprintf(name, sizeof name, "%zu.npy", i);
        snprintf(shape, sizeof shape, "(%zu, 3)", num);
        paths[i] = test_path(*state, name, names[i]);
        assert_true(
            test_write_array(paths[i], "<f8", "False", shape, points, 3 * num * sizeof *points));
    }
    ps_power_question question = {.paths = paths,
                                  .num_paths = SETS,
                                  .point_options = {.columns = "xyw"},
                                  .frequencies.max_frequency = 12,
                                  .has_rings_of_box = true,
                                  .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                                  .accuracy = {.tolerance = 1e-6},
                                  .limits.constraints = {.engine = "host_direct", .precision = -1}};
    compare(*state, &question);
    question.whole_bytes = 1; /* they come in blocks of a thousand points */
    compare(*state, &question);
    question.limits.constraints.engine = "torus_nufft";
    compare(*state, &question);
}

/* Cancelled before and after the second plan. */
static void second_plans_go_on(void **state) {
    enum { SETS = 4, SIDE = 64 };
    char list[TEST_PATH_BYTES];
    char names[SETS][TEST_PATH_BYTES];
    const char *paths[SETS];
    static double points[SIDE * SIDE * 2];
    for (size_t i = 0; i < SETS; i++) {
        char name[16];
        for (size_t j = 0; j < (size_t)SIDE * SIDE; j++) {
            points[2 * j] = ((double)(j / SIDE) + 0.1 * (double)i) / SIDE;
            points[2 * j + 1] = (double)(j % SIDE) / SIDE;
        }
        snprintf(name, sizeof name, "g%zu.npy", i);
        paths[i] = test_path(*state, name, names[i]);
        assert_true(test_write_array(paths[i], "<f8", "False", "(4096, 2)", points, sizeof points));
    }
    FILE *const file = fopen(test_path(*state, "list.txt", list), "w");
    assert_non_null(file);
    for (int i = 0; i < 64; i++) {
        fprintf(file, "64 %d\n", i);
    }
    assert_int_equal(fclose(file), 0);
    ps_power_question question = {.paths = paths,
                                  .num_paths = SETS,
                                  .frequencies.path = list,
                                  .accuracy = {.tolerance = 1e-6},
                                  .limits.constraints = {.precision = -1}};
    ps_power_job *job = NULL;
    question.open_device = device;
    assert_ok(ps_power_job_create(&job, &question, error));
    assert_ok(ps_power_job_run(job, error));
    assert_int_equal(job->runner.num_replans, 1);
    ps_power_job_destroy(job);
    compare(*state, &question);
}

/* ---- rules --------------------------------------------------------------------------------- */

static void assert_same_rules(const ps_quadrature_job *a, const ps_quadrature_job *b) {
    const ps_quadrature_result *const x = &a->result;
    const ps_quadrature_result *const y = &b->result;
    assert_int_equal(x->num_realizations, y->num_realizations);
    assert_memory_equal(x->degrees, y->degrees, (a->setup.max_degree + 1) * sizeof *x->degrees);
    assert_same_means(&x->squared, &y->squared, 1);
    assert_same_means(&x->tail, &y->tail, 1);
    assert_same_means(&x->weight_sum, &y->weight_sum, 1);
    assert_true(x->tail_model == y->tail_model && x->tail_bound == y->tail_bound);
    assert_true(x->numerical_bound == y->numerical_bound && x->weight_size == y->weight_size);
    assert_int_equal(x->facts.num_points, y->facts.num_points);
    assert_true(x->facts.largest_condition == y->facts.largest_condition);
}

static void rules_go_on(void **state) {
    static const char *const engines[] = {"host_direct", "sphere_direct", "pairs_direct"};
    char path[TEST_PATH_BYTES];
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, "glossy:n=5", error));
    for (size_t i = 0; i < 2 * sizeof engines / sizeof engines[0]; i++) {
        ps_sampler_request request = parse("white-hemisphere", 12, 3);
        canceller who = {-1};
        int num = 0;
        ps_quadrature_question question = {
            .sampler = &request,
            .num_realizations = 90,
            .brdf = brdf,
            .smoothness = 1.5,
            .weights.kind = i % 2 == 0 ? PS_WEIGHTS_EQUAL : PS_WEIGHTS_OPTIMAL,
            .max_degree = 6,
            .accuracy = {.tolerance = 1e-8},
            .limits.constraints = {.engine = engines[i / 2], .precision = -1},
            .watch = {tell, &who}};
        ps_quadrature_job *whole = NULL;
        question.open_device = device;
        assert_ok(ps_quadrature_job_create(&whole, &question, error));
        assert_ok(ps_quadrature_job_run(whole, error));
        question.limits.checkpoint = (ps_checkpoint_spec){
            .path = test_path(*state, "job.npz", path), .key = "the same\n", .interval = 0};
        pspec_status status = PSPEC_ERROR_CANCELLED;
        while (status == PSPEC_ERROR_CANCELLED) {
            ps_quadrature_job *pieces = NULL;
            ps_error error = {0};
            who.left = -1;
            assert_ok(ps_quadrature_job_create(&pieces, &question, error));
            who.left = 3 + num * num * num;
            num++;
            status = ps_quadrature_job_run(pieces, &error);
            if (status == PSPEC_OK) {
                assert_same_rules(whole, pieces);
            }
            ps_quadrature_job_destroy(pieces);
        }
        assert_int_equal(status, PSPEC_OK);
        assert_true(num > 1);
        ps_checkpoint_remove(path, 0, 1);
        ps_quadrature_job_destroy(whole);
    }
    ps_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spectra_go_on),
        cmocka_unit_test(files_go_on),
        cmocka_unit_test(second_plans_go_on),
        cmocka_unit_test(rules_go_on),
    };
    device = test_open_device(); /* ends as skipped when there is none */
    const int failed =
        cmocka_run_group_tests_name("checkpoints", tests, test_folder_create, test_folder_remove);
    ps_device_close(device);
    return failed;
}
