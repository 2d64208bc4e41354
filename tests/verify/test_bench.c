/* pointspec bench as a function: what is chosen, rows of a case, the Pareto front, calibration. */
#include "harness.h"

#include "verify/bench/bench.h"

#include <math.h>
#include <string.h>

static ps_device *device;

/* Not what the device has: fractions are of it, and the test knows it. */
static const double copied_bytes = 1e10;

/* ---- the table ----------------------------------------------------------------------------- */

static void check_refused(const ps_suite_options *options, const char *part) {
    ps_error said = {0};
    assert_int_equal(ps_suite_check(&ps_bench_suite, options, &said), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, part));
}

static void names_that_are_wrong(void **state) {
    (void)state;
    check_refused(&(ps_suite_options){.case_name = "spher", .precision = -1}, "nearest is sphere");
    check_refused(&(ps_suite_options){.engine = "torus_direkt", .precision = -1},
                  "nearest is torus_direct");
    check_refused(&(ps_suite_options){.engine = "torus_direct", .precision = PS_EXTENDED},
                  "no case is left");
    check_refused(
        &(ps_suite_options){.case_name = "sphere", .engine = "pairs_direct", .precision = -1},
        "no case is left");
    assert_ok(ps_suite_check(
        &ps_bench_suite,
        &(ps_suite_options){.case_name = "pairs", .engine = "pairs_direct", .precision = -1},
        error));
}

/* ---- the front ----------------------------------------------------------------------------- */

static void front_of_known_rows(void **state) {
    (void)state;
    const ps_stress_case *const a = &ps_bench_cases[0];
    const ps_stress_case *const b = &ps_bench_cases[1];
    const struct {
        const ps_stress_case *what;
        double seconds, error;
        bool is_pareto;
    } known[] = {
        {a, 1, 1e-2, true},  {a, 2, 1e-4, true}, {a, 2, 1e-3, false}, /* as fast, less exact */
        {a, 3, 1e-4, false},                                          /* as exact, slower */
        {a, 4, 1e-6, true},  {a, 4, 1e-6, true},                      /* equals stay both */
        {a, 9, 0, true},     {b, 9, 1e-1, true},                      /* of another case */
    };
    enum { NUM = sizeof known / sizeof known[0] };
    ps_bench_row rows[NUM];
    for (size_t i = 0; i < NUM; i++) {
        rows[i] = (ps_bench_row){
            .what = known[i].what, .seconds = known[i].seconds, .error = known[i].error};
    }
    ps_bench_mark_pareto(rows, NUM);
    for (size_t i = 0; i < NUM; i++) {
        assert_int_equal(rows[i].is_pareto, known[i].is_pareto);
    }
}

/* ---- rows ---------------------------------------------------------------------------------- */

enum { MOST_ROWS = 64 };

typedef struct collection {
    size_t num, num_reports;
    ps_bench_row rows[MOST_ROWS];
    bool stops;
} collection;

static pspec_status collect(void *payload, const ps_bench_row *rows, size_t num, ps_error *error) {
    collection *const collected = payload;
    (void)error;
    assert_true(num <= MOST_ROWS);
    memcpy(collected->rows, rows, num * sizeof *rows);
    collected->num = num;
    collected->num_reports++;
    return PSPEC_OK;
}

static bool ask_to_stop(void *payload) {
    const collection *const collected = payload;
    return collected->stops;
}

static ps_suite_options quick_options(const char *name, collection *collected) {
    return (ps_suite_options){.case_name = name,
                              .precision = -1,
                              .quick = true,
                              .should_stop = ask_to_stop,
                              .report_rows = collect,
                              .payload = collected};
}

static size_t count_rows(const collection *collected, const char *engine, ps_precision precision) {
    size_t num = 0;
    for (size_t i = 0; i < collected->num; i++) {
        num += strcmp(collected->rows[i].engine->name, engine) == 0 &&
                       collected->rows[i].precision == precision
                   ? 1
                   : 0;
    }
    return num;
}

static bool is_beaten(const collection *collected, const ps_bench_row *row) {
    for (size_t i = 0; i < collected->num; i++) {
        const ps_bench_row *by = &collected->rows[i];
        if ((by->seconds < row->seconds && by->error <= row->error) ||
            (by->seconds <= row->seconds && by->error < row->error)) {
            return true;
        }
    }
    return false;
}

static void check_row(const collection *collected, const ps_bench_row *row) {
    const double bytes = row->precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    const double least = 256 * 2 * sizeof(double) + 32 * 66 * bytes; /* points, half lattice */
    assert_string_equal(row->what->name, "plane-many");
    assert_true(isfinite(row->seconds) && row->seconds > 0);
    assert_true(isfinite(row->predicted_seconds) && row->predicted_seconds > 0);
    assert_true(row->error >= 0 && row->error <= row->tolerance); /* the contract */
    assert_true(row->predicted_error > 0 && row->predicted_error <= row->tolerance);
    assert_int_equal(row->is_pareto, !is_beaten(collected, row));
    if (!row->engine->needs_device) {
        assert_true(isnan(row->fraction_of_peak) && isnan(row->fraction_of_bandwidth));
        return;
    }
    assert_true(row->fraction_of_peak > 0 && isfinite(row->fraction_of_peak));
    const double expected = least / row->seconds / copied_bytes;
    assert_true(fabs(row->fraction_of_bandwidth / expected - 1) < 1e-12);
}

static void rows_of_a_case(void **state) {
    (void)state;
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    collection collected = {0};
    const ps_suite_options options = quick_options("plane-many", &collected);
    assert_ok(ps_bench_run(&options, device, copied_bytes, error));
    assert_int_equal(collected.num_reports, 1);
    for (size_t i = 0; i < collected.num; i++) {
        check_row(&collected, &collected.rows[i]);
    }
    /* as exactly as they are asked to, or always as exactly: one row then */
    assert_true(count_rows(&collected, "torus_nufft", PS_SINGLE) >= 3);
    assert_int_equal(count_rows(&collected, "torus_direct", PS_SINGLE), 1);
    assert_int_equal(count_rows(&collected, "torus_direct", PS_DOUBLE), has_fp64 ? 1 : 0);
    assert_int_equal(count_rows(&collected, "torus_nufft", PS_DOUBLE), has_fp64 ? 6 : 0);
}

static void choice_of_rows(void **state) {
    (void)state;
    collection collected = {0};
    ps_suite_options options = quick_options("pairs", &collected);
    options.engine = "pairs_direct";
    options.precision = PS_SINGLE;
    assert_ok(ps_bench_run(&options, device, copied_bytes, error));
    assert_int_equal(collected.num, 1);
    assert_int_equal(count_rows(&collected, "pairs_direct", PS_SINGLE), 1);
    assert_true(collected.rows[0].error <= collected.rows[0].tolerance &&
                collected.rows[0].is_pareto);
}

static void stops_when_asked(void **state) {
    (void)state;
    collection collected = {.stops = true};
    const ps_suite_options options = quick_options("plane-many", &collected);
    ps_error said = {0};
    assert_int_equal(ps_bench_run(&options, device, copied_bytes, &said), PSPEC_ERROR_CANCELLED);
    assert_int_equal(collected.num_reports, 0);
}

/* ---- calibration --------------------------------------------------------------------------- */

/* Factors of all engines that the case has, against the built-in model whatever figures the device
 * has by then. */
static void calibration(void **state) {
    (void)state;
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    collection collected = {0};
    const ps_suite_options options = quick_options("list", &collected);
    ps_figures figures;
    ps_figures absurd = {.is_measured = true};
    ps_figures_row(&absurd, "torus_direct")->scales[PS_SINGLE] = 1e3;
    assert_ok(ps_device_set_figures(device, &absurd, error));
    assert_ok(ps_bench_calibrate(&options, device, &figures, error));
    assert_true(figures.is_measured && figures.copied_bytes > 0 && figures.flops[PS_SINGLE] > 0);
    assert_true(figures.sent_bytes > 0 && figures.launches > 0);
    assert_true(has_fp64 == (figures.flops[PS_DOUBLE] > 0));
    const ps_engine_figure *const row = ps_figures_row(&figures, "torus_direct");
    assert_int_equal(figures.num_engines,
                     1); /* no other one takes lists, but the referee, who takes too long */
    assert_true(row->scales[PS_SINGLE] > 0.02 && row->scales[PS_SINGLE] < 1e3);
    assert_true(has_fp64 == (row->scales[PS_DOUBLE] > 0) && row->scales[PS_EXTENDED] == 0);
}

static int open_device(void **state) {
    (void)state;
    device = test_open_device();
    return 0;
}

static int close_device(void **state) {
    (void)state;
    ps_device_close(device);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_that_are_wrong), cmocka_unit_test(front_of_known_rows),
        cmocka_unit_test(rows_of_a_case),       cmocka_unit_test(choice_of_rows),
        cmocka_unit_test(stops_when_asked),     cmocka_unit_test(calibration),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
