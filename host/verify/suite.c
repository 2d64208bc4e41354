#include "verify/stress.h"

#include "base/text.h"

#include <string.h>

/* ---- what is chosen ------------------------------------------------------------------------ */

bool ps_suite_wants(const ps_suite_options *options, const char *engine, int precision) {
    return (options->engine == NULL || strcmp(options->engine, engine) == 0) &&
           (options->precision < 0 || options->precision == precision);
}

bool ps_suite_tries(const ps_suite *suite, const ps_suite_options *options,
                    const ps_stress_case *what, const ps_engine *engine, int precision) {
    const unsigned domain = what->kind == PS_STRESS_TORUS ? PS_ON_TORUS : PS_ON_SPHERE;
    return (engine->domains & domain) != 0 && engine->has_precision[precision] &&
           suite->takes(engine, what->kind) && ps_suite_wants(options, engine->name, precision);
}

static bool has_row(const ps_suite *suite, const ps_suite_options *options,
                    const ps_stress_case *what, int precision) {
    if (what->kind == PS_STRESS_PROBE) {
        return what->probe->has_precision[precision] &&
               ps_suite_wants(options, what->probe->engine, precision);
    }
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        if (ps_suite_tries(suite, options, what, *engine, precision)) {
            return true;
        }
    }
    return false;
}

bool ps_suite_has_case(const ps_suite *suite, const ps_suite_options *options,
                       const ps_stress_case *what) {
    bool has = false;
    for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
        has = has || has_row(suite, options, what, precision);
    }
    return has && (options->case_name != NULL ? strcmp(options->case_name, what->name) == 0
                                              : what->is_quick || !options->quick);
}

static size_t count_cases(const ps_suite *suite, const ps_suite_options *options) {
    size_t num = 0;
    for (const ps_stress_case *what = suite->cases; what->name != NULL; what++) {
        num += ps_suite_has_case(suite, options, what);
    }
    return num;
}

/* ---- names --------------------------------------------------------------------------------- */

static pspec_status check_name(const char *name, const char *nearest, const char *kind,
                               const char *purpose, ps_error *error) {
    return name == NULL || strcmp(name, nearest) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no %s \"%s\"%s%s", kind,
                         name, purpose,
                         ps_text_suggest(name, nearest, ps_text_distance(name, nearest),
                                         "; the nearest is ", "")
                             .text);
}

pspec_status ps_suite_check(const ps_suite *suite, const ps_suite_options *options,
                            ps_error *error) {
    const char *const name = options->case_name != NULL ? options->case_name : "";
    const char *const engine = options->engine != NULL ? options->engine : "";
    const char *nearest_case = NULL;
    const char *nearest_engine = NULL;
    for (const ps_stress_case *what = suite->cases; what->name != NULL; what++) {
        ps_text_keep_nearest(name, what->name, &nearest_case);
        if (what->kind == PS_STRESS_PROBE) {
            ps_text_keep_nearest(engine, what->probe->engine, &nearest_engine);
        }
    }
    for (const ps_engine *const *one = ps_engines; *one != NULL; one++) {
        if (suite->takes(*one, PS_STRESS_PAIRS)) {
            ps_text_keep_nearest(engine, (*one)->name, &nearest_engine);
        }
    }
    PS_TRY(check_name(options->case_name, nearest_case, "case", "", error));
    PS_TRY(check_name(options->engine, nearest_engine, "engine", suite->purpose, error));
    return count_cases(suite, options) > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "no case is left: none of those asked for has that engine and precision");
}

/* ---- running ------------------------------------------------------------------------------- */

pspec_status ps_suite_go_on(const ps_suite_options *options, ps_error *error) {
    return options->should_stop != NULL && options->should_stop(options->payload)
               ? ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted")
               : PSPEC_OK;
}

pspec_status ps_suite_run(const ps_suite *suite, const ps_suite_options *options,
                          pspec_status (*run_case)(void *self, const ps_stress_case *what,
                                                   ps_error *error),
                          void *self, ps_error *error) {
    const size_t total = count_cases(suite, options);
    size_t done = 0;
    for (const ps_stress_case *what = suite->cases; what->name != NULL; what++) {
        if (ps_suite_has_case(suite, options, what)) {
            PS_TRY(ps_suite_go_on(options, error));
            if (options->advance != NULL) {
                options->advance(options->payload, done, total);
            }
            PS_TRY(run_case(self, what, error));
            done++;
        }
    }
    return PSPEC_OK;
}
