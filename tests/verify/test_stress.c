/* The stability suite as a table: every heading of docs/mathematics/numerics.md has a case, every
 * engine is tried, and what goes wrong becomes a verdict. That broken kernels fail by name:
 * cli_stress_broken.sh.
 */
#include "harness.h"

#include "engines/host/host_direct.h"
#include "verify/stress.h"
#include "verify/stress_sample.h"
#include "verify/stress_shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the table ----------------------------------------------------------------------------- */

static size_t count_section(const char *section) {
    size_t num = 0;
    for (const ps_stress_case *what = ps_stress_cases; what->name != NULL; what++) {
        num += strcmp(what->section, section) == 0 ? 1 : 0;
    }
    return num;
}

static void every_section_has_a_case(void **state) {
    (void)state;
    static const char *const sections[] = {
        "phases",          "sums",           "legendre-sums",
        "tiny-power",      "high-order",     "special-functions",
        "kernel-diagonal", "special-points", "precision-reached"};
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        assert_true(count_section(sections[i]) > 0);
    }
}

static void check_rows(const ps_stress_case *cases, bool have_realizations) {
    size_t num_quick = 0;
    for (const ps_stress_case *what = cases; what->name != NULL; what++) {
        const bool on_torus = what->kind == PS_STRESS_TORUS;
        assert_null(strpbrk(what->name, " ,\"#"));
        assert_true(strlen(what->summary) > 0);
        assert_int_equal(what->num_realizations > 0, have_realizations);
        num_quick += what->is_quick;
        for (const ps_stress_case *other = cases; other != what; other++) {
            assert_string_not_equal(other->name, what->name);
        }
        if (what->kind == PS_STRESS_PROBE) {
            assert_non_null(what->probe->measure);
            continue;
        }
        assert_true(what->num_points > 0 && what->reach > 0);
        assert_true(on_torus == (what->dimension > 0));
        assert_non_null(
            ps_stress_shape_find(on_torus ? ps_torus_shapes : ps_vector_shapes, what->shape));
    }
    assert_true(num_quick > 0);
}

static void rows_make_sense(void **state) {
    (void)state;
    check_rows(ps_stress_cases, false);
    check_rows(ps_bench_cases, true);
}

static void every_engine_is_tried(void **state) {
    (void)state;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
            const ps_suite_options options = {.engine = (*engine)->name, .precision = precision};
            if ((*engine)->needs_device && (*engine)->has_precision[precision]) {
                assert_ok(ps_suite_check(&ps_stress_suite, &options, error));
                assert_true(ps_stress_needs_device(&options));
            }
        }
    }
}

static void check_refused(const ps_suite_options *options, const char *part) {
    ps_error error = {0};
    assert_int_equal(ps_suite_check(&ps_stress_suite, options, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, part));
}

static void names_that_are_wrong(void **state) {
    (void)state;
    check_refused(&(ps_suite_options){.case_name = "pole", .precision = -1}, "nearest is poles");
    check_refused(&(ps_suite_options){.engine = "hast", .precision = -1}, "nearest is host");
    check_refused(&(ps_suite_options){.engine = "host", .precision = PS_EXTENDED}, "no case");
}

/* ---- verdicts ------------------------------------------------------------------------------ */

typedef struct seen {
    size_t num_rows, stop_after;
    bool all_passed;
} seen;

static pspec_status look(void *payload, const ps_stress_row *row, ps_error *error) {
    seen *self = payload;
    (void)error;
    self->num_rows++;
    self->all_passed = self->all_passed && row->verdict == PS_STRESS_PASS &&
                       row->error <= row->bound && row->reason[0] == '\0';
    return PSPEC_OK;
}

static bool is_enough(void *payload) {
    const seen *self = payload;
    return self->num_rows >= self->stop_after;
}

static void host_needs_no_device(void **state) {
    (void)state;
    seen what = {.stop_after = SIZE_MAX, .all_passed = true};
    ps_stress_totals totals;
    const ps_suite_options options = {.engine = "host",
                                      .precision = -1,
                                      .should_stop = is_enough,
                                      .report = look,
                                      .payload = &what};
    assert_false(ps_stress_needs_device(&options));
    assert_ok(ps_stress_run(&options, NULL, &totals, error));
    assert_true(what.all_passed && what.num_rows >= 5);
    assert_int_equal(totals.num_passed, what.num_rows);
    assert_int_equal(totals.num_failed + totals.num_skipped, 0);
}

static void stops_between_cases(void **state) {
    (void)state;
    ps_error failure = {0};
    seen what = {.stop_after = 2, .all_passed = true};
    ps_stress_totals totals;
    const ps_suite_options options = {.engine = "host",
                                      .precision = -1,
                                      .should_stop = is_enough,
                                      .report = look,
                                      .payload = &what};
    assert_int_equal(ps_stress_run(&options, NULL, &totals, &failure), PSPEC_ERROR_CANCELLED);
    assert_int_equal(what.num_rows, 2);
}

static void verdicts_in_words(void **state) {
    (void)state;
    char text[300];
    ps_stress_row row = {.verdict = PS_STRESS_FAIL};
    ps_stress_verdict_text(&row, text, sizeof text);
    assert_string_equal(text, "fail");
    row = (ps_stress_row){.verdict = PS_STRESS_SKIPPED, .reason = "no double precision"};
    ps_stress_verdict_text(&row, text, sizeof text);
    assert_string_equal(text, "skipped: no double precision");
}

/* ---- the truth ----------------------------------------------------------------------------- */

static ps_stress_sample make_sample(const ps_stress_case *what) {
    ps_stress_sample sample;
    assert_ok(ps_stress_sample_create(&sample, what, error));
    assert_ok(ps_stress_sample_judge(&sample, NULL, NULL, error));
    return sample;
}

/* N points in one place: |S| = N everywhere, in threads and out of them. */
static void truth_on_the_torus(void **state) {
    (void)state;
    const ps_stress_case what = {
        .name = "t", .shape = "one place", .num_points = 37, .dimension = 2, .reach = 5};
    ps_stress_sample sample = make_sample(&what);
    assert_int_equal(sample.num_checked, sample.frequencies.num);
    for (size_t i = 0; i < sample.num_checked; i++) {
        assert_true(fabsl(sample.truth[i] - 37) < 1e-15L * 37);
    }
    assert_true(fabs(sample.mean_power - 37) < 1e-12);
    ps_stress_sample_free(&sample);
}

/* The two referees of the sphere share no step: sums over pairs, and coefficients. */
static void referees_agree(void **state) {
    (void)state;
    static const char *const shapes[] = {"white",       "wildest weights", "polar circle",
                                         "icosahedron", "within 1e-5",     "antipodes"};
    for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
        ps_stress_case what = {.name = "t",
                               .kind = PS_STRESS_PAIRS,
                               .shape = shapes[s],
                               .num_points = 30,
                               .reach = 90};
        ps_stress_sample pairs = make_sample(&what);
        what.kind = PS_STRESS_SPHERE;
        what.num_checked = 7;
        ps_stress_sample sphere = make_sample(&what);
        const long double size = pairs.sums.weight_size_sum * pairs.sums.weight_size_sum;
        assert_int_equal(sphere.num_checked, 7);
        assert_int_equal(sphere.checked[6], 89); /* the last one is among them */
        for (size_t i = 0; i < 7; i++) {
            const long double root = sphere.truth[i];
            assert_true(fabsl(root * root - pairs.truth[sphere.checked[i]]) < 1e-16L * size);
        }
        ps_stress_sample_free(&pairs);
        ps_stress_sample_free(&sphere);
    }
}

/* Sorted points, whose partial sums are a million times their sum: (1 + i k / N)-like sums in
 * closed form do not exist, but adding the points backwards must give the same. */
static void referee_is_compensated(void **state) {
    (void)state;
    enum { NUM = 200000 };
    pspec_pattern forward;
    const int32_t k = 1;
    long double sums[2][2];
    assert_ok(ps_stress_shape_make(ps_stress_shape_find(ps_torus_shapes, "sorted"), 1, NUM, 7,
                                   &forward, error));
    double *reversed = calloc(NUM, sizeof(double));
    for (size_t j = 0; j < NUM; j++) {
        reversed[j] = forward.points[NUM - 1 - j];
    }
    const pspec_pattern backward = {1, NUM, reversed, NULL};
    ps_host_sum(&forward, &k, &sums[0][0], &sums[0][1]);
    ps_host_sum(&backward, &k, &sums[1][0], &sums[1][1]);
    for (int part = 0; part < 2; part++) {
        assert_true(fabsl(sums[0][part] - sums[1][part]) < 1e-19L);
    }
    free(reversed);
    ps_stress_pattern_free(&forward);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_section_has_a_case), cmocka_unit_test(rows_make_sense),
        cmocka_unit_test(every_engine_is_tried),    cmocka_unit_test(names_that_are_wrong),
        cmocka_unit_test(host_needs_no_device),     cmocka_unit_test(stops_between_cases),
        cmocka_unit_test(verdicts_in_words),        cmocka_unit_test(truth_on_the_torus),
        cmocka_unit_test(referees_agree),           cmocka_unit_test(referee_is_compensated),
    };
    return cmocka_run_group_tests_name("stress", tests, NULL, NULL);
}
