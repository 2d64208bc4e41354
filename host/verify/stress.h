/* The numerical stability suite (docs/mathematics/numerics.md): cases that are hard on arithmetic,
 * each by every engine and precision that can do it, against long double referees, and what the
 * host computes alone against other formulas. The bound is the engine's own error formula with the
 * power that was measured, as the tolerance contract has it.
 *
 * On the device of a user it is an acceptance test of its driver: maths, double precision and
 * barriers that are wrong show as failures of cases that have a name.
 */
#ifndef PS_VERIFY_STRESS_H
#define PS_VERIFY_STRESS_H

#include "verify/suite.h"

typedef enum ps_stress_verdict {
    PS_STRESS_PASS,
    PS_STRESS_FAIL,
    PS_STRESS_SKIPPED
} ps_stress_verdict;

typedef struct ps_stress_row {
    const ps_stress_case *what;
    const char *engine;
    ps_precision precision;
    double error, bound; /* nan: there are none */
    ps_stress_verdict verdict;
    char reason[256]; /* of a failure that is not the error, or of skipping; else empty */
} ps_stress_row;

typedef struct ps_stress_totals {
    size_t num_passed, num_failed, num_skipped;
    ps_stress_row first_failure; /* if there is one */
} ps_stress_totals;

extern const ps_suite ps_stress_suite;
bool ps_stress_needs_device(const ps_suite_options *options);

/* device NULL: for options that need none. Wrong results and failures of the device are rows; that
 * memory is short, or that somebody wants it stopped, ends the run. */
pspec_status ps_stress_run(const ps_suite_options *options, ps_device *device,
                           ps_stress_totals *totals, ps_error *error) PS_MUST_CHECK;

/* "pass", "fail", "fail: why", "skipped: why" */
void ps_stress_verdict_text(const ps_stress_row *row, char *text, size_t text_bytes);

#endif
