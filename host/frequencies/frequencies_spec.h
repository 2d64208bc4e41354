/* Which frequencies a question is about, on the torus: a part of questions as plan/specs.h has
 * others. */
#ifndef PS_FREQUENCIES_FREQUENCIES_SPEC_H
#define PS_FREQUENCIES_FREQUENCIES_SPEC_H

#include "frequencies/bin_rule.h"
#include "frequencies/frequencies.h"

#include <stdint.h>

typedef struct ps_frequencies_spec {
    int32_t max_frequency; /* K of a grid; 0: ceil(5 N^(1/d)), for d <= 3 */
    const char *path;      /* of a list; NULL: a grid */
    uint64_t per_ring;     /* of every ring, at random; 0: all (frequencies/frequency_sample.h) */
    ps_bin_rule bins;      /* relative widths are resolved when N is known */
    /* One of a grid whose S(k) are shown, and how many numbers it has; 0: none */
    unsigned num_shown;
    int32_t shown[PS_MAX_DIMENSION];
} ps_frequencies_spec;

#endif
