/* Whose weights points have: a part of questions, as plan/specs.h has others. */
#ifndef PS_POINTS_WEIGHTS_SPEC_H
#define PS_POINTS_WEIGHTS_SPEC_H

#include <stdbool.h>

typedef enum ps_weights_kind {
    PS_WEIGHTS_GIVEN = 0, /* nothing was said: those that points have; else all are equal */
    PS_WEIGHTS_EQUAL,     /* what files have is dropped */
    PS_WEIGHTS_COLUMN,    /* the last column of files */
    PS_WEIGHTS_FILE,      /* of a file of their own, the same for every set */
    PS_WEIGHTS_OPTIMAL    /* of quadrature rules */
} ps_weights_kind;

typedef struct ps_weights_spec {
    ps_weights_kind kind;
    const char *path; /* of PS_WEIGHTS_FILE; else NULL */
    bool sum_to_one;  /* optimal ones among those with sum w = 1 */
} ps_weights_spec;

#endif
