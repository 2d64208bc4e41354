/* An integrand that a caller gives is measured as one of the table that has the same values, to the
 * bit, also where samplers are ranked and rates found; nothing is predicted of it. What the caller
 * cannot say is an error with its sentence. */
#include "harness_given.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

/* What the caller has: an integrand of the table, which it evaluates itself. */
typedef struct mine {
    ps_integrand *integrand;
    pthread_t thread;          /* the only one that may ask */
    size_t num_calls, failing; /* the call that fails, from 1; 0: none */
    double added;              /* to every value */
} mine;

static pspec_status give(void *payload, size_t num, unsigned dimension, const double *points,
                         double *values, ps_error *error) {
    mine *const self = payload;
    assert_true(pthread_equal(pthread_self(), self->thread));
    assert_int_equal(dimension, self->integrand->place.dimension);
    if (++self->num_calls == self->failing) {
        return ps_fail(error, PSPEC_ERROR_CANCELLED, "the caller has gone home");
    }
    ps_integrand_values(self->integrand, points, num, values);
    for (size_t i = 0; i < num; i++) {
        values[i] += self->added;
    }
    return PSPEC_OK;
}

static void make(mine *self, const char *text, ps_sampler_domain where, unsigned dimension) {
    *self = (mine){.thread = pthread_self()};
    assert_ok(
        ps_integrand_parse(&self->integrand, text, (ps_integrand_place){where, dimension}, error));
}

static pspec_status answer(ps_answer *out, mine *self, double integral, const char *format,
                           ps_error *error) {
    const ps_given_integrand one = {"mine", integral, give, self};
    test_question asked;
    test_ask(&asked, "variance engine=host_direct integrand=mine %s", format);
    asked.request.integrands_given = (ps_given_integrands){&one, 1};
    return ps_answer_make(out, asked.kind, &asked.request, &(ps_answer_hooks){0}, error);
}

/* ---- what is measured ------------------------------------------------------------------------ */

static double number(const ps_table *table, size_t row, const char *column) {
    size_t at = 0;
    assert_true(ps_table_find_column(table, column, &at));
    return ps_cell_number(ps_table_cell(table, row, at));
}

/* Rows of mine come before those of the other. */
static void compare_rows(const ps_table *table) {
    static const char *const predictions[] = {"predicted", "predicted_error", "lower",
                                              "upper",     "z_score",         "white"};
    static const char *const measurements[] = {"points", "measured", "measured_error"};
    const size_t num = ps_table_num_rows(table);
    assert_true(num > 0);
    for (size_t row = 0; row < num; row += 2) {
        for (size_t i = 0; i < sizeof predictions / sizeof predictions[0]; i++) {
            assert_true(isnan(number(table, row, predictions[i])));
            assert_true(isfinite(number(table, row + 1, predictions[i])));
        }
        for (size_t i = 0; i < sizeof measurements / sizeof measurements[0]; i++) {
            const double found = number(table, row, measurements[i]);
            assert_true(found > 0 && found == number(table, row + 1, measurements[i]));
        }
    }
}

/* The next entry of that name from *i on. */
static ps_cell next_entry(const ps_table *table, const char *name, size_t *i) {
    const char *key = NULL;
    ps_cell cell = PS_MISSING;
    for (bool is_it = false; !is_it; (*i)++) {
        assert_true(*i < ps_table_num_meta(table));
        cell = ps_table_meta(table, *i, &key);
        is_it = strcmp(key, name) == 0;
    }
    return cell;
}

static void check(const char *text, ps_sampler_domain where, unsigned dimension,
                  const char *format) {
    ps_answer out = {0};
    mine own;
    make(&own, text, where, dimension);
    assert_ok(answer(&out, &own, ps_integrand_integral(own.integrand), format, error));
    compare_rows(out.table);
    ps_answer_free(&out);
    ps_integrand_destroy(own.integrand);
}

static void the_table_measures_the_same(void **state) {
    (void)state;
    check("gaussian", PS_SAMPLES_TORUS, 2,
          "integrand=gaussian sampler=white sampler=jittered points=9,16 max-frequency=4 "
          "realizations=10 bounds=auto tail=1e-9");
    check("ball", PS_SAMPLES_TORUS, 3,
          "integrand=ball sampler=white dimension=3 points=700 max-frequency=2 realizations=3 "
          "shifts=2 bins=shells");
    check("cap", PS_SAMPLES_SPHERE, 3,
          "integrand=cap sampler=white-sphere points=20 max-degree=4 realizations=8");
    check("cap", PS_SAMPLES_HEMISPHERE, 3,
          "integrand=cap sampler=white-hemisphere points=20 max-degree=4 realizations=8");
}

/* By what was measured, where there is nothing else: jittered points are better than white ones. */
static void samplers_are_ranked(void **state) {
    ps_answer out = {0};
    mine own;
    size_t i = 0;
    (void)state;
    make(&own, "gaussian", PS_SAMPLES_TORUS, 2);
    assert_ok(answer(&out, &own, ps_integrand_integral(own.integrand),
                     "sampler=white sampler=jittered points=16,64 max-frequency=4 "
                     "realizations=200 rates=auto rank",
                     error));
    const char *const ranking = next_entry(out.table, "ranking", &i).text;
    assert_non_null(strstr(ranking, "jittered has the least variance; white has"));
    assert_non_null(strstr(ranking, "measured"));
    assert_null(strstr(ranking, "white noise"));
    i = 0;
    const double white = ps_cell_number(next_entry(out.table, "measured_rate", &i));
    const double jittered = ps_cell_number(next_entry(out.table, "measured_rate", &i));
    assert_true(fabs(white - 1) < 0.4 && jittered > white + 0.4);
    ps_answer_free(&out);
    ps_integrand_destroy(own.integrand);
}

/* ---- nonsense -------------------------------------------------------------------------------- */

static void refuses(mine *self, double integral, pspec_status status, const char *sentence) {
    ps_answer out = {0};
    ps_error error = {0};
    assert_int_equal(answer(&out, self, integral,
                            "sampler=white points=300 max-frequency=2 realizations=4", &error),
                     status);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", sentence, error.message);
    }
    ps_answer_free(&out);
}

static void nonsense_is_refused(void **state) {
    mine own;
    (void)state;
    make(&own, "gaussian", PS_SAMPLES_TORUS, 2);
    refuses(&own, NAN, PSPEC_ERROR_INVALID_ARGUMENT, "integrand mine: its integral is");
    own.failing = 2;
    refuses(&own, 1, PSPEC_ERROR_CANCELLED, "the caller has gone home");
    assert_int_equal(own.num_calls, 2); /* nobody asks again */
    own.added = INFINITY;
    refuses(&own, 1, PSPEC_ERROR_INPUT, ") is inf, no finite number");
    ps_integrand_destroy(own.integrand);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_measures_the_same),
        cmocka_unit_test(samplers_are_ranked),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests_name("given_integrands", tests, NULL, NULL);
}
