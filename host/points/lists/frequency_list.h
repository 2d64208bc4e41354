/* Lists of frequency vectors. */
#ifndef PS_POINTS_LISTS_FREQUENCY_LIST_H
#define PS_POINTS_LISTS_FREQUENCY_LIST_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* Reads a list of integer frequency vectors, one per line, columns separated by blanks or commas,
 * '#' lines skipped; *vectors is [num_vectors][*dimension], freed by the caller. The dimension is
 * that of the first line (1 to 6). |k| <= 2^30. memory_limit: bytes that the list may take; 0: half
 * of those free. */
pspec_status ps_read_frequencies(const char *path, uint64_t memory_limit, int **vectors,
                                 size_t *num_vectors, unsigned *dimension,
                                 ps_error *error) PS_MUST_CHECK;

#endif
