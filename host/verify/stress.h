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

#include "engines/engine.h"

/* ---- cases that engines are tried with: also those of the benchmark (bench/bench.h) -------- */

typedef enum ps_stress_kind {
    PS_STRESS_TORUS,  /* |S| of frequencies */
    PS_STRESS_SPHERE, /* c_lm and Q(l) of degrees, relative to white noise */
    PS_STRESS_PAIRS,  /* Q(l) relative to (sum |w|)^2 */
    PS_STRESS_PROBE   /* something of its own */
} ps_stress_kind;

/* What no engine of the table computes: on the device, or on the host alone. */
typedef struct ps_stress_probe {
    const char *engine; /* in the table; "host" without a device */
    bool needs_device;
    bool has_precision[3]; /* by ps_precision */
    pspec_status (*measure)(ps_device *device, ps_precision precision, double *found, double *bound,
                            ps_error *error);
} ps_stress_probe;

/* Probes that are no engine's: sums and averages on the device, and special functions, kernels and
 * weights on the host. */
extern const ps_stress_probe ps_probe_averages;
extern const ps_stress_probe ps_probe_diagonal, ps_probe_eigenvalues, ps_probe_sharp_lobe,
    ps_probe_wide_lobe, ps_probe_optimal_weights;

typedef struct ps_stress_case {
    const char *name;
    const char *section; /* a heading of docs/mathematics: of the numerics, or of quadrature */
    const char *summary;
    ps_stress_kind kind;
    bool is_quick;
    const char *shape; /* of the points: verify/stress_shapes.h */
    uint64_t num_points;
    unsigned dimension;   /* of the torus */
    int32_t reach;        /* K of a box, the largest |k_i| of a list, L */
    bool is_hemisphere;   /* even degrees only */
    unsigned num_listed;  /* frequencies of a list; 0: the box */
    unsigned num_checked; /* of all frequencies or degrees, by the referee; 0: all */
    unsigned group_size;  /* work-items of work-groups that need not be 1; 0: as the device likes */
    const ps_stress_probe *probe;
    uint64_t num_realizations; /* of the job that a benchmark plans (bench/bench.h) */
} ps_stress_case;

/* The cases of both (suite_cases.c), ended by a row without a name. */
extern const ps_stress_case ps_stress_cases[], ps_bench_cases[];

typedef struct ps_suite {
    const ps_stress_case *cases; /* ended by a row without a name */
    bool (*takes)(const ps_engine *engine, ps_stress_kind kind);
    const char *purpose; /* " to try": what the engines are for, in sentences */
} ps_suite;

struct ps_stress_row;
struct ps_bench_row;

typedef struct ps_suite_options {
    const char *case_name, *engine; /* NULL: all */
    int precision;                  /* a ps_precision, or -1: all */
    bool quick;                     /* the quick cases only, unless one is named */
    bool (*should_stop)(void *payload);
    /* Told of every row as soon as it is known, */
    pspec_status (*report)(void *payload, const struct ps_stress_row *row, ps_error *error);
    /* or of those of a case when it is done, tightest tolerance first; */
    pspec_status (*report_rows)(void *payload, const struct ps_bench_row *rows, size_t num,
                                ps_error *error);
    /* and of cases done and to be done. */
    void (*advance)(void *payload, size_t done, size_t total);
    void *payload;
} ps_suite_options;

/* Is it the name of a case, and of an engine that one of those left has rows of? Else
 * PSPEC_ERROR_INVALID_ARGUMENT with the nearest. */
pspec_status ps_suite_check(const ps_suite *suite, const ps_suite_options *options,
                            ps_error *error) PS_MUST_CHECK;

/* Is it asked for, and has it a row? */
bool ps_suite_has_case(const ps_suite *suite, const ps_suite_options *options,
                       const ps_stress_case *what);
/* Is that engine asked for, in that precision? */
bool ps_suite_wants(const ps_suite_options *options, const char *engine, int precision);
/* Has the case a row of that engine and precision that is asked for? */
bool ps_suite_tries(const ps_suite *suite, const ps_suite_options *options,
                    const ps_stress_case *what, const ps_engine *engine, int precision);

/* "cancelled", when somebody wants it stopped. */
pspec_status ps_suite_go_on(const ps_suite_options *options, ps_error *error) PS_MUST_CHECK;

/* Runs all cases that are asked for, one after the other. */
pspec_status ps_suite_run(const ps_suite *suite, const ps_suite_options *options,
                          pspec_status (*run_case)(void *self, const ps_stress_case *what,
                                                   ps_error *error),
                          void *self, ps_error *error) PS_MUST_CHECK;

/* ---- the stability suite ------------------------------------------------------------------- */

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
