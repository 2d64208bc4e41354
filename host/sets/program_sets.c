#include "sets/program_sets.h"

#include "base/process/program.h"

#include <string.h>

ps_program_sets ps_program_sets_make(const char *const *paths, size_t num_paths,
                                     const ps_point_options *options) {
    return (ps_program_sets){
        .are_programs = num_paths > 0 && ps_points_program(paths[0]) != NULL,
        .num_sets = options->programs.num_sets,
        .has_runs = num_paths > 1,
        .path = num_paths > 0 ? paths[0] : NULL,
    };
}

/* Runs one more, and compares what it prints with what the first has printed. */
static pspec_status try_again(bool *is_same, const ps_text *first, const char *path,
                              ps_error *error) {
    ps_text again = {0};
    const pspec_status status = ps_program_try(&again, ps_points_program(path), error);
    *is_same = status == PSPEC_OK && again.length == first->length &&
               (first->length == 0 || memcmp(again.data, first->data, first->length) == 0);
    ps_text_free(&again);
    return status;
}

pspec_status ps_program_sets_try(ps_program_sets *self, const char *const *paths, size_t *num_paths,
                                 const ps_point_options *options, ps_text *said, ps_error *error) {
    ps_text first = {0};
    bool is_one = false;
    if (!self->are_programs || !options->programs.may_run) {
        return PSPEC_OK;
    }
    pspec_status status = ps_program_try(&first, ps_points_program(paths[0]), error);
    if (status == PSPEC_OK) {
        status = try_again(&self->repeats, &first, paths[0], error);
    }
    if (status == PSPEC_OK && self->repeats && *num_paths > 1) {
        status = try_again(&is_one, &first, paths[1], error);
    }
    ps_text_append(said, "of a program that prints %s",
                   self->repeats ? "the same again" : "other points each time");
    if (is_one) {
        ps_text_append(said, " and for realizations 0 and 1, so that one of %zu is taken",
                       *num_paths);
        *num_paths = 1;
        self->num_sets = 1;
    }
    ps_text_free(&first);
    return status;
}

bool ps_program_sets_are_all(const ps_program_sets *self, uint64_t num_taken) {
    return self->are_programs && num_taken == self->num_sets;
}

pspec_status ps_program_sets_check(const ps_program_sets *self, uint64_t of_run, const char *path,
                                   ps_error *error) {
    return !self->has_runs || !self->are_programs || of_run <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s printed more than one set; {realizations} in the command tells it how "
                         "many there are, and it is run once then",
                         path);
}

pspec_status ps_program_sets_end_run(const ps_program_sets *self, uint64_t num_taken,
                                     const char *path, ps_point_reader **reader, ps_error *error) {
    ps_point_set more = {0};
    bool has_more = false;
    bool ends = false;
    pspec_status status = PSPEC_OK;
    if (self->has_runs && self->are_programs) {
        status = ps_points_next_block(*reader, &more, 1, &has_more, &ends, error);
        status =
            status == PSPEC_OK ? ps_program_sets_check(self, 1 + has_more, path, error) : status;
        ps_point_set_free(&more);
    } else if (!ps_program_sets_are_all(self, num_taken)) {
        return PSPEC_OK;
    }
    ps_points_close(*reader);
    *reader = NULL;
    return status;
}

pspec_status ps_program_sets_end(const ps_program_sets *self, uint64_t num_taken, ps_error *error) {
    return !self->are_programs || num_taken == self->num_sets
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s printed %llu set%s, and %llu are asked for (--realizations)",
                         self->path, (unsigned long long)num_taken, num_taken == 1 ? "" : "s",
                         (unsigned long long)self->num_sets);
}
