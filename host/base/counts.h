/* Lists of whole numbers that people type: "1024", "64,128,256", "16..16384", which is 16 and its
 * doubles up to the last that is not above 16384, and mixtures, "16..64,100". */
#ifndef PS_BASE_COUNTS_H
#define PS_BASE_COUNTS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ps_counts {
    size_t num, most;
    uint64_t *values; /* [most], the caller's */
} ps_counts;

/* Appends the numbers of a text in their order. Each is from minimum to maximum, and none of the
 * list stands there twice; more than the list has room for are refused. `what` begins the
 * sentence, as "-n". */
pspec_status ps_counts_parse(ps_counts *out, const char *text, const char *what, uint64_t minimum,
                             uint64_t maximum, ps_error *error) PS_MUST_CHECK;

#endif
