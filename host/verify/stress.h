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
} ps_stress_case;

/* Ended by a row without a name. */
extern const ps_stress_case ps_stress_cases[];

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

typedef struct ps_stress_options {
    const char *case_name, *engine; /* NULL: all */
    int precision;                  /* a ps_precision, or -1: all */
    bool quick;                     /* the quick cases only, unless one is named */
    bool (*should_stop)(void *payload);
    /* Told of every row as soon as it is known; and of cases done and to be done. */
    pspec_status (*report)(void *payload, const ps_stress_row *row, ps_error *error);
    void (*advance)(void *payload, size_t done, size_t total);
    void *payload;
} ps_stress_options;

typedef struct ps_stress_totals {
    size_t num_passed, num_failed, num_skipped;
    ps_stress_row first_failure; /* if there is one */
} ps_stress_totals;

/* Is it the name of a case, and of something that cases try? Else PSPEC_ERROR_INVALID_ARGUMENT with
 * the nearest. */
pspec_status ps_stress_check(const ps_stress_options *options, ps_error *error) PS_MUST_CHECK;
bool ps_stress_needs_device(const ps_stress_options *options);

/* device NULL: for options that need none. Wrong results and failures of the device are rows; that
 * memory is short, or that somebody wants it stopped, ends the run. */
pspec_status ps_stress_run(const ps_stress_options *options, ps_device *device,
                           ps_stress_totals *totals, ps_error *error) PS_MUST_CHECK;

/* "pass", "fail", "fail: why", "skipped: why" */
void ps_stress_verdict_text(const ps_stress_row *row, char *text, size_t text_bytes);

#endif
