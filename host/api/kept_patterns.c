#include "api/kept_patterns.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static const char what[] = "patterns in memory";

size_t ps_kept_patterns_size(const pspec_pattern *first, size_t num) {
    size_t size = 0;
    return ps_size_multiply(first->num_points, first->dimension + (first->weights != NULL),
                            &size) &&
                   ps_size_multiply(size, num, &size)
               ? size
               : SIZE_MAX;
}

pspec_status ps_kept_patterns_add(ps_kept_patterns *kept, const pspec_pattern *first, size_t num,
                                  ps_error *error) {
    const size_t coordinates = first->num_points * first->dimension;
    const size_t size = ps_kept_patterns_size(first, num);
    void *patterns = kept->patterns;
    void *numbers = kept->numbers;
    if (size == SIZE_MAX || size > SIZE_MAX - kept->used) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "there is no memory for so many %s", what);
    }
    PS_TRY(
        ps_grow(&patterns, &kept->capacity, kept->num + num, sizeof *kept->patterns, what, error));
    kept->patterns = patterns;
    PS_TRY(ps_grow(&numbers, &kept->room, kept->used + size, sizeof *kept->numbers, what, error));
    kept->numbers = numbers;
    for (size_t i = 0; i < num; i++) {
        kept->patterns[kept->num++] = (ps_kept_pattern){first->dimension, first->weights != NULL,
                                                        first->num_points, kept->used};
        memcpy(kept->numbers + kept->used, first->points + i * coordinates,
               coordinates * sizeof *first->points);
        kept->used += coordinates;
        if (first->weights != NULL) {
            memcpy(kept->numbers + kept->used, first->weights + i * first->num_points,
                   first->num_points * sizeof *first->weights);
            kept->used += first->num_points;
        }
    }
    return PSPEC_OK;
}

pspec_pattern ps_kept_patterns_view(const ps_kept_patterns *kept, size_t i) {
    const ps_kept_pattern *const own = &kept->patterns[i];
    const double *const numbers = kept->numbers + own->first;
    return (pspec_pattern){own->dimension, own->num_points, numbers,
                           own->has_weights ? numbers + own->num_points * own->dimension : NULL};
}

void ps_kept_patterns_free(ps_kept_patterns *kept) {
    free(kept->patterns);
    free(kept->numbers);
    *kept = (ps_kept_patterns){0};
}
