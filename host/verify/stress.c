#include "verify/stress.h"

#include "plan/choose.h"
#include "verify/stress_sample.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct run {
    const ps_suite_options *options;
    ps_device *device;
    ps_stress_totals *totals;
} run;

/* ---- what is chosen ------------------------------------------------------------------------ */

/* The referee is not tried against itself. */
static bool takes(const ps_engine *engine, ps_stress_kind kind) {
    (void)kind;
    return engine->needs_device;
}

const ps_suite ps_stress_suite = {ps_stress_cases, takes, " to try"};

bool ps_stress_needs_device(const ps_suite_options *options) {
    for (const ps_stress_case *what = ps_stress_cases; what->name != NULL; what++) {
        if ((what->kind != PS_STRESS_PROBE || what->probe->needs_device) &&
            ps_suite_has_case(&ps_stress_suite, options, what)) {
            return true;
        }
    }
    return false;
}

/* ---- rows ---------------------------------------------------------------------------------- */

void ps_stress_verdict_text(const ps_stress_row *row, char *text, size_t text_bytes) {
    static const char *const words[] = {"pass", "fail", "skipped"};
    snprintf(text, text_bytes, "%s%s%s", words[row->verdict], row->reason[0] != '\0' ? ": " : "",
             row->reason);
}

static pspec_status report(const run *self, const ps_stress_row *row, ps_error *error) {
    ps_stress_totals *totals = self->totals;
    switch (row->verdict) {
    case PS_STRESS_PASS:
        totals->num_passed++;
        break;
    case PS_STRESS_SKIPPED:
        totals->num_skipped++;
        break;
    case PS_STRESS_FAIL:
        totals->first_failure = totals->num_failed > 0 ? totals->first_failure : *row;
        totals->num_failed++;
        break;
    }
    return self->options->report != NULL ? self->options->report(self->options->payload, row, error)
                                         : PSPEC_OK;
}

static pspec_status skip(const run *self, ps_stress_row *row, const char *why, ps_error *error) {
    row->verdict = PS_STRESS_SKIPPED;
    snprintf(row->reason, sizeof row->reason, "%s", why);
    return report(self, row, error);
}

/* The row of a measurement that came to status. What a device or its compiler refuses is a verdict
 * on them. */
static pspec_status judge(const run *self, ps_stress_row *row, pspec_status status,
                          ps_error *error) {
    if (status == PSPEC_OK) {
        row->verdict = row->error <= row->bound ? PS_STRESS_PASS : PS_STRESS_FAIL;
        return report(self, row, error);
    }
    if (status != PSPEC_ERROR_DEVICE && status != PSPEC_ERROR_BUILD) {
        return status;
    }
    row->error = row->bound = NAN;
    row->verdict = PS_STRESS_FAIL;
    const size_t length = strcspn(error->message, "\n"); /* build logs go on */
    snprintf(row->reason, sizeof row->reason, "%.*s", (int)length, error->message);
    return report(self, row, error);
}

static bool lacks_precision(const run *self, int precision) {
    return precision == PS_DOUBLE && !ps_device_get_limits(self->device)->has_fp64;
}

/* ---- cases --------------------------------------------------------------------------------- */

/* NULL, or why the device cannot do it though the engine could: its memory. */
static pspec_status find_obstacle(const run *self, const ps_problem *problem,
                                  const ps_engine *engine, ps_precision precision, char *why,
                                  size_t why_bytes, bool *is_applicable, ps_error *error) {
    const ps_device_limits *limits = ps_device_get_limits(self->device);
    const ps_plan_constraints constraints = {.engine = engine->name, .precision = (int)precision};
    ps_plan plan;
    why[0] = '\0';
    PS_TRY(ps_plan_make(&plan, problem, limits, &constraints, error));
    for (size_t i = 0; i < plan.num_candidates; i++) {
        const ps_candidate *one = &plan.candidates[i];
        if (one->engine == engine && one->precision == precision) {
            *is_applicable = one->is_applicable;
            if (one->is_applicable && one->device_bytes > (double)limits->global_bytes) {
                snprintf(why, why_bytes, "needs %.3g bytes, above the device's %.3g",
                         one->device_bytes, (double)limits->global_bytes);
            }
        }
    }
    return PSPEC_OK;
}

static pspec_status try_engine(const run *self, ps_stress_sample *sample, const ps_engine *engine,
                               ps_precision precision, ps_error *error) {
    const ps_suite_options *options = self->options;
    ps_stress_row row = {.what = sample->what,
                         .engine = engine->name,
                         .precision = precision,
                         .error = NAN,
                         .bound = NAN};
    const ps_problem problem = ps_stress_problem(sample, precision);
    bool is_applicable = false;
    char why[sizeof row.reason];
    if (lacks_precision(self, (int)precision)) {
        return skip(self, &row, "the device has no double precision", error);
    }
    PS_TRY(
        find_obstacle(self, &problem, engine, precision, why, sizeof why, &is_applicable, error));
    if (why[0] != '\0') {
        return skip(self, &row, why, error);
    }
    if (!is_applicable) {
        return PSPEC_OK; /* not made for it, on any device */
    }
    PS_TRY(ps_stress_sample_judge(sample, options->should_stop, options->payload, error));
    const pspec_status status = ps_stress_measure(sample, &problem, engine, precision, self->device,
                                                  &row.error, &row.bound, error);
    return judge(self, &row, status, error);
}

static pspec_status run_engines(const run *self, const ps_stress_case *what, ps_error *error) {
    ps_stress_sample sample;
    PS_TRY(ps_stress_sample_create(&sample, what, error));
    pspec_status status = PSPEC_OK;
    for (const ps_engine *const *engine = ps_engines; *engine != NULL; engine++) {
        for (int precision = PS_SINGLE; precision <= PS_DOUBLE && status == PSPEC_OK; precision++) {
            status = ps_suite_go_on(self->options, error);
            if (status == PSPEC_OK &&
                ps_suite_tries(&ps_stress_suite, self->options, what, *engine, precision)) {
                status = try_engine(self, &sample, *engine, (ps_precision)precision, error);
            }
        }
    }
    ps_stress_sample_free(&sample);
    return status;
}

static pspec_status run_probe(const run *self, const ps_stress_case *what, ps_error *error) {
    const ps_stress_probe *probe = what->probe;
    for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
        ps_stress_row row = {.what = what,
                             .engine = probe->engine,
                             .precision = (ps_precision)precision,
                             .error = NAN,
                             .bound = NAN};
        if (!probe->has_precision[precision] ||
            !ps_suite_wants(self->options, probe->engine, precision)) {
            continue;
        }
        if (probe->needs_device && lacks_precision(self, precision)) {
            PS_TRY(skip(self, &row, "the device has no double precision", error));
            continue;
        }
        const pspec_status status =
            probe->measure(self->device, row.precision, &row.error, &row.bound, error);
        PS_TRY(judge(self, &row, status, error));
    }
    return PSPEC_OK;
}

/* CPUs like groups of one work-item, in which barriers do nothing; those of GPUs are tried there,
 * too. */
static pspec_status run_case(void *payload, const ps_stress_case *what, ps_error *error) {
    const run *const self = payload;
    if (self->device != NULL) {
        ps_device_set_group_size(self->device, what->group_size);
    }
    const pspec_status status = what->kind == PS_STRESS_PROBE ? run_probe(self, what, error)
                                                              : run_engines(self, what, error);
    if (self->device != NULL) {
        ps_device_set_group_size(self->device, 0);
    }
    return status;
}

pspec_status ps_stress_run(const ps_suite_options *options, ps_device *device,
                           ps_stress_totals *totals, ps_error *error) {
    run self = {options, device, totals};
    *totals = (ps_stress_totals){0};
    return ps_suite_run(&ps_stress_suite, options, run_case, &self, error);
}
