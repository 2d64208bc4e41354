#include "sets/program_sets.h"

#include "base/process/program.h"

#include <string.h>

ps_program_sets ps_program_sets_make(const char *const *paths, size_t num_paths,
                                     const ps_point_options *options) {
    return (ps_program_sets){
        .are_programs = num_paths > 0 && ps_points_program(paths[0]) != NULL,
        .num_sets = options->programs.num_sets,
    };
}

pspec_status ps_program_sets_try(ps_program_sets *self, const char *const *paths, size_t *num_paths,
                                 const ps_point_options *options, ps_text *said, ps_error *error) {
    if (!self->are_programs || !options->programs.may_run) {
        return PSPEC_OK;
    }
    PS_TRY(ps_program_repeats(&self->repeats, ps_points_program(paths[0]), error));
    if (self->repeats && *num_paths > 1 && strcmp(paths[0], paths[1]) == 0) {
        *num_paths = 1;
        self->num_sets = 1;
    }
    ps_text_append(said, "of a program that prints %s",
                   self->repeats ? "the same again" : "other points each time");
    return PSPEC_OK;
}

bool ps_program_sets_are_all(const ps_program_sets *self, uint64_t num_taken) {
    return self->are_programs && num_taken == self->num_sets;
}

pspec_status ps_program_sets_end(const ps_program_sets *self, uint64_t num_taken, ps_error *error) {
    return !self->are_programs || num_taken == self->num_sets
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "the program printed %llu set%s, and %llu are asked for (--realizations)",
                         (unsigned long long)num_taken, num_taken == 1 ? "" : "s",
                         (unsigned long long)self->num_sets);
}
