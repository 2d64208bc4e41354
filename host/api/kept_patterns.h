/* Copies of the patterns that an average has had, for who cannot be asked for them again: a second
 * plan begins with the first of them. Allocates room for what was announced at once, and more where
 * patterns are larger, or more of them, up to most_bytes; what does not fit is not kept, and then
 * nothing can be had again.
 */
#ifndef PS_API_KEPT_PATTERNS_H
#define PS_API_KEPT_PATTERNS_H

#include "base/status.h"

#include <stdbool.h>

typedef struct ps_kept_shape {
    unsigned dimension;
    uint64_t num_points;       /* of a pattern, as far as known */
    uint64_t num_realizations; /* 0: not known */
    uint64_t most_bytes;       /* of coordinates and weights; 0: what one job may keep */
} ps_kept_shape;

typedef struct ps_kept_patterns {
    pspec_pattern *patterns; /* [num], pointing into numbers; borrowed by who runs them again */
    size_t num, capacity;
    double *numbers;         /* [room] coordinates and weights */
    size_t used, room, most; /* most: that room may become */
    bool is_partial;         /* one did not fit */
} ps_kept_patterns;

pspec_status ps_kept_patterns_create(ps_kept_patterns *kept, const ps_kept_shape *shape,
                                     ps_error *error) PS_MUST_CHECK;
void ps_kept_patterns_free(ps_kept_patterns *kept);
/* Of the room, used or not. */
uint64_t ps_kept_patterns_bytes(const ps_kept_patterns *kept);

/* Patterns that were checked before. */
void ps_kept_patterns_add(ps_kept_patterns *kept, const pspec_pattern *patterns, size_t num);
void ps_kept_patterns_reset(ps_kept_patterns *kept);

#endif
