#include "sets/kept_inputs.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ps_kept_inputs_free(ps_kept_inputs *kept) {
    for (size_t i = 0; i < kept->num; i++) {
        ps_point_set_free(&kept->sets[i].set);
    }
    free(kept->sets);
    *kept = (ps_kept_inputs){0};
}

/* As for a set of a stream (points/points_read.c): nobody knows whether it has an end. */
static pspec_status check_room(const ps_kept_inputs *kept, const char *name, uint64_t more,
                               ps_error *error) {
    const uint64_t bytes = kept->bytes + more;
    char size[PS_SIZE_TEXT];
    ps_memory_share share;
    if (kept->memory_limit == 0 && bytes / PS_LEAST_SHARE == kept->bytes / PS_LEAST_SHARE) {
        return PSPEC_OK;
    }
    ps_memory_share_find(&share, kept->memory_limit, kept->bytes);
    return (double)bytes <= share.bytes
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%s: %zu sets take more than %s, %s, and are kept in memory because this "
                         "is read more than once and they come but once; give a file",
                         strcmp(name, "-") == 0 ? "standard input" : name, kept->num + 1,
                         ps_size_show(size, share.bytes), share.by);
}

static pspec_status copy(ps_point_set *target, const ps_point_set *set, ps_error *error) {
    target->coordinates = set->coordinates;
    target->dimension = set->dimension;
    target->has_weights = set->has_weights;
    target->box = set->box;
    target->num_points = 0;
    PS_TRY(ps_points_reserve(target, set->num_points, error));
    memcpy(target->points, set->points, set->num_points * set->dimension * sizeof *target->points);
    if (set->has_weights) {
        memcpy(target->weights, set->weights, set->num_points * sizeof *target->weights);
    }
    target->num_points = set->num_points;
    return PSPEC_OK;
}

uint64_t ps_kept_inputs_bytes(const ps_point_set *set) {
    const size_t columns = set->dimension + (set->has_weights ? 1 : 0);
    return set->num_points * columns * sizeof(double);
}

pspec_status ps_kept_inputs_add(ps_kept_inputs *kept, size_t input, const char *name,
                                const ps_point_set *set, ps_error *error) {
    void *memory = kept->sets;
    const uint64_t bytes = ps_kept_inputs_bytes(set);
    PS_TRY(check_room(kept, name, bytes, error));
    PS_TRY(
        ps_grow(&memory, &kept->capacity, kept->num + 1, sizeof *kept->sets, "point sets", error));
    kept->sets = memory;
    ps_kept_set *const own = &kept->sets[kept->num];
    *own = (ps_kept_set){.input = input};
    kept->num++; /* freed with the others, also after a failure */
    kept->next = kept->num;
    kept->bytes += bytes;
    return copy(&own->set, set, error);
}

/* Those that were handed out last, or are next. */
bool ps_kept_inputs_have(const ps_kept_inputs *kept, size_t input) {
    const size_t next = kept->next;
    return (next < kept->num && kept->sets[next].input == input) ||
           (next > 0 && kept->sets[next - 1].input == input);
}

pspec_status ps_kept_inputs_next(ps_kept_inputs *kept, size_t input, ps_point_set *set,
                                 bool *has_set, ps_error *error) {
    *has_set = kept->next < kept->num && kept->sets[kept->next].input == input;
    return *has_set ? copy(set, &kept->sets[kept->next++].set, error) : PSPEC_OK;
}

void ps_kept_inputs_rewind(ps_kept_inputs *kept) {
    kept->next = 0;
}
