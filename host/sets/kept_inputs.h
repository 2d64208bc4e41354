/* The sets of inputs that cannot be read twice, standard input and pipes, kept in memory as they
 * are read, for a source that is rewound. */
#ifndef PS_SETS_KEPT_INPUTS_H
#define PS_SETS_KEPT_INPUTS_H

#include "points/points.h"

typedef struct ps_kept_set {
    size_t input; /* number of the path that it came from */
    ps_point_set set;
} ps_kept_set;

typedef struct ps_kept_inputs {
    uint64_t memory_limit; /* bytes that somebody typed; 0: half of what is free */
    ps_kept_set *sets;     /* [num], inputs in ascending order */
    size_t num, capacity;
    uint64_t bytes;
    size_t next; /* that is handed out */
} ps_kept_inputs;

void ps_kept_inputs_free(ps_kept_inputs *kept);
uint64_t ps_kept_inputs_bytes(const ps_point_set *set);
/* Copies a set, which counts as handed out; name is of the input, for the sentence that says that
 * they are too many. */
pspec_status ps_kept_inputs_add(ps_kept_inputs *kept, size_t input, const char *name,
                                const ps_point_set *set, ps_error *error) PS_MUST_CHECK;
/* Are the sets of that input here, where inputs are asked for in their order? */
bool ps_kept_inputs_have(const ps_kept_inputs *kept, size_t input);
/* Copies the next set of the input; *has_set false: there are no more. */
pspec_status ps_kept_inputs_next(ps_kept_inputs *kept, size_t input, ps_point_set *set,
                                 bool *has_set, ps_error *error) PS_MUST_CHECK;
void ps_kept_inputs_rewind(ps_kept_inputs *kept);

#endif
