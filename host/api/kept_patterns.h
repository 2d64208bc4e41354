/* Patterns that a question keeps: copies, of which it gives views. */
#ifndef PS_API_KEPT_PATTERNS_H
#define PS_API_KEPT_PATTERNS_H

#include "base/status.h"

#include <stdbool.h>

typedef struct ps_kept_pattern {
    unsigned dimension;
    bool has_weights;
    size_t num_points, first; /* of its numbers: coordinates, then weights */
} ps_kept_pattern;

/* {0}: none */
typedef struct ps_kept_patterns {
    ps_kept_pattern *patterns;
    size_t num, capacity;
    double *numbers;
    size_t used, room;
} ps_kept_patterns;

/* Doubles of num patterns of the shape of one of them; SIZE_MAX: more than there can be. */
size_t ps_kept_patterns_size(const pspec_pattern *first, size_t num);
/* Copies num patterns of the shape of the first, one behind the other. */
pspec_status ps_kept_patterns_add(ps_kept_patterns *kept, const pspec_pattern *first, size_t num,
                                  ps_error *error) PS_MUST_CHECK;
/* A view of pattern i, below num, until more are added. */
pspec_pattern ps_kept_patterns_view(const ps_kept_patterns *kept, size_t i);
void ps_kept_patterns_free(ps_kept_patterns *kept);

#endif
